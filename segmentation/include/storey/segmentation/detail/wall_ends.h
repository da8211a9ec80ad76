// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_density.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

/// Where a wall ends over some height.
struct WallEnd {
  Eigen::Vector2d place;
  Eigen::Vector2d normal;  ///< of the wall
  Eigen::Vector2d onward;  ///< along the wall, to where it does not go on; unit
  double z_min = 0.0;
  double z_max = 0.0;
  double height = 0.0;  ///< of the bands in which it does, less those in which it does not
};

/// Least height over which walls end at a place, noise deviations: the outline of a hole may go
/// straight up for less.
constexpr double kMinEndHeight = 40.0;

/// How far the end of a wall may be off, noise deviations.
constexpr double kEndReach = 4.0;

/// The shortest stretch of a wall that has ends, noise deviations.
constexpr double kMinEndedRun = 15.0;

/// The places at which walls end, each over at least `kMinEndHeight`. Ends are found in bands of
/// height, for what hides a part of a wall has any outline, and joined where bands above each other
/// agree to `kEndReach`.
std::vector<WallEnd> findWallEnds(const std::vector<WallLine>& walls,
                                  const std::vector<WallPoint>& points, const WallScale& scale,
                                  const HeightDensity& density, unsigned int threads = 0);

}  // namespace storey::detail
