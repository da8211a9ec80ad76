// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// For each block the place in its list of the view to take, -1 if it has none: the minimum by
/// alpha-expansion of
///     sum over blocks (1 - quality + deviation / 4 + 4 [hidden] + 4 (share not shown))
///     + 1/2 (number of neighbouring blocks with different photos).
std::vector<int> selectViews(const TextureGrid& grid,
                             const std::vector<std::vector<BlockView>>& views);

}  // namespace storey::detail
