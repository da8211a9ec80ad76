// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_offset.h"

#include <storey/filters/detail/chunks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/position_hash.h"

namespace storey::io {
namespace {

constexpr double kLowQuantile = 0.01;
constexpr double kFarInExtents = 8.0;           // farther out than this an axis gets an offset
constexpr std::size_t kSampleSize = 1u << 16;   // points: quantiles within 0.2 % of their rank
constexpr double kMaxUsableCoordinate = 1e300;  // differences of such numbers stay finite
constexpr double kMinUsableExtent = 1e-290;     // and so do reciprocals of such powers of ten

using Axes = std::array<std::vector<double>, 3>;

/// As good as random, by the bits of the coordinates.
std::uint64_t drawOf(const double* position) {
  constexpr std::uint64_t kFactors[] = {0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u,
                                        0x94d049bb133111ebu};  // odd: no bit is lost
  std::uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, position + axis, sizeof bits);
    sum += bits * kFactors[axis];
  }
  return mixBits(sum);
}

/// Of the points from `begin` to `end`, every `stride`-th on average, chosen by its coordinates so
/// that the order of the points does not matter.
Axes samplePart(const std::vector<double>& positions, std::size_t begin, std::size_t end,
                std::uint64_t stride) {
  const std::uint64_t last_draw = ~std::uint64_t{0} / stride;
  Axes axes;
  for (std::size_t i = begin; i < end; ++i) {
    const double* const point = &positions[3 * i];
    if (drawOf(point) > last_draw) continue;
    const bool usable = std::all_of(point, point + 3, [](double coordinate) {
      return std::abs(coordinate) < kMaxUsableCoordinate;
    });
    if (!usable) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis].push_back(point[axis]);
  }
  return axes;
}

Axes sampleAxes(const std::vector<double>& positions, std::uint64_t stride, unsigned int threads) {
  using storey::detail::Chunks;
  const std::size_t size = positions.size() / 3;
  std::vector<Axes> parts(Chunks(size).count());
  storey::detail::forEachChunk(size, threads,
                               [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                                 parts[chunk] = samplePart(positions, begin, end, stride);
                               });
  Axes axes;
  for (const Axes& part : parts) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes[axis].insert(axes[axis].end(), part[axis].begin(), part[axis].end());
    }
  }
  return axes;
}

double quantile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

struct Range {
  Eigen::Vector3d low;
  Eigen::Vector3d high;

  double extent() const { return (high - low).maxCoeff(); }
};

/// From the quantile `share` to the quantile 1 - `share` of each axis.
Range rangeOf(Axes& axes, double share) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    range.low[axis] = quantile(axes[static_cast<std::size_t>(axis)], share);
    range.high[axis] = quantile(axes[static_cast<std::size_t>(axis)], 1.0 - share);
  }
  return range;
}

/// k 10^exponent, correctly rounded.
double roundNumber(double k, int exponent) {
  return exponent < 0 ? k / std::pow(10.0, -exponent) : k * std::pow(10.0, exponent);
}

}  // namespace

Eigen::Vector3d chooseOffset(const std::vector<double>& positions, unsigned int threads) {
  Axes axes = sampleAxes(positions, positions.size() / 3 / kSampleSize + 1, threads);
  if (axes[0].empty())
    axes = sampleAxes(positions, 1, threads);  // few places, and none of them sampled
  if (axes[0].empty()) return Eigen::Vector3d::Zero();

  Range range = rangeOf(axes, kLowQuantile);
  if (range.extent() == 0.0) range = rangeOf(axes, 0.0);  // nearly all points in one place
  const auto& [low, high] = range;
  const double extent = range.extent();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (!(extent > kMinUsableExtent)) return offset;
  const int exponent = static_cast<int>(std::floor(std::log10(extent)));
  for (int axis = 0; axis < 3; ++axis) {
    if (std::max(std::abs(low[axis]), std::abs(high[axis])) <= kFarInExtents * extent) continue;
    offset[axis] = roundNumber(std::floor(low[axis] / roundNumber(1.0, exponent)), exponent);
  }
  return offset;
}

}  // namespace storey::io
