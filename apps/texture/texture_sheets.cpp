// SPDX-License-Identifier: BSD-3-Clause
#include "texture/texture_sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey::texture {
namespace {

constexpr int kLargestSide = 4096;  // texels: what every graphics card takes
constexpr std::size_t kFew = 16;    // images: so many a program can bind at a time
constexpr int kBorder = 4;          // texels: two halvings of the sheet mix no two images

/// Means of 2 x 2 texels; at odd ends of what there is.
RgbImage halved(const RgbImage& image) {
  RgbImage half((image.width + 1) / 2, (image.height + 1) / 2);
  for (int y = 0; y < half.height; ++y) {
    const int y2 = std::min(2 * y + 1, image.height - 1);
    for (int x = 0; x < half.width; ++x) {
      const int x2 = std::min(2 * x + 1, image.width - 1);
      for (int c = 0; c < 3; ++c) {
        const int sum = image.at(2 * x, 2 * y)[c] + image.at(x2, 2 * y)[c] +
                        image.at(2 * x, y2)[c] + image.at(x2, y2)[c];
        half.at(x, y)[c] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

/// Rows of images, the highest first, on sheets about as wide as high.
class Shelves {
 public:
  explicit Shelves(const std::vector<RgbImage>& images) {
    double area = 0.0;
    int widest = 0;
    for (const RgbImage& image : images) {
      if (image.empty()) continue;
      area += static_cast<double>(image.width + 2 * kBorder) * (image.height + 2 * kBorder);
      widest = std::max(widest, image.width + 2 * kBorder);
    }
    width_ = std::clamp(static_cast<int>(std::ceil(std::sqrt(area))), widest, kLargestSide);
  }

  /// Images are to come by falling height.
  void add(const RgbImage& image, SheetPlace& place) {
    const int width = image.width + 2 * kBorder;
    const int height = image.height + 2 * kBorder;
    if (x_ + width > width_) {
      x_ = 0;
      top_ += shelf_;
      shelf_ = 0;
    }
    if (heights_.empty() || top_ + height > kLargestSide) {
      heights_.push_back(0);
      x_ = top_ = shelf_ = 0;
    }
    place.sheet = static_cast<int>(heights_.size()) - 1;
    place.left = x_ + kBorder;
    place.top = top_ + kBorder;
    x_ += width;
    shelf_ = std::max(shelf_, height);
    heights_.back() = std::max(heights_.back(), top_ + height);
  }

  std::vector<RgbImage> emptySheets() const {
    std::vector<RgbImage> sheets;
    for (const int height : heights_) sheets.emplace_back(width_, height);
    return sheets;
  }

 private:
  int width_ = 0;
  int x_ = 0;
  int top_ = 0;
  int shelf_ = 0;  // height of the row
  std::vector<int> heights_;
};

/// Copies an image and its outermost texels over the border about it.
void paste(const RgbImage& image, const SheetPlace& place, RgbImage& sheet) {
  for (int y = -kBorder; y < image.height + kBorder; ++y) {
    for (int x = -kBorder; x < image.width + kBorder; ++x) {
      const auto* const from =
          image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
      std::copy_n(from, 3, sheet.at(place.left + x, place.top + y));
    }
  }
}

}  // namespace

TextureSheets laySheets(std::vector<RgbImage> images) {
  TextureSheets laid;
  laid.places.resize(images.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].empty()) continue;
    order.push_back(i);
    while (std::max(images[i].width, images[i].height) + 2 * kBorder > kLargestSide) {
      images[i] = halved(images[i]);
      laid.places[i].shrink *= 2;
    }
  }
  if (order.size() <= kFew) {
    for (const std::size_t i : order) {
      laid.places[i].sheet = static_cast<int>(laid.sheets.size());
      laid.sheets.push_back(std::move(images[i]));
    }
    return laid;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return images[a].height > images[b].height;
  });
  Shelves shelves(images);
  for (const std::size_t i : order) shelves.add(images[i], laid.places[i]);
  laid.sheets = shelves.emptySheets();
  for (const std::size_t i : order) {
    paste(images[i], laid.places[i], laid.sheets[static_cast<std::size_t>(laid.places[i].sheet)]);
  }
  return laid;
}

}  // namespace storey::texture
