// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <vector>

namespace storey::detail {

/// The image of a facade from the views selected for its blocks (place in the block's list, -1:
/// none), times the factors of their photos and blocks. The photos of the four blocks whose middles
/// are about a texel share it by bilinear weights, those left out that do not show it or that
/// something hides in its own block; where none is left, the best other photo of its block.
FacadeTexture composeTexture(const TextureGrid& grid, const FacadeSight& sight,
                             const std::vector<TexturePhoto>& photos,
                             const std::vector<Eigen::Array3f>& gains,
                             const std::vector<std::vector<BlockView>>& views,
                             const std::vector<int>& selected,
                             const std::vector<Eigen::Array3f>& corrections);

}  // namespace storey::detail
