// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/texture_views.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// Sets `contrast`, `deviation` and `hidden` of all views of a facade. Colours times gains of the
/// views of a block are compared over the cells that both show (the largest of the cells' mean
/// differences). Each view is the middle of a group: the views within three radii of it, the
/// radius being that of the block's densest group (a view and the nearest quarter of the others),
/// but at least the median of the facade, 3 % of the brightness and 15 % of the contrast about the
/// block. The group with most votes stands for the facade: a vote for each view (less for
/// those of less than half the best quality, which show little but smear), and up to three
/// for a colour that is common where all photos agree. What is outside of it shows something else,
/// and so does what is a third of the limit away beside a block where the same photo shows
/// something else. But with fewer votes than three, or 40 % of the views, photos just differ
/// (reflections, parts that stand out of the plane), and none is taken to be hidden. Blocks of two
/// views or one tell nothing.
void findHidden(const TextureGrid& grid, const std::vector<Eigen::Array3f>& gains,
                std::vector<std::vector<BlockView>>& views);

/// The view of a photo in a list by photos, or nullptr.
const BlockView* findView(const std::vector<BlockView>& views, int photo);

}  // namespace storey::detail
