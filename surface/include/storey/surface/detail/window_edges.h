// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_labels.h>

#include <vector>

namespace storey::detail {

/// Moves the bands to where the edges of their windows are in all photos together: one width of all
/// columns, one height of all rows. With m the place of an edge measured in one photo at one
/// window, m0 where it should be, and s the photo's pixels a texel,
///
///     sum over windows, edges and photos of Huber(s (m - m0))
///
/// is least; the threshold is a pixel. Edges that show no step are left out.
BandGrid fitEdges(const std::vector<RectifiedView>& views, const std::vector<WindowScores>& scores,
                  const BandGrid& grid);

}  // namespace storey::detail
