// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Places on a facade's raster, in texels: x to the right, y down from the upper left corner.
using RasterQuad = std::vector<Eigen::Vector2d>;

/// A facade as one photo shows it, at right angles. Texels are stored by rows.
struct RectifiedView {
  int photo = -1;
  double sharpness = 0.0;  ///< pixels of the photo a texel, in the median over what is seen
  std::vector<Eigen::Array3f> colors;
  std::vector<char> seen;
};

/// The photos that show at least a twentieth of the facade, a third as sharp as the sharpest one or
/// better, by their index.
std::vector<RectifiedView> rectifyViews(const TextureGrid& grid, const FacadeSight& sight,
                                        const std::vector<TexturePhoto>& photos);

}  // namespace storey::detail
