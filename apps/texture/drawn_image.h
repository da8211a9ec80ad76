// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

#include <vector>

namespace storey::texture {

/// The images of facades to be drawn on a model and looked at. What no photo saw is striped grey;
/// colours at a facade's edge go on beyond it by two texels, for renderers interpolate; and holes
/// of walls show the panes that lie in them, as who looks at right angles sees them.
std::vector<RgbImage> drawnImages(const std::vector<FacadeTexture>& textures);

/// White where a photo saw the facade, black where none did, dark grey where that was filled, grey
/// off the facade.
RgbImage maskOf(const FacadeTexture& texture);

}  // namespace storey::texture
