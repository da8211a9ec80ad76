// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/morton_curve.h>

namespace storey::detail {
namespace {

constexpr std::size_t kSlices = 1024;    // of an axis, to see how long it is without outliers
constexpr std::size_t kFewShare = 1000;  // a thousandth of the positions at either end
constexpr std::size_t kMuchLonger = 64;

/// How many positions are in each slice of an axis.
std::size_t countSlices(const std::vector<Eigen::Vector3f>& positions, Eigen::Index axis,
                        double low, double scale, std::vector<std::size_t>& counts) {
  counts.assign(kSlices, 0);
  std::size_t total = 0;
  for (const Eigen::Vector3f& p : positions) {
    const double slice = (static_cast<double>(p[axis]) - low) * scale;
    if (slice >= 0.0 && slice <= kSlices) {
      ++counts[std::min(static_cast<std::size_t>(slice), kSlices - 1)];
      ++total;
    }
  }
  return total;
}

}  // namespace

MortonCurve::MortonCurve(const Eigen::AlignedBox3d& box) : low_(box.min()) {
  const double side = box.sizes().maxCoeff();
  constexpr double kLast = (1 << kAxisBits) - 1;
  if (side > 0.0) scale_ = kLast / side;
}

Eigen::AlignedBox3d withoutOutliers(const std::vector<Eigen::Vector3f>& distinct,
                                    Eigen::AlignedBox3d box) {
  std::vector<std::size_t> counts;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    while (true) {
      const double low = box.min()[axis];
      const double scale = kSlices / (box.max()[axis] - low);
      if (!std::isfinite(scale)) break;
      const std::size_t total = countSlices(distinct, axis, low, scale, counts);
      if (total == 0) break;  // rounding left out the one place that nearly all share
      const std::size_t few = total / kFewShare;
      std::size_t first = 0;
      std::size_t last = kSlices - 1;
      for (std::size_t n = counts[first]; n <= few; n += counts[++first]) {
      }
      for (std::size_t n = counts[last]; n <= few; n += counts[--last]) {
      }
      if (last + 1 - first > kSlices / kMuchLonger) break;
      box.min()[axis] = low + static_cast<double>(first) / scale;
      box.max()[axis] = low + static_cast<double>(last + 1) / scale;
    }
  }
  return box;
}

}  // namespace storey::detail
