// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/face_support.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace storey {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastSine = 1e-3;  // of the angle between two walls that have a crossing

// Of a wall's plane at a place; walls without points, or without an id, have none.
double deviationAt(const std::map<int, WallFit>& walls, int wall, const Eigen::Vector2d& place) {
  const auto fit = walls.find(wall);
  if (fit == walls.end() || fit->second.support == 0) return kInfinite;
  const Eigen::Vector2d tangent(-fit->second.normal.y(), fit->second.normal.x());
  return std::hypot(fit->second.offset_deviation,
                    tangent.dot(place - fit->second.centre) * fit->second.angle_deviation);
}

double deviationOfLevel(const std::vector<HeightFit>& levels, double z) {
  const auto nearest =
      std::min_element(levels.begin(), levels.end(), [z](const HeightFit& a, const HeightFit& b) {
        return std::abs(a.z - z) < std::abs(b.z - z);
      });
  return nearest == levels.end() ? kInfinite : nearest->deviation;
}

// The walls that meet at each vertex.
std::vector<std::set<int>> wallsAtVertices(const PolyhedralModel& model) {
  std::vector<std::set<int>> walls(model.vertices.size());
  const auto add = [&](const std::vector<int>& ring, int wall) {
    for (const int v : ring) walls[static_cast<std::size_t>(v)].insert(wall);
  };
  for (const PolyhedralFace& face : model.faces) {
    if (face.label != FaceLabel::Wall) continue;
    add(face.outer, face.wall);
    for (const std::vector<int>& ring : face.inner) add(ring, face.wall);
  }
  return walls;
}

// The plan part of a vertex's covariance.
Eigen::Matrix2d crossing(const std::map<int, WallFit>& fits, const std::set<int>& walls,
                         const Eigen::Vector2d& place) {
  Eigen::Matrix2d unknown = Eigen::Matrix2d::Zero();
  unknown.diagonal().setConstant(kInfinite);
  Eigen::Matrix2d normals;
  Eigen::Vector2d deviations;
  double best = kLeastSine;
  for (auto a = walls.begin(); a != walls.end(); ++a) {
    for (auto b = std::next(a); b != walls.end(); ++b) {
      if (fits.count(*a) == 0 || fits.count(*b) == 0) continue;
      Eigen::Matrix2d pair;
      pair << fits.at(*a).normal.transpose(), fits.at(*b).normal.transpose();
      if (std::abs(pair.determinant()) <= best) continue;
      best = std::abs(pair.determinant());
      normals = pair;
      deviations = {deviationAt(fits, *a, place), deviationAt(fits, *b, place)};
    }
  }
  if (best == kLeastSine || !deviations.allFinite()) return unknown;
  const Eigen::Matrix2d spread = normals.inverse() * deviations.asDiagonal();
  return spread * spread.transpose();
}

}  // namespace

void propagateDeviations(const std::map<int, WallFit>& walls, const std::vector<HeightFit>& levels,
                         PolyhedralModel& model) {
  for (PolyhedralFace& face : model.faces) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : face.outer) middle += model.vertices[static_cast<std::size_t>(v)];
    middle /= static_cast<double>(face.outer.size());
    face.deviation = face.label == FaceLabel::Wall ? deviationAt(walls, face.wall, middle.head<2>())
                                                   : deviationOfLevel(levels, middle.z());
  }
  const std::vector<std::set<int>> at = wallsAtVertices(model);
  model.covariances.assign(model.vertices.size(), Eigen::Matrix3d::Zero());
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    const double height = deviationOfLevel(levels, model.vertices[v].z());
    model.covariances[v].topLeftCorner<2, 2>() =
        crossing(walls, at[v], model.vertices[v].head<2>());
    model.covariances[v](2, 2) = height * height;
  }
}

}  // namespace storey
