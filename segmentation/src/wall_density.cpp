// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_density.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace storey::detail {
namespace {

constexpr std::size_t kZones = 16;
constexpr std::size_t kSamples = 200;    // points of a zone
constexpr double kWanted = 10.0;         // points around one
constexpr double kLeastRadius = 4.0;     // noise deviations
constexpr double kRadiusStep = 1.4;      // the area doubles
constexpr double kMostRadius = 1.0 / 8;  // of the height of all

// The points by height.
std::vector<WallPoint> sortedByHeight(const std::vector<WallPoint>& points) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(points[i].z, i);
  std::sort(order.begin(), order.end());
  std::vector<WallPoint> sorted;
  sorted.reserve(points.size());
  for (const auto& [z, i] : order) sorted.push_back(points[i]);
  return sorted;
}

double pointsAround(const std::vector<WallPoint>& sorted, const WallPoint& center, double radius) {
  const auto below = [](const WallPoint& p, double z) { return p.z < z; };
  auto p = std::lower_bound(sorted.begin(), sorted.end(), center.z - radius, below);
  double count = -1.0;  // itself
  for (; p != sorted.end() && p->z <= center.z + radius; ++p) {
    const double dz = p->z - center.z;
    const double distance = (p->position - center.position).squaredNorm() + dz * dz;
    if (distance < radius * radius && p->normal.dot(center.normal) > kMinAgreement) count += 1.0;
  }
  return count;
}

}  // namespace

HeightDensity::HeightDensity(const std::vector<WallPoint>& points, const WallScale& scale)
    : densities_(kZones, scale.density) {
  if (points.empty()) return;
  const std::vector<WallPoint> sorted = sortedByHeight(points);
  low_ = sorted.front().z;
  const double height = sorted.back().z - low_;
  step_ = std::max(height / kZones, std::numeric_limits<double>::min());
  std::size_t end = 0;
  for (std::size_t k = 0; k < kZones; ++k) {
    const std::size_t begin = end;
    while (end < sorted.size() && zoneOf(sorted[end].z) == k) ++end;
    const std::size_t step = (end - begin) / kSamples + 1;
    double radius = std::max(kLeastRadius * scale.noise, std::sqrt(1.0 / scale.density));
    for (; begin < end; radius *= kRadiusStep) {
      std::vector<double> counts;
      for (std::size_t i = begin + step / 2; i < end; i += step) {
        counts.push_back(pointsAround(sorted, sorted[i], radius));
      }
      if (counts.empty()) break;
      const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
      std::nth_element(counts.begin(), middle, counts.end());
      densities_[k] = std::max(*middle, 1.0) / (M_PI * radius * radius);
      if (*middle >= kWanted || radius > kMostRadius * height) break;
    }
  }
}

double HeightDensity::least() const {
  return *std::min_element(densities_.begin(), densities_.end());
}

std::size_t HeightDensity::zoneOf(double z) const {
  return std::min(kZones - 1, static_cast<std::size_t>(std::max(0.0, (z - low_) / step_)));
}

}  // namespace storey::detail
