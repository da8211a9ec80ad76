// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <storey/surface/facade_texturing.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/polygon_soup.h"
#include "texture/drawn_image.h"
#include "texture/texture_sheets.h"
#include "texture/textured_model.h"

namespace storey::texture {

/// Grey level of a channel at a place: waves of 6 and more units.
inline double paint(const Eigen::Vector3d& at, int channel) {
  return 128.0 + 60.0 * std::sin(at.x() + channel) + 40.0 * std::cos(0.7 * at.y() - 0.5 * at.z());
}

/// A model painted all over, in texels of 0.1.
struct PaintedModel {
  io::PolygonSoup soup;
  ModelFacades model;
  std::vector<FacadeTexture> textures;

  /// \param origin of the paint
  PaintedModel(io::PolygonSoup polygons, const Eigen::Vector3d& origin)
      : soup(std::move(polygons)), model(groupFacades("model", soup)) {
    FacadeTexturing texturing;
    texturing.setFacades(model.facades);
    texturing.setTexelSize(0.1);
    EXPECT_TRUE(texturing.texture(textures));
    for (FacadeTexture& t : textures) {
      for (int y = 0; y < t.image.height; ++y) {
        for (int x = 0; x < t.image.width; ++x) {
          const Eigen::Vector3d at =
              t.frame.point((x + 0.5) * t.texel, t.frame.height - (y + 0.5) * t.texel) - origin;
          for (int c = 0; c < 3; ++c) {
            t.image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(paint(at, c)));
          }
        }
      }
      t.states.assign(t.states.size(), TexelState::Seen);
    }
  }

  TextureSheets sheets() const {
    std::vector<RgbImage> drawn = drawnImages(textures);
    for (std::size_t f = 0; f < textures.size(); ++f) {
      if (textures[f].seenShare() == 0.0) drawn[f] = RgbImage();
    }
    return laySheets(drawn);
  }
};

/// Colour at a place of an image, (0, 0) being its upper left corner and (1, 1) its lower right
/// one.
inline Eigen::Array3d bilinear(const RgbImage& image, const Eigen::Vector2d& uv) {
  const Eigen::Array2d at(uv.x() * image.width - 0.5, uv.y() * image.height - 0.5);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Array2d corner = at.floor() + Eigen::Array2d(i % 2, i / 2);
    const double weight = (1.0 - (at - corner).abs()).prod();
    const int x = std::clamp(static_cast<int>(corner.x()), 0, image.width - 1);
    const int y = std::clamp(static_cast<int>(corner.y()), 0, image.height - 1);
    for (int c = 0; c < 3; ++c) sum[c] += weight * image.at(x, y)[c];
  }
  return sum;
}

}  // namespace storey::texture
