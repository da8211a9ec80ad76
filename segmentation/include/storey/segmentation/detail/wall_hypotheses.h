// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_density.h>
#include <storey/segmentation/detail/wall_ends.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

struct WallHypotheses {
  std::vector<PlanLine> lines;
  std::vector<WallEnd> ends;  ///< those that a line passes
};

/// Lines for walls that were not seen. Where one is missing, its neighbours end in nothing: at one
/// place over much of a height (`WallEnd`), where no other wall was seen. A line explains such
/// ends: one of a known direction through two of them at common heights; an end that is left alone
/// gets a line of every other direction, and one in the direction from it to another such end. What
/// ends over most height comes first. No more than ten of either kind join ends, and 30 go through
/// ends left alone: each end has one, of the direction commonest among the walls, before any has
/// two.
/// Where all walls meet, there are none: lines that explain nothing would cut corners.
/// \param corner_gap length by which the points of walls end short of corners
WallHypotheses hypothesiseLines(const std::vector<WallLine>& walls,
                                const std::vector<WallPoint>& points, const WallScale& scale,
                                const HeightDensity& density, double corner_gap,
                                unsigned int threads = 0);

}  // namespace storey::detail
