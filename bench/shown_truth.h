// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey::bench {

/// What the points of a cloud show of the true model.
struct ShownTruth {
  std::size_t hidden_walls = 0;          ///< wall polygons that next to no points are of
  std::vector<Eigen::Vector3d> corners;  ///< at which two walls meet that have points
};

/// A wall is hidden if it has less than 3 % of the points that its area would have in a clean
/// cloud: they lie in its outline, within 3 deviations of the noise, and their normals agree to 60
/// degrees. Points of other walls that come that near count too, so that a wall in front of another
/// passes for shown. \param positions, normals of the points of the building, in the model's frame
/// \param density points per unit of wall area in the clean cloud
ShownTruth findShownTruth(const PolyhedralModel& truth,
                          const std::vector<Eigen::Vector3d>& positions,
                          const std::vector<Eigen::Vector3d>& normals, double noise,
                          double density);

}  // namespace storey::bench
