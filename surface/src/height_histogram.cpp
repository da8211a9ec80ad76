// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/height_histogram.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kBinsPerNoise = 8.0;

}  // namespace

void CountedHeights::append(double height, double count) {
  heights.push_back(height);
  counts.push_back(count);
  before.push_back(before.back() + count);
}

double CountedHeights::below(double z) const {
  const auto bin = std::lower_bound(heights.begin(), heights.end(), z - 0.5 * width);
  if (bin == heights.end()) return total();
  const auto i = static_cast<std::size_t>(bin - heights.begin());
  const double share = std::clamp((z - heights[i]) / width + 0.5, 0.0, 1.0);
  return before[i] + share * counts[i];
}

HeightHistogram::HeightHistogram(double low, double high, double noise) : low_(low) {
  const double bins = std::max(1.0, std::ceil(kBinsPerNoise * (high - low) / noise));
  width_ = high > low ? (high - low) / bins : noise;
  counts_.resize(static_cast<std::size_t>(bins));
}

void HeightHistogram::add(double height) {
  const double last = static_cast<double>(counts_.size() - 1);
  ++counts_[static_cast<std::size_t>(std::clamp((height - low_) / width_, 0.0, last))];
}

HeightHistogram& HeightHistogram::operator+=(const HeightHistogram& other) {
  for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] += other.counts_[b];
  return *this;
}

std::size_t HeightHistogram::total() const {
  std::size_t sum = 0;
  for (const std::uint32_t count : counts_) sum += count;
  return sum;
}

CountedHeights HeightHistogram::ascending() const {
  CountedHeights result;
  result.width = width_;
  for (std::size_t b = 0; b < counts_.size(); ++b) {
    if (counts_[b] > 0) result.append(middleOf(b), counts_[b]);
  }
  return result;
}

CountedHeights HeightHistogram::mirrored() const {
  CountedHeights result;
  result.width = width_;
  for (std::size_t b = counts_.size(); b-- > 0;) {
    if (counts_[b] > 0) result.append(-middleOf(b), counts_[b]);
  }
  return result;
}

}  // namespace storey::detail
