// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/wall_density.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
class SortedPoints {
 public:
  explicit SortedPoints(const std::vector<WallPoint>& points) {
    for (std::vector<double>* list : {&x_, &y_, &heights_, &normal_x_, &normal_y_}) {
      list->reserve(points.size());
    }
    for (const auto& [z, i] : orderOf(points)) {
      x_.push_back(points[i].position.x());
      y_.push_back(points[i].position.y());
      heights_.push_back(z);
      normal_x_.push_back(points[i].normal.x());
      normal_y_.push_back(points[i].normal.y());
    }
  }

  const std::vector<double>& heights() const { return heights_; }

  // The median density around some points of a range, in the first radius with enough points.
  double densityAround(std::size_t begin, std::size_t end, const WallScale& scale,
                       double most_radius) const {
    const std::size_t step = (end - begin) / kSamples + 1;
    double radius = std::max(kLeastRadius * scale.noise, std::sqrt(1.0 / scale.density));
    while (true) {
      std::vector<double> counts;
      for (std::size_t i = begin + step / 2; i < end; i += step) {
        counts.push_back(countAround(i, radius));
      }
      const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
      std::nth_element(counts.begin(), middle, counts.end());
      if (*middle >= kWanted || radius > most_radius)
        return std::max(*middle, 1.0) / (M_PI * radius * radius);
      radius *= kRadiusStep;
    }
  }

 private:
  // Points of the same wall about that one, itself left out.
  double countAround(std::size_t center, double radius) const {
    const double z = heights_[center];
    const auto from = std::lower_bound(heights_.begin(), heights_.end(), z - radius);
    const auto to = std::upper_bound(from, heights_.end(), z + radius);
    const double x = x_[center];
    const double y = y_[center];
    const double nx = normal_x_[center];
    const double ny = normal_y_[center];
    std::int64_t count = -1;
    for (auto i = from - heights_.begin(); i < to - heights_.begin(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double dx = x_[k] - x;
      const double dy = y_[k] - y;
      const double dz = heights_[k] - z;
      const double distance = dx * dx + dy * dy + dz * dz;
      const double agreement = normal_x_[k] * nx + normal_y_[k] * ny;
      count += distance < radius * radius && agreement > kMinAgreement ? 1 : 0;
    }
    return static_cast<double>(count);
  }

  using Place = std::pair<double, std::size_t>;

  // By height and number: into slices first, which leaves little to sort.
  static std::vector<Place> orderOf(const std::vector<WallPoint>& points) {
    constexpr std::size_t kSlices = 1024;
    const auto [lowest, highest] =
        std::minmax_element(points.begin(), points.end(),
                            [](const WallPoint& a, const WallPoint& b) { return a.z < b.z; });
    const double low = lowest->z;
    const double slice = std::max((highest->z - low) / kSlices, std::numeric_limits<double>::min());
    const auto sliceOf = [&](const WallPoint& p) {
      return std::min(kSlices - 1, static_cast<std::size_t>((p.z - low) / slice));
    };
    std::array<std::size_t, kSlices + 1> first = {};
    for (const WallPoint& p : points) ++first[sliceOf(p) + 1];
    for (std::size_t s = 0; s < kSlices; ++s) first[s + 1] += first[s];
    std::vector<Place> order(points.size());
    auto next = first;
    for (std::size_t i = 0; i < points.size(); ++i) {
      order[next[sliceOf(points[i])]++] = {points[i].z, i};
    }
    for (std::size_t s = 0; s < kSlices; ++s) {
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first[s]),
                order.begin() + static_cast<std::ptrdiff_t>(first[s + 1]));
    }
    return order;
  }

  // A list for each coordinate: several of their numbers are taken at once.
  std::vector<double> x_, y_, heights_;
  std::vector<double> normal_x_, normal_y_;
};

}  // namespace

HeightDensity::HeightDensity(const std::vector<WallPoint>& points, const WallScale& scale,
                             unsigned int threads)
    : densities_(kZones, scale.density) {
  if (points.empty()) return;
  const SortedPoints sorted(points);
  const std::vector<double>& heights = sorted.heights();
  low_ = heights.front();
  const double height = heights.back() - low_;
  step_ = std::max(height / kZones, std::numeric_limits<double>::min());
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(kZones); ++k) {
    const auto zone = static_cast<std::size_t>(k);
    const auto from = std::partition_point(heights.begin(), heights.end(),
                                           [&](double z) { return zoneOf(z) < zone; });
    const auto to =
        std::partition_point(from, heights.end(), [&](double z) { return zoneOf(z) <= zone; });
    const auto begin = static_cast<std::size_t>(from - heights.begin());
    const auto end = static_cast<std::size_t>(to - heights.begin());
    if (begin == end) continue;
    densities_[zone] = sorted.densityAround(begin, end, scale, kMostRadius * height);
  }
}

double HeightDensity::least() const {
  return *std::min_element(densities_.begin(), densities_.end());
}

std::size_t HeightDensity::zoneOf(double z) const {
  return std::min(kZones - 1, static_cast<std::size_t>(std::max(0.0, (z - low_) / step_)));
}

}  // namespace storey::detail
