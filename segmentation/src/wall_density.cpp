// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/wall_density.h>

#include <algorithm>
#include <array>
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
class SortedPoints {
 public:
  explicit SortedPoints(const std::vector<WallPoint>& points) {
    positions_.reserve(points.size());
    heights_.reserve(points.size());
    normals_.reserve(points.size());
    for (const auto& [z, i] : orderOf(points)) {
      positions_.push_back(points[i].position);
      heights_.push_back(z);
      normals_.push_back(points[i].normal);
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
    double count = -1.0;
    for (auto i = static_cast<std::size_t>(from - heights_.begin());
         i < static_cast<std::size_t>(to - heights_.begin()); ++i) {
      const double dz = heights_[i] - z;
      const double distance = (positions_[i] - positions_[center]).squaredNorm() + dz * dz;
      if (distance < radius * radius && normals_[i].dot(normals_[center]) > kMinAgreement) {
        count += 1.0;
      }
    }
    return count;
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

  std::vector<Eigen::Vector2d> positions_;
  std::vector<double> heights_;
  std::vector<Eigen::Vector2d> normals_;
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
