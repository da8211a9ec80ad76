// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/slice_layout.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kNoisePerSlice = 10.0;     // deviations: walls stay thin against the slice
constexpr double kPointsPerWall = 30.0;     // in a slice, enough for a line
constexpr double kShortestWall = 1.0 / 50;  // of the extent, a guess
constexpr double kTailShare = 0.001;        // of the heights, at either end, may be ghosts
constexpr double kMargin = 0.05;            // of the distance of the quantiles
constexpr double kMaxDerivedSlices = 1000.0;

// Edge i is computed alike as top of slice i - 1 and bottom of slice i: no gap, no overlap.
std::vector<std::pair<double, double>> stack(double bottom, double thickness, std::size_t count) {
  std::vector<std::pair<double, double>> slices;
  for (std::size_t i = 0; i < count; ++i) {
    slices.emplace_back(bottom + static_cast<double>(i) * thickness,
                        bottom + static_cast<double>(i + 1) * thickness);
  }
  return slices;
}

}  // namespace

double deriveSliceThickness(const CloudScale& scale) {
  const double points_per_height = scale.density * scale.extent * kShortestWall;
  const double dense = points_per_height > 0.0 ? kPointsPerWall / points_per_height : 0.0;
  return std::max(kNoisePerSlice * scale.noise, dense);
}

std::pair<double, double> robustHeightRange(std::vector<double>& heights) {
  const auto tail = static_cast<std::ptrdiff_t>(kTailShare * static_cast<double>(heights.size()));
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double min = *lowest;
  const double max = *highest;
  std::nth_element(heights.begin(), heights.begin() + tail, heights.end());
  const double low = heights[static_cast<std::size_t>(tail)];
  std::nth_element(heights.begin(), heights.end() - 1 - tail, heights.end());
  const double high = *(heights.end() - 1 - tail);
  const double margin = kMargin * (high - low);
  return {std::max(min, low - margin), std::min(max, high + margin)};
}

std::vector<std::pair<double, double>> stackSlices(const std::pair<double, double>& range,
                                                   double thickness, std::size_t max_slices) {
  const double count = std::max(1.0, std::ceil((range.second - range.first) / thickness));
  if (!(count <= static_cast<double>(max_slices))) {
    return {};
  }
  auto slices = stack(range.first, thickness, static_cast<std::size_t>(count));
  slices.back().second = std::max(slices.back().second, range.second);  // against rounding
  return slices;
}

std::vector<std::pair<double, double>> divideIntoSlices(const std::pair<double, double>& range,
                                                        double min_thickness) {
  const double height = range.second - range.first;
  double count = 1.0;
  if (height > 0.0 && min_thickness > 0.0) {
    count = std::clamp(std::floor(height / min_thickness), 1.0, kMaxDerivedSlices);
  }
  auto slices = stack(range.first, height / count, static_cast<std::size_t>(count));
  slices.back().second = range.second;
  return slices;
}

std::ptrdiff_t sliceAt(const std::vector<std::pair<double, double>>& slices, double z) {
  if (slices.empty() || !(z >= slices.front().first && z <= slices.back().second)) {
    return -1;
  }
  const auto above = std::upper_bound(
      slices.begin(), slices.end(), z,
      [](double height, const std::pair<double, double>& slice) { return height < slice.first; });
  return above - slices.begin() - 1;
}

}  // namespace storey::detail
