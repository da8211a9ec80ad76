// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/facade.h>

#include <Eigen/Geometry>
#include <cmath>

namespace storey {
namespace {

std::vector<Eigen::Vector3d> cornersOf(const PolyhedralModel& model, const std::vector<int>& ring) {
  std::vector<Eigen::Vector3d> corners;
  for (const int v : ring) corners.push_back(model.vertices[static_cast<std::size_t>(v)]);
  return corners;
}

/// Twice the area of a ring, along its normal (Newell).
Eigen::Vector3d areaNormal(const std::vector<Eigen::Vector3d>& ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += (ring[i] - ring[0]).cross(ring[(i + 1) % ring.size()] - ring[0]);
  }
  return sum;
}

}  // namespace

std::vector<Facade> facadesOf(const PolyhedralModel& model) {
  std::vector<Facade> facades;
  for (const PolyhedralFace& face : model.faces) {
    Facade facade;
    facade.rings.push_back(cornersOf(model, face.outer));
    facade.normal = areaNormal(facade.rings[0]).normalized();
    for (const std::vector<int>& hole : face.inner) {
      facade.rings.push_back(cornersOf(model, hole));
    }
    facades.push_back(facade);
  }
  return facades;
}

FacadeOutline FacadeFrame::outline(const Facade& facade) const {
  FacadeOutline outline;
  for (const auto& ring : facade.rings) {
    outline.emplace_back();
    for (const Eigen::Vector3d& corner : ring) outline.back().push_back(local(corner));
  }
  return outline;
}

FacadeFrame frameOf(const Facade& facade, const Eigen::Vector3d& vertical) {
  constexpr double kLevel = 0.99;  // cosine to the vertical: 8 degrees, what no roof drains at
  FacadeFrame frame;
  const Eigen::Vector3d& n = facade.normal;
  const bool level = std::abs(n.dot(vertical)) > kLevel;
  const bool along_y = std::abs(vertical.y()) > std::abs(vertical.z());
  const Eigen::Vector3d north = along_y ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d upwards = level ? north : vertical;
  frame.right = upwards.cross(n).normalized();
  frame.up = n.cross(frame.right);
  Eigen::AlignedBox2d box;
  for (const auto& ring : facade.rings) {
    for (const Eigen::Vector3d& corner : ring) box.extend(frame.local(corner));
  }
  const double distance = n.dot(facade.rings[0][0]);
  frame.origin = box.min().x() * frame.right + box.min().y() * frame.up + distance * n;
  frame.width = box.sizes().x();
  frame.height = box.sizes().y();
  return frame;
}

bool isInside(const FacadeOutline& outline, const Eigen::Vector2d& point) {
  bool inside = false;
  for (const auto& ring : outline) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[j];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (point.x() < x) inside = !inside;
    }
  }
  return inside;
}

}  // namespace storey
