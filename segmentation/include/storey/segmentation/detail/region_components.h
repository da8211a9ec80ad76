// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// The connected components of the graph that links points of equal label whose distance is at most
/// `radius`. Exact; O(n log n) whatever the density: within a cell of the grid all points are
/// linked, and two cells are compared by halving their boxes.
/// \param labels parallel to `points` \param radius > 0
/// \return a number for each point, equal for points of one component: the least number of a point
/// in it
std::vector<std::size_t> labeledComponents(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::uint32_t>& labels, double radius);

}  // namespace storey::detail
