// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

struct WallLineOptions {
  double min_area = 0.0;  ///< least supported area of a wall
};

/// Finds the wall lines of a whole building: an oriented Hough vote over all heights at once.
/// 1. Free pass: a point votes for all lines within `kVoteAngle` of its own, unsmoothed normal; the
///    line with most votes is fitted to its support, whose points and votes are taken away, and so
///    on.
/// 2. The dominant directions are the clusters of the angles of those lines: they are known to
///    hundredths of a degree, where normals know them to degrees.
/// 3. Locked pass: everything again with the directions fixed, so that only offsets are fitted.
///    Parallel walls a few deviations apart are told apart, where free lines lean over both.
/// 4. Free pass on what is left.
/// 5. Lines that duplicate a stronger one are dropped.
/// \return lines by support, strongest first
std::vector<WallLine> findWallLines(const std::vector<WallPoint>& points, const WallScale& scale,
                                    const WallLineOptions& options);

}  // namespace storey::detail
