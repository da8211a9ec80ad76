// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Factors for each block that make the photos selected on both sides of a seam meet: one factor a
/// photo does not, where lenses shade corners and walls shine. The logarithms x minimise
///     sum over neighbouring blocks a, b  (x_a - x_b - d_ab)^2  +  0.001 sum x_a^2,
/// d_ab being the logarithm of how much brighter b's photo shows the two blocks than a's, 0 if they
/// have the same photo: smooth within a photo's blocks, a step at their ends.
std::vector<Eigen::Array3f> levelSeams(const TextureGrid& grid,
                                       const std::vector<Eigen::Array3f>& gains,
                                       const std::vector<std::vector<BlockView>>& views,
                                       const std::vector<int>& selected);

}  // namespace storey::detail
