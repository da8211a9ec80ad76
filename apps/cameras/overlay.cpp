// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/overlay.h"

#include <algorithm>
#include <cmath>

namespace storey::cameras {
namespace {

constexpr double kDotShare = 1.0 / 1500.0;  // radius of a dot, of the image's longer side

void drawDot(RgbImage& image, const Eigen::Vector2d& pixel, int radius, double nearness) {
  const int cx = static_cast<int>(pixel.x());
  const int cy = static_cast<int>(pixel.y());
  for (int y = std::max(cy - radius, 0); y <= std::min(cy + radius, image.height - 1); ++y) {
    for (int x = std::max(cx - radius, 0); x <= std::min(cx + radius, image.width - 1); ++x) {
      std::uint8_t* const p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(std::lround(255.0 * nearness));
      p[1] = 0;
      p[2] = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - nearness)));
    }
  }
}

}  // namespace

RgbImage drawPoints(const CloudPoints& cloud, const Camera& camera, const RgbImage& image) {
  RgbImage picture = image;
  for (std::uint8_t& c : picture.channels) c = static_cast<std::uint8_t>(128 + c / 2);
  const std::vector<std::size_t> shown = shownPoints(cloud, camera);
  std::vector<double> depths;
  for (const std::size_t i : shown) depths.push_back(camera.depth(cloud.positions[i]));
  if (depths.empty()) return picture;
  const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
  const int radius = static_cast<int>(std::lround(kDotShare * std::max(image.width, image.height)));
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const double range = *farthest - *nearest;
    const double nearness = range > 0.0 ? (*farthest - depths[k]) / range : 1.0;
    drawDot(picture, *camera.project(cloud.positions[shown[k]]), radius, nearness);
  }
  return picture;
}

}  // namespace storey::cameras
