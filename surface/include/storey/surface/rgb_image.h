// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey {

/// A colour image, 8 bits a channel; rows from the top, pixels from the left, red green blue.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> channels;  ///< 3 width height

  RgbImage() = default;
  RgbImage(int w, int h)
      : width(w),
        height(h),
        channels(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool empty() const { return channels.empty(); }
  std::uint8_t* at(int x, int y) { return channels.data() + index(x, y); }
  const std::uint8_t* at(int x, int y) const { return channels.data() + index(x, y); }

 private:
  std::size_t index(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
};

}  // namespace storey
