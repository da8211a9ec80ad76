// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/grid_cells.h>
#include <storey/segmentation/detail/oriented_point.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace storey::detail {

/// The cubes of a grid that points lie in, numbered as they come, and the number of each point's.
struct PointCubes {
  static constexpr std::uint32_t kNone = 0xffffffff;

  GridCells cells;
  std::vector<std::uint32_t> of;  ///< `kNone` for points that do not count
};

/// The cube at a position.
GridCell cubeAt(const Eigen::Vector3f& position, double side);

/// \param counts whether a point takes part; called from several threads
/// \param threads 0: all cores
PointCubes sortIntoCubes(const std::vector<OrientedPoint>& points, double side,
                         const std::function<bool(std::size_t)>& counts, unsigned int threads);

}  // namespace storey::detail
