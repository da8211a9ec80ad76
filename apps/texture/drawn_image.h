// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

namespace storey::texture {

/// A facade's image to be drawn on a model: what no photo saw is striped grey, and the colours at
/// the facade's edge go on beyond it by two texels, for renderers interpolate.
RgbImage drawnImage(const FacadeTexture& texture);

/// White where a photo saw the facade, black where none did, dark grey where that was filled, grey
/// off the facade.
RgbImage maskOf(const FacadeTexture& texture);

}  // namespace storey::texture
