// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/rgb_image.h>

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// An image at full, half, quarter ... size (means of 2 x 2 pixels), to be sampled at any size.
class ImagePyramid {
 public:
  explicit ImagePyramid(const RgbImage& image);

  /// Colour at a place of the full image (centre of the first pixel at 0.5, 0.5), interpolated
  /// bilinearly in the level whose pixels are nearest to `size` full pixels wide.
  Eigen::Array3f sample(const Eigen::Vector2d& pixel, double size) const;

 private:
  std::vector<RgbImage> levels_;
};

}  // namespace storey::detail
