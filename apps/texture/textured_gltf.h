// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "export/glb_file.h"
#include "texture/texture_sheets.h"
#include "texture/textured_model.h"

namespace storey::texture {

/// A textured model as binary glTF 2.0 in the frame of `exports::writeGltf`: y up, about a local
/// origin. The images are JPEGs within the file, drawn as they are, unlit; facades that no photo
/// sees are plain grey. Faces are seen from the side that their facade's normal points to. The
/// attribute `_FACE` is the facade of a corner; `extras` of the node has the vertical.
exports::GlbFile toTexturedGlb(const io::PolygonSoup& soup, const ModelFacades& model,
                               const std::vector<FacadeTexture>& textures,
                               const TextureSheets& sheets, const Eigen::Vector3d& vertical);

}  // namespace storey::texture
