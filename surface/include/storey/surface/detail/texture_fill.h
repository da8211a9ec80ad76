// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

namespace storey::detail {

/// Shift, in texels, by which a facade's image repeats best: the period across and upwards. 0 where
/// no shift correlates by at least 0.3 over at least a quarter of what was seen.
struct Repetition {
  int across = 0;
  int upwards = 0;
};
Repetition findRepetition(const FacadeTexture& texture);

/// Gives the unseen texels of a facade the colour of a seen one a whole number of periods away, the
/// nearest that there is; where there is none, a smooth surface through the texels about the gap.
/// They become `Filled`; nothing changes if nothing was seen.
void fillUnseen(FacadeTexture& texture);

}  // namespace storey::detail
