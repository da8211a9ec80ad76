// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "io/failure.h"
#include "synth/polygon_mesh.h"
#include "texture/textured_model.h"

namespace storey::texture {

ModelFacades groupFacades(const std::string& path, const io::PolygonSoup& soup) {
  const synth::PolygonMesh mesh = synth::measurable(soup);
  if (mesh.num_broken > 0) {
    throw io::Failure(io::BadInput, path, "has polygons that are not flat and simple",
                      "reconstruct the model again");
  }
  ModelFacades model;
  model.facades.resize(mesh.num_polygons);
  model.guessed.assign(mesh.num_polygons, true);
  std::vector<Eigen::Vector3d> normals(mesh.num_polygons, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const auto facade = static_cast<std::size_t>(mesh.polygon_of[i]);
    model.facade_of.push_back(facade);
    if (!soup.polygons[i].hypothetical) model.guessed[facade] = false;
    normals[facade] += synth::areaNormal(soup, soup.polygons[i]);
    std::vector<Eigen::Vector3d> ring;
    for (const int corner : soup.polygons[i].corners) {
      ring.push_back(soup.vertices[static_cast<std::size_t>(corner)]);
    }
    model.facades[facade].rings.push_back(ring);
  }
  model.triangles = mesh.triangles.triangles;
  for (const int piece : mesh.piece_of) {
    model.facade_of_triangle.push_back(model.facade_of[static_cast<std::size_t>(piece)]);
  }
  for (std::size_t f = 0; f < normals.size(); ++f) {
    if (!(normals[f].norm() > 0.0)) {
      throw io::Failure(io::BadInput, path, "has a polygon without area",
                        "reconstruct the model again");
    }
    model.facades[f].normal = normals[f].normalized();
  }
  return model;
}

bool turnToCameras(const std::vector<FacadePhoto>& photos, std::vector<Facade>& facades) {
  std::size_t enclosed = 0;
  for (const FacadePhoto& photo : photos) enclosed += isEnclosed(facades, photo.camera.center());
  if (2 * enclosed <= photos.size()) return false;
  for (Facade& facade : facades) facade.normal *= -1.0;
  return true;
}

void forgetOpenLids(const ModelFacades& model, const Eigen::Vector3d& vertical,
                    std::vector<FacadeTexture>& textures) {
  constexpr double kDown = -0.5;  // of the normal: walls and level faces are far from it
  for (std::size_t f = 0; f < textures.size(); ++f) {
    if (!model.guessed[f] || model.facades[f].normal.dot(vertical) > kDown) continue;
    std::replace(textures[f].states.begin(), textures[f].states.end(), TexelState::Seen,
                 TexelState::Unseen);
    std::fill(textures[f].image.channels.begin(), textures[f].image.channels.end(),
              std::uint8_t{0});
  }
}

}  // namespace storey::texture
