// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/image_pyramid.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

RgbImage halved(const RgbImage& image) {
  RgbImage half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const std::uint8_t* const above = image.at(2 * x, 2 * y);
      const std::uint8_t* const below = image.at(2 * x, 2 * y + 1);
      for (int c = 0; c < 3; ++c) {
        half.at(x, y)[c] =
            static_cast<std::uint8_t>((above[c] + above[c + 3] + below[c] + below[c + 3] + 2) / 4);
      }
    }
  }
  return half;
}

}  // namespace

ImagePyramid::ImagePyramid(const RgbImage& image) : levels_{image} {
  while (std::min(levels_.back().width, levels_.back().height) >= 4) {
    levels_.push_back(halved(levels_.back()));
  }
}

Eigen::Array3f ImagePyramid::sample(const Eigen::Vector2d& pixel, double size) const {
  const int top = static_cast<int>(levels_.size()) - 1;
  const int level = size > 1.0 ? std::min(static_cast<int>(std::lround(std::log2(size))), top) : 0;
  const RgbImage& image = levels_[static_cast<std::size_t>(level)];
  const double scale = 1.0 / (1 << level);
  const double x = std::clamp(pixel.x() * scale - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp(pixel.y() * scale - 0.5, 0.0, image.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(image.width - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(image.height - 2, 0));
  const auto u = static_cast<float>(x - x0);
  const auto v = static_cast<float>(y - y0);
  const std::uint8_t* const above = image.at(x0, y0);
  const std::uint8_t* const below = image.at(x0, std::min(y0 + 1, image.height - 1));
  const int next = image.width > 1 ? 3 : 0;
  Eigen::Array3f color;
  for (int c = 0; c < 3; ++c) {
    color[c] = (1.0f - v) * ((1.0f - u) * above[c] + u * above[c + next]) +
               v * ((1.0f - u) * below[c] + u * below[c + next]);
  }
  return color;
}

}  // namespace storey::detail
