// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Real walls are not planes: frames, plaster and sills stand off by more than the noise of the
/// sensor. Scatter of wall points about the best vertical plane over a wall-sized neighbourhood.
/// \param positions, normals of points on walls, parallel; normals finite
/// \param radius of the neighbourhood, in the cloud's unit
/// \param noise of the points about their immediate neighbours, where the search starts
/// \param threads 0: all cores
/// \return robust standard deviation, the median over up to 400 places; `noise` where there are
/// none
double estimateWallRelief(const std::vector<Eigen::Vector3f>& positions,
                          const std::vector<Eigen::Vector3f>& normals, double radius, double noise,
                          unsigned int threads = 1);

/// The deviation of points about their walls that the later stages work with: the relief in a
/// neighbourhood of a twentieth of the extent where that is clearly more than the noise, else the
/// noise, and never less than 1e-5 of the extent.
double estimateWallNoise(const std::vector<Eigen::Vector3f>& positions,
                         const std::vector<Eigen::Vector3f>& normals, double noise, double extent,
                         unsigned int threads = 1);

}  // namespace storey::detail
