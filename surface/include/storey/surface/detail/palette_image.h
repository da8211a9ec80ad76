// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rectified_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// A facade in a few colours, coarsely, as most photos show it.
struct PaletteImage {
  static constexpr int kUnseen = -1;

  int step = 1;  ///< side of a pixel, in texels of the raster it was made from
  /// Of each pixel (rows from the top) the index of its colour, in the order of brightness.
  Eigen::ArrayXXi colors;
  int num_colors = 0;
};

/// Of each pixel, the median over the photos, their exposures levelled; then the nearest of the
/// means that Lloyd's algorithm finds, from groups of equal size in the order of brightness on.
/// \param max_pixels pixels of the image, about
PaletteImage paletteImage(const TextureGrid& grid, const std::vector<RectifiedView>& views,
                          double max_pixels);

}  // namespace storey::detail
