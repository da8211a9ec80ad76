// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <utility>
#include <vector>

namespace storey::detail {

/// \file
/// Which points near a line are of one flat wall along it. A line also passes near points of walls
/// that it crosses, of parallel walls that it leans over, and of walls further on. `points` and the
/// indices in `support` are as in `fitToSupport`; what is returned is a part of `support`, in
/// order.

/// Stretches along the line without a gap in the support.
std::vector<std::pair<double, double>> runsAlong(const std::vector<WallPoint>& points,
                                                 const std::vector<int>& support,
                                                 const WallScale& scale, const WallLine& line);

/// The heights at which most points keep to one level across the line: a storey may be set back by
/// a few deviations. Windows do not count as that, for at no height are they all of a wall.
std::vector<int> atMainHeights(const std::vector<WallPoint>& points,
                               const std::vector<int>& support, const WallScale& scale,
                               const WallLine& line);

/// Without the runs that turn against the line by more than their noise explains: they are of walls
/// that the line only crosses. \param by_normals those whose normals clearly do not turn stay:
/// panes that are set back in one end of a short wall turn its places alone
std::vector<int> withoutLeaningRuns(const std::vector<WallPoint>& points,
                                    const std::vector<int>& support, const WallScale& scale,
                                    const WallLine& line, bool by_normals = false);

/// The points that agree with the line through the fuller half of the support: walls of nearly the
/// same direction further on turn a line by their long lever.
std::vector<int> alongMainHalf(const std::vector<WallPoint>& points,
                               const std::vector<int>& support, const WallScale& scale,
                               const WallLine& line);

/// The longest stretch in which the points keep to one level across the line; of several, the one
/// with most points. Empty if none is as long as a twelfth of the support.
std::vector<int> flatStretch(const std::vector<WallPoint>& points, const std::vector<int>& support,
                             const WallScale& scale, const WallLine& line);

}  // namespace storey::detail
