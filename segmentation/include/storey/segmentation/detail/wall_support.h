// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <vector>

namespace storey::detail {

struct SupportOptions {
  bool fit_direction = true;  ///< false: the direction is locked, only the offset is fitted
};

/// Finds what supports a line among `candidates` (indices into `points`, all of them free and with
/// a fitting normal), fits the line to it robustly, and repeats until it settles. A line that
/// leans over two walls is cut down to the longest stretch where the points lie flat on it.
/// \param line a first guess, good to about two deviations of noise; refined in place
/// \return the supporting points, ascending; empty if there is no support
std::vector<int> fitToSupport(const std::vector<WallPoint>& points,
                              const std::vector<int>& candidates, const WallScale& scale,
                              const SupportOptions& options, WallLine& line);

/// Side of the cells that support is counted in: wide against the noise, and holding six points.
double supportCellSize(const WallScale& scale);

}  // namespace storey::detail
