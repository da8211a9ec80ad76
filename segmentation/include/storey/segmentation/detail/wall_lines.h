// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/types.h>
#include <storey/segmentation/detail/method_steps.h>
#include <storey/segmentation/detail/wall_density.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

struct WallLineOptions {
  double min_area = 0.0;  ///< least supported area of a wall
  MethodSteps steps = {};
  unsigned int threads = 0;  ///< 0: all cores; the result is the same for any number
};

/// So many points are enough to find lines with.
constexpr std::size_t kLineSample = 250000;

/// Finds the wall lines of a whole building: an oriented Hough vote over all heights at once.
/// 1. Free pass: a point votes for all lines within `kVoteAngle` of its own, unsmoothed normal; the
///    line with most votes is fitted to its support, whose points and votes are taken away, and so
///    on.
/// 2. The dominant directions are the clusters of the angles of those lines: they are known to
///    hundredths of a degree, where normals know them to degrees.
/// 3. Locked pass: everything again with the directions fixed, so that only offsets are fitted.
///    Parallel walls a few deviations apart are told apart, where free lines lean over both.
/// 4. Free pass on what is left.
/// 5. Both again at heights with much fewer points than the rest, where cells have to be larger.
/// 6. A locked pass for facades with much fewer points than the others.
/// 7. Walls too short for the votes, where the points left lie densely along a known direction or a
///    perpendicular of one (`extractShortWalls`).
/// 8. Lines that duplicate stronger ones, or that others explain, are dropped.
/// \return lines by support, strongest first
std::vector<WallLine> findWallLines(const std::vector<WallPoint>& points, const WallScale& scale,
                                    const HeightDensity& density, const WallLineOptions& options);

/// With the density measured on the points.
inline std::vector<WallLine> findWallLines(const std::vector<WallPoint>& points,
                                           const WallScale& scale, const WallLineOptions& options) {
  return findWallLines(points, scale, HeightDensity(points, scale, options.threads), options);
}

/// The wall that each point is of: the line that is nearest to it among those within 3 noise
/// deviations that its normal confirms (within 60 degrees) and whose support is at its place, or
/// less than two support cells away from it. \return index into `lines`, -1: none
std::vector<int> assignToWalls(const std::vector<WallPoint>& points,
                               const std::vector<WallLine>& lines, const WallScale& scale);

}  // namespace storey::detail
