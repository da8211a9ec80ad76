// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

#include <string>
#include <vector>

#include "io/polygon_soup.h"

namespace storey::texture {

/// A model's polygons put together to facades: coplanar neighbours are one.
struct ModelFacades {
  std::vector<Facade> facades;
  std::vector<std::size_t> facade_of;  ///< of each of the soup's polygons
};

/// \throws io::Failure (BadInput) naming `path` if a polygon is none
ModelFacades groupFacades(const std::string& path, const io::PolygonSoup& soup);

/// Turns the facades to the cameras if most of the cameras are inside the model: then it is an
/// enclosed space, a yard or a room.
void turnToCameras(const std::vector<FacadePhoto>& photos, std::vector<Facade>& facades);

/// Writes model.obj, model.mtl and, for each facade k with texels,
///   textures/facade_kkk.png, what is seen at right angles, and
///   textures/facade_kkk_mask.png: white where a photo saw it, black where none did, grey off it;
/// and facades.json: for each facade its image, frame, size of a texel, and share seen.
/// \throws io::Failure (CannotCreate, IoError)
void writeTexturedModel(const std::string& folder, const io::PolygonSoup& soup,
                        const ModelFacades& model, const std::vector<FacadeTexture>& textures);

}  // namespace storey::texture
