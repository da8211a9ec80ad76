// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rectified_views.h>
#include <storey/surface/window_detection.h>

#include <vector>

namespace storey::detail {

struct WindowDepth {
  double depth = 0.0;  ///< behind the facade, in the model's unit; 0: as the facade, painted
  bool known = false;  ///< photos show the same panes: their correlation is above a half
};

/// How far the panes lie behind the facade: the depth at which all photos agree best on what they
/// show there, by the mean normalised cross-correlation of all pairs of photos of a window. Only
/// what is seen through the opening counts. Tried are depths to half a window's width before and
/// behind the facade. 0 unless the windows agree better at the other depth by three times the
/// deviation of their mean, and it is more than a texel.
WindowDepth findDepth(const TextureGrid& grid, const FacadeSight& sight,
                      const std::vector<TexturePhoto>& photos,
                      const std::vector<RectifiedView>& views,
                      const std::vector<FacadeWindow>& windows);

}  // namespace storey::detail
