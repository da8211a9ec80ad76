// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_labels.h>

#include <string>
#include <vector>

namespace storey::detail {

/// A first grid of windows that nobody marked.
struct WindowProposal {
  std::string problem;  ///< why there is none; empty if there is one
  BandGrid bands;       ///< in texels of the raster
  WindowScores scores;  ///< that they were found in
};

/// The grid whose windows tell most about the colours of the facade's image.
///
/// Seeds are rectangles of a ladder of sizes that differ most from the frame about them, in images
/// of what is darker, or brighter, than some level. Each is extended as a mark would be: colours
/// that are commoner in it than elsewhere are window, a grid of rank one is fitted (`fitBandGrid`),
/// and both again from the grid. With c the colours of pixels in the windows and in the frames
/// about them, a quarter of a window wide, and w whether they are in windows, the grid of greatest
///
///     n (I(c; w) - I0) (m - 1) / m
///
/// is taken: n the number of these pixels, I the mutual information, I0 what any two places of a
/// wall differ by, m the number of windows, of which one is the pattern and the others repeat it.
/// Frames, not the whole facade: else anything large with colours of its own would win.
WindowProposal proposeGrid(const TextureGrid& grid, const std::vector<RectifiedView>& views);

/// The same among grids that a marked window is one of.
WindowProposal proposeGridWith(const TextureGrid& grid, const std::vector<RectifiedView>& views,
                               const Band& columns, const Band& rows);

}  // namespace storey::detail
