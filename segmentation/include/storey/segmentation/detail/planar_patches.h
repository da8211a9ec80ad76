// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/oriented_point.h>
#include <storey/segmentation/detail/wall_points.h>

#include <cstdint>
#include <vector>

namespace storey::detail {

/// Planar patches of points, found greedily from the cells of a grid whose normals agree best: a
/// patch grows through neighbouring cells by points within 3 noise deviations of its plane whose
/// normals lie within 30 degrees of it, and is fitted again whenever it has doubled. A point is of
/// one patch at most.
struct PlanarPatches {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> of;  ///< of each point
  std::vector<double> area;       ///< of each patch: of the cells with points of it
  std::vector<double> share;      ///< of each patch, of the points in these cells
};

/// \param counts parallel to the points: those that take part \param threads 0: all cores
PlanarPatches findPlanarPatches(const std::vector<OrientedPoint>& points,
                                const std::vector<char>& counts, const WallScale& scale,
                                unsigned int threads = 1);

}  // namespace storey::detail
