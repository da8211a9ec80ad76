// SPDX-License-Identifier: BSD-3-Clause
#include "synth/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "synth/random.h"

namespace storey::synth {
namespace {

using Eigen::Vector3d;

double distanceToSegment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  const double length_sq = along.squaredNorm();
  const double t = length_sq > 0.0 ? along.dot(point - from) / length_sq : 0.0;
  return (point - from - std::clamp(t, 0.0, 1.0) * along).norm();
}

}  // namespace

std::vector<double> triangleAreas(const TriangleMesh& mesh) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d u = mesh.corner(t, 1) - mesh.corner(t, 0);
    const Vector3d v = mesh.corner(t, 2) - mesh.corner(t, 0);
    areas.push_back(0.5 * u.cross(v).norm());
  }
  return areas;
}

std::vector<Vector3d> spreadOverSurface(const TriangleMesh& mesh, std::size_t count) {
  const std::vector<double> areas = triangleAreas(mesh);
  double total = 0.0;
  for (const double area : areas) {
    total += area;
  }
  std::vector<Vector3d> points;
  if (!(total > 0.0)) {
    return points;
  }
  constexpr std::uint64_t kSeed = 20160301;
  Random random(kSeed);
  std::size_t t = 0;
  double end = areas[0];  // running area at the end of triangle t
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    while (at * total > end && t + 1 < areas.size()) {
      end += areas[++t];
    }
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {  // the other half of the parallelogram, folded over
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d& a = mesh.corner(t, 0);
    points.push_back(a + u * (mesh.corner(t, 1) - a) + v * (mesh.corner(t, 2) - a));
  }
  return points;
}

double distanceToTriangle(const Vector3d& point, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double area_sq = normal.squaredNorm();
  if (area_sq > 0.0) {
    const bool over_ab = normal.dot((b - a).cross(point - a)) >= 0.0;
    const bool over_bc = normal.dot((c - b).cross(point - b)) >= 0.0;
    const bool over_ca = normal.dot((a - c).cross(point - c)) >= 0.0;
    if (over_ab && over_bc && over_ca) {
      return std::abs(normal.dot(point - a)) / std::sqrt(area_sq);
    }
  }
  return std::min({distanceToSegment(point, a, b), distanceToSegment(point, b, c),
                   distanceToSegment(point, c, a)});
}

}  // namespace storey::synth
