// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace storey::detail {

/// The box that a building is in: what lies outside is further from nearly all of its points than
/// these are apart. It goes from the 1 % to the 99 % quantile of each coordinate, and on to either
/// side by the diagonal of that.
Eigen::AlignedBox3f mainBoxOf(const std::vector<Eigen::Vector3f>& positions);

}  // namespace storey::detail
