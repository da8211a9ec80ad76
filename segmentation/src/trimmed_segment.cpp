// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr int kRounds = 6;     // each at least halves what a wrong point tilts the line by
constexpr double kTrim = 3.0;  // standard deviations
constexpr double kMad =
    1.4826;  // of the median of |x| in a standard deviation, normal distribution

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

LineSegment fitTrimmedSegment(const std::vector<Eigen::Vector2d>& points,
                              const Eigen::Vector2d& outward, double prior_angle, double noise) {
  LineSegment segment = fitSegment(points, outward, prior_angle);
  for (int round = 0; round < kRounds && !points.empty(); ++round) {
    std::vector<double> distances;
    for (const Eigen::Vector2d& p : points) {
      distances.push_back(std::abs(segment.normal.dot(p - segment.start)));
    }
    const double gate = kTrim * std::max(noise, kMad * medianOf(distances));
    std::vector<Eigen::Vector2d> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (distances[i] <= gate) kept.push_back(points[i]);
    }
    const LineSegment trimmed = fitSegment(kept, outward, prior_angle);
    const bool settled = trimmed.support == segment.support && trimmed.start == segment.start &&
                         trimmed.end == segment.end;
    segment = trimmed;
    if (settled) break;
  }
  return segment;
}

}  // namespace storey::detail
