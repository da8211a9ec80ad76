// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_labels.h>

namespace storey::detail {

/// What the photos say of a window.
struct WindowEvidence {
  double seen = 0.0;   ///< share of its area
  double score = 0.0;  ///< mean of what is seen, -1 (wall) to 1 (window)
  /// Mean chance that a texel inside is window times that that one in the wall about it, a quarter
  /// of the window wide, is not.
  double confidence = 0.0;
};

WindowEvidence evidenceOf(const WindowScores& scores, const Band& columns, const Band& rows);

}  // namespace storey::detail
