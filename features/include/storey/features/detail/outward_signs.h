// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// What `OutwardNormalOrientation` decides for the points, parallel to them.
struct OutwardSigns {
  std::vector<signed char> sign;  ///< -1: turn the normal
  std::vector<float> confidence;  ///< [0, 1]
  double wall_confidence = 0.0;   ///< mean over the points of walls
};

/// \param positions, normals z is up; normals unit \param side of a voxel, > 0
OutwardSigns findOutwardSigns(const std::vector<Eigen::Vector3d>& positions,
                              const std::vector<Eigen::Vector3d>& normals, double side,
                              int num_threads);

}  // namespace storey::detail
