// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/method_steps.h>
#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

struct SupportOptions {
  bool fit_direction = true;  ///< false: the direction is locked, only the offset is fitted
  bool by_normals = false;    ///< whether normals decide if a part of the support turns
  double min_area = 0.0;      ///< least supported area before a free line is grown along its wall
  MethodSteps steps = {};
};

/// Finds what supports a line among `candidates` (indices into `points`, all of them free and with
/// a fitting normal), fits the line to it robustly, and repeats until it settles. The support is of
/// one flat wall: what lies near the line but is of walls that it crosses, of parallel ones or of
/// others further on is cut off, and so is one that goes on at a small angle (`onOneSideOfBend`).
/// There is none if
/// - no cells are filled well enough,
/// - nearly all of it turns against the line, so that it leans over two walls or passes through
///   clutter: such a line is refused rather than turned, for walls have better guesses of their
///   own,
/// - the direction is locked and much of it is not flat along it, or
/// - the points fill the space beside the line about as densely as they do the line: a tree.
/// \param line a first guess, good to about two deviations of noise; refined in place
/// \return the supporting points, ascending; empty if there is no support
std::vector<int> fitToSupport(const std::vector<WallPoint>& points,
                              const std::vector<int>& candidates, const WallScale& scale,
                              const SupportOptions& options, WallLine& line);

/// Side of the cells that support is counted in: wide against the noise, and holding six points.
double supportCellSize(const WallScale& scale);

}  // namespace storey::detail
