// SPDX-License-Identifier: BSD-3-Clause
#include "view/projection.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace storey::view {

Projection projectionOf(View view) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  if (view == View::Top) return {x, y, z, 1.0};
  if (view == View::Front) return {x, z, -y, 1.0};
  const Eigen::Vector3d towards = (x - y + z).normalized();
  const Eigen::Vector3d right = (x + y).normalized();
  return {right, towards.cross(right), towards, std::sqrt(2.0 / 3.0)};
}

ProjectedBounds boundsOf(const Drawing& drawing, const Projection& projection) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ProjectedBounds bounds{Eigen::Vector3d::Constant(kInfinity),
                         Eigen::Vector3d::Constant(-kInfinity)};
  const auto include = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = projection.apply(p);
    bounds.min = bounds.min.cwiseMin(q);
    bounds.max = bounds.max.cwiseMax(q);
  };
  for (const PointSet& set : drawing.points) {
    for (const Eigen::Vector3f& p : set.positions) include(p.cast<double>());
  }
  for (const LineSet& set : drawing.lines) {
    for (const auto& line : set.lines) {
      for (const Eigen::Vector3d& p : line) include(p);
    }
  }
  for (const FacetSet& set : drawing.facets) {
    for (const Eigen::Vector3d& p : set.vertices) include(p);
  }
  for (const TexturedSet& set : drawing.textured) {
    for (const Eigen::Vector3d& p : set.vertices) include(p);
  }
  return bounds;
}

double roundLength(double length) {
  double power = std::pow(10.0, std::floor(std::log10(length)));
  if (power > length) power /= 10.0;  // the logarithm was rounded up
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

}  // namespace storey::view
