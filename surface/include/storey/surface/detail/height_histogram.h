// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// The points of bins that are not empty, bottom to top.
struct CountedHeights {
  double width = 0.0;           ///< of a bin
  std::vector<double> heights;  ///< of the middles
  std::vector<double> counts;
  std::vector<double> before = {0.0};  ///< points of the bins below each, and of all

  std::size_t size() const { return heights.size(); }
  double total() const { return before.back(); }
  double below(double z) const;  ///< points, spread evenly over their bins
  void append(double height, double count);
};

/// Counts the heights of points in bins of at most an eighth of the noise: a bin's middle is off by
/// a 28th of the noise, which adds a thousandth to its variance.
class HeightHistogram {
 public:
  HeightHistogram() = default;
  HeightHistogram(double low, double high, double noise);

  /// \param height within the range; one beyond it counts at its end
  void add(double height);
  HeightHistogram& operator+=(const HeightHistogram& other);  ///< of the same range

  std::size_t total() const;
  CountedHeights ascending() const;
  CountedHeights mirrored() const;  ///< upside down, about 0

 private:
  double middleOf(std::size_t bin) const {
    return low_ + (static_cast<double>(bin) + 0.5) * width_;
  }

  double low_ = 0.0;
  double width_ = 1.0;
  std::vector<std::uint32_t> counts_;
};

}  // namespace storey::detail
