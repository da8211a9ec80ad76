// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/rgb_image.h>

#include <vector>

namespace storey::texture {

/// Where an image lies on a sheet: its texel (x, y) is at (left + x / shrink, top + y / shrink).
struct SheetPlace {
  int sheet = -1;  ///< -1: on none
  int left = 0;    ///< texels, from the sheet's upper left corner
  int top = 0;
  int shrink = 1;  ///< texels of the image, along a side, that one of the sheet stands for
};

/// The images of a model on as few sheets as graphics cards like, none larger than they take.
struct TextureSheets {
  std::vector<RgbImage> sheets;
  std::vector<SheetPlace> places;  ///< of each image
};

/// Up to 16 images get a sheet each; more are laid side by side, with a border of their own colours
/// about each. Images beyond 4096 texels are halved until they are not. Empty images get no place.
TextureSheets laySheets(std::vector<RgbImage> images);

}  // namespace storey::texture
