// SPDX-License-Identifier: BSD-3-Clause
#include "texture/drawn_image.h"

#include <algorithm>
#include <cmath>

namespace storey::texture {
namespace {

void stripeUnseen(const FacadeTexture& texture, RgbImage& image) {
  constexpr int kStripe = 4;  // texels
  constexpr std::uint8_t kLevels[] = {150, 185};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto texel = static_cast<std::size_t>(y * image.width + x);
      if (texture.states[texel] != TexelState::Unseen) continue;
      std::fill_n(image.at(x, y), 3, kLevels[(x + y) / kStripe % 2]);
    }
  }
}

/// Gives texels beside known ones the colour of one of them.
void growOnce(RgbImage& image, std::vector<char>& known) {
  const std::vector<char> before = known;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int here = y * image.width + x;
      if (before[static_cast<std::size_t>(here)] != 0) continue;
      for (const int step : {-1, 1, -image.width, image.width}) {
        const int from = here + step;
        const bool wraps = (step == -1 && x == 0) || (step == 1 && x + 1 == image.width);
        if (wraps || from < 0 || from >= image.width * image.height) continue;
        if (before[static_cast<std::size_t>(from)] == 0) continue;
        std::copy_n(image.channels.data() + 3 * from, 3, image.at(x, y));
        known[static_cast<std::size_t>(here)] = 1;
        break;
      }
    }
  }
}

/// An image, and which of its texels have a colour.
struct Drawn {
  RgbImage image;
  std::vector<char> known;
};

Drawn drawnImage(const FacadeTexture& texture) {
  constexpr int kRim = 2;  // texels
  Drawn drawn = {texture.image, {}};
  stripeUnseen(texture, drawn.image);
  for (const TexelState state : texture.states) drawn.known.push_back(state != TexelState::Outside);
  for (int pass = 0; pass < kRim; ++pass) growOnce(drawn.image, drawn.known);
  return drawn;
}

/// Whether a facade may be a pane in a hole of a wall: parallel, less deep than it is wide and
/// high, and not beyond the rectangle about the wall.
bool mayBePane(const FacadeFrame& pane, const FacadeFrame& wall) {
  constexpr double kParallel = 1.0 - 1e-6;  // cosine
  const double depth = std::abs(wall.normal().dot(pane.origin - wall.origin));
  if (pane.normal().dot(wall.normal()) < kParallel) return false;
  if (depth > std::min(pane.width, pane.height)) return false;
  const Eigen::Vector2d low = wall.local(pane.origin);
  return low.minCoeff() >= 0.0 && low.x() + pane.width <= wall.width &&
         low.y() + pane.height <= wall.height;
}

/// Copies a pane to where the wall's image knows no colour.
void showPane(const FacadeTexture& pane, const RgbImage& drawn, const FacadeTexture& wall,
              Drawn& image) {
  const Eigen::Vector2d low = wall.frame.local(pane.frame.origin) / wall.texel;
  const double top = wall.frame.height / wall.texel - low.y() - pane.frame.height / wall.texel;
  const int right = static_cast<int>(low.x() + pane.frame.width / wall.texel);
  const int bottom = static_cast<int>(top + pane.frame.height / wall.texel);
  for (int y = static_cast<int>(top); y <= std::min(bottom, image.image.height - 1); ++y) {
    for (int x = static_cast<int>(low.x()); x <= std::min(right, image.image.width - 1); ++x) {
      if (image.known[static_cast<std::size_t>(y * image.image.width + x)] != 0) continue;
      const Eigen::Vector3d point =
          wall.frame.point((x + 0.5) * wall.texel, wall.frame.height - (y + 0.5) * wall.texel);
      const Eigen::Vector2d at = pane.frame.local(point);
      const int column = static_cast<int>(std::floor(at.x() / pane.texel));
      const int row = static_cast<int>(std::floor((pane.frame.height - at.y()) / pane.texel));
      if (column < 0 || row < 0 || column >= drawn.width || row >= drawn.height) continue;
      std::copy_n(drawn.at(column, row), 3, image.image.at(x, y));
    }
  }
}

std::uint8_t levelOf(TexelState state) {
  switch (state) {
    case TexelState::Seen:
      return 255;
    case TexelState::Unseen:
      return 0;
    case TexelState::Filled:
      return 64;
    default:
      return 128;
  }
}

}  // namespace

std::vector<RgbImage> drawnImages(const std::vector<FacadeTexture>& textures) {
  std::vector<Drawn> drawn;
  for (const FacadeTexture& texture : textures) drawn.push_back(drawnImage(texture));
  std::vector<RgbImage> images;
  for (std::size_t w = 0; w < textures.size(); ++w) {
    Drawn wall = drawn[w];
    for (std::size_t p = 0; p < textures.size(); ++p) {
      if (p == w || !mayBePane(textures[p].frame, textures[w].frame)) continue;
      showPane(textures[p], drawn[p].image, textures[w], wall);
    }
    images.push_back(std::move(wall.image));
  }
  return images;
}

RgbImage maskOf(const FacadeTexture& texture) {
  RgbImage mask(texture.image.width, texture.image.height);
  for (std::size_t i = 0; i < texture.states.size(); ++i) {
    std::fill_n(mask.channels.data() + 3 * i, 3, levelOf(texture.states[i]));
  }
  return mask;
}

}  // namespace storey::texture
