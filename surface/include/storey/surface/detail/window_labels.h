// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/rectified_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// What a texel is taken for when colours are learnt.
enum class TexelMark : char { Rest, Window, Neither };

/// 2 P - 1 for each texel of the raster (height x width), P the chance that it is of a window;
/// 0 where it is not seen.
using WindowScores = Eigen::ArrayXXf;

/// Scores of each view: the two classes' colours are learnt for each photo on its own, so that its
/// exposure does not matter. Of a view that shows too little of either class, all scores are 0.
std::vector<WindowScores> labelTexels(const TextureGrid& grid,
                                      const std::vector<RectifiedView>& views,
                                      const std::vector<TexelMark>& marks);

/// The mean over all views, sharp ones counting more.
WindowScores combineScores(const std::vector<RectifiedView>& views,
                           const std::vector<WindowScores>& scores);

}  // namespace storey::detail
