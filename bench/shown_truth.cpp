// SPDX-License-Identifier: BSD-3-Clause
#include "bench/shown_truth.h"

#include <Eigen/Geometry>
#include <cmath>
#include <set>

namespace storey::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGate = 3.0;          // noise deviations
constexpr double kMinAgreement = 0.5;  // cosine between the normals of a point and its wall
constexpr double kMinShare = 0.03;     // of the points of the clean cloud
constexpr double kSamePlane = 0.999;   // cosine between the normals of walls that go on

// A vertical polygon; coordinates in it are the place along it and the height.
class WallFace {
 public:
  WallFace(const PolyhedralModel& model, const PolyhedralFace& face) {
    rings_.push_back(ringOf(model, face.outer));
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 0; i < face.outer.size(); ++i) {
      normal += at(model, face.outer, i).cross(at(model, face.outer, i + 1));
    }
    normal_ = normal.normalized();
    offset_ = normal_.dot(at(model, face.outer, 0));
    tangent_ = Vector3d::UnitZ().cross(normal_).normalized();
    for (const std::vector<int>& hole : face.inner) rings_.push_back(ringOf(model, hole));
    for (auto& ring : rings_) {
      for (Vector3d& corner : ring) corner = {tangent_.dot(corner), corner.z(), 0.0};
    }
  }

  const Vector3d& normal() const { return normal_; }

  double area() const {
    double twice = 0.0;  // holes run the other way
    for (const auto& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        twice += ring[i].cross(ring[(i + 1) % ring.size()]).z();
      }
    }
    return 0.5 * std::abs(twice);
  }

  bool has(const Vector3d& position, const Vector3d& normal, double noise) const {
    return std::abs(normal_.dot(position) - offset_) < kGate * noise &&
           normal_.dot(normal) > kMinAgreement && holds({tangent_.dot(position), position.z()});
  }

 private:
  static const Vector3d& at(const PolyhedralModel& model, const std::vector<int>& ring,
                            std::size_t i) {
    return model.vertices[static_cast<std::size_t>(ring[i % ring.size()])];
  }

  static std::vector<Vector3d> ringOf(const PolyhedralModel& model, const std::vector<int>& ring) {
    std::vector<Vector3d> corners;
    for (std::size_t i = 0; i < ring.size(); ++i) corners.push_back(at(model, ring, i));
    return corners;
  }

  // By the parity of the edges to its right.
  bool holds(const Vector2d& p) const {
    bool inside = false;
    for (const auto& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector3d& a = ring[i];
        const Vector3d& b = ring[(i + 1) % ring.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
      }
    }
    return inside;
  }

  Vector3d normal_;
  Vector3d tangent_;
  double offset_ = 0.0;
  std::vector<std::vector<Vector3d>> rings_;  // place, height, 0
};

}  // namespace

ShownTruth findShownTruth(const PolyhedralModel& truth, const std::vector<Vector3d>& positions,
                          const std::vector<Vector3d>& normals, double noise, double density) {
  ShownTruth shown;
  std::vector<std::vector<Vector3d>> walls_at(truth.vertices.size());  // normals of shown ones
  for (const PolyhedralFace& face : truth.faces) {
    if (face.label != FaceLabel::Wall) continue;
    const WallFace wall(truth, face);
    std::size_t count = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      count += wall.has(positions[i], normals[i], noise) ? 1 : 0;
    }
    if (static_cast<double>(count) < kMinShare * density * wall.area()) {
      ++shown.hidden_walls;
      continue;
    }
    std::set<int> corners(face.outer.begin(), face.outer.end());
    for (const std::vector<int>& hole : face.inner) corners.insert(hole.begin(), hole.end());
    for (const int corner : corners) {
      walls_at[static_cast<std::size_t>(corner)].push_back(wall.normal());
    }
  }
  for (std::size_t v = 0; v < walls_at.size(); ++v) {
    for (const Vector3d& normal : walls_at[v]) {
      if (std::abs(normal.dot(walls_at[v].front())) > kSamePlane) continue;
      shown.corners.push_back(truth.vertices[v]);
      break;
    }
  }
  return shown;
}

}  // namespace storey::bench
