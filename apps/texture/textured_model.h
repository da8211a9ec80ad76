// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

#include <array>
#include <string>
#include <vector>

#include "io/polygon_soup.h"

namespace storey::texture {

/// A model's polygons put together to facades: coplanar neighbours are one.
struct ModelFacades {
  std::vector<Facade> facades;
  std::vector<std::size_t> facade_of;         ///< of each of the soup's polygons
  std::vector<std::array<int, 3>> triangles;  ///< over the soup's vertices
  std::vector<std::size_t> facade_of_triangle;
  std::vector<bool> guessed;  ///< of each facade: points were seen on none of its polygons, or few
};

/// \throws io::Failure (BadInput) naming `path` if a polygon is none
ModelFacades groupFacades(const std::string& path, const io::PolygonSoup& soup);

/// Turns the facades to the cameras if most of the cameras are inside the model: then it is an
/// enclosed space, a yard or a room. \return whether it is
bool turnToCameras(const std::vector<FacadePhoto>& photos, std::vector<Facade>& facades);

/// Makes level facades that look down and on which hardly a point was seen unseen: the lid that
/// closes the model of a yard is sky in the photos. \param vertical unit, upwards
void forgetOpenLids(const ModelFacades& model, const Eigen::Vector3d& vertical,
                    std::vector<FacadeTexture>& textures);

/// Writes textured.obj, textured.mtl, textured.glb (`toTexturedGlb`) and, for each facade k,
///   textures/facade_kkk.png, the facade seen at right angles (`drawnImages`), and
///   textures/facade_kkk_mask.png, what of it was seen (`maskOf`);
/// and facades.json: for each facade its image, frame, size of a texel, share seen, and polygons of
/// textured.obj. The model and the images are shown in report.html, which is made if there is none.
/// \param vertical unit, upwards
/// \throws io::Failure (CannotCreate, IoError)
void writeTexturedModel(const std::string& folder, const io::PolygonSoup& soup,
                        const ModelFacades& model, const std::vector<FacadeTexture>& textures,
                        const Eigen::Vector3d& vertical);

}  // namespace storey::texture
