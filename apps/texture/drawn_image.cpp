// SPDX-License-Identifier: BSD-3-Clause
#include "texture/drawn_image.h"

#include <algorithm>

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

RgbImage drawnImage(const FacadeTexture& texture) {
  constexpr int kRim = 2;  // texels
  RgbImage image = texture.image;
  stripeUnseen(texture, image);
  std::vector<char> known;
  for (const TexelState state : texture.states) known.push_back(state != TexelState::Outside);
  for (int pass = 0; pass < kRim; ++pass) growOnce(image, known);
  return image;
}

RgbImage maskOf(const FacadeTexture& texture) {
  RgbImage mask(texture.image.width, texture.image.height);
  for (std::size_t i = 0; i < texture.states.size(); ++i) {
    std::fill_n(mask.channels.data() + 3 * i, 3, levelOf(texture.states[i]));
  }
  return mask;
}

}  // namespace storey::texture
