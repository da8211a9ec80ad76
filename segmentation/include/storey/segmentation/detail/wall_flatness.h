// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_points.h>

#include <utility>
#include <vector>

namespace storey::detail {

/// \file
/// Which points near a line are of one flat wall along it. A line also passes near points of walls
/// that it crosses, of parallel walls that it leans over, and of walls further on. What is returned
/// is a part of `support`, in order; `noise` is the deviation of the points about their walls.

/// Stretches along the line without a gap in the support.
std::vector<std::pair<double, double>> runsAlong(const LinePoints& support, const WallScale& scale);

/// The heights at which most points keep to one level across the line: a storey may be set back by
/// a few deviations. Windows do not count as that, for at no height are they all of a wall.
LinePoints atMainHeights(LinePoints support, double noise);

/// Without the runs that turn against the line by more than their noise explains: they are of walls
/// that the line only crosses. \param by_normals those whose normals clearly do not turn stay:
/// panes that are set back in one end of a short wall turn its places alone
LinePoints withoutLeaningRuns(const std::vector<WallPoint>& points, LinePoints support,
                              const WallScale& scale, const WallLine& line, bool by_normals);

/// The points that agree with the line through the fuller half of the support: walls of nearly the
/// same direction further on turn a line by their long lever.
LinePoints alongMainHalf(LinePoints support, double noise);

/// The longest stretch in which the points keep to one level across the line; of several, the one
/// with most points. Empty if none is as long as a twelfth of the support.
LinePoints flatStretch(LinePoints support, double noise);

}  // namespace storey::detail
