// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/point_blocks.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {

PointBlocks::PointBlocks(const std::vector<WallPoint>& points) : num_points_(points.size()) {
  constexpr double kRounding = 1e-12;  // of the distance from the origin
  circles_.reserve(points.size() / kLength + 1);
  for (std::size_t from = 0; from < points.size(); from += kLength) {
    const std::size_t to = std::min(points.size(), from + kLength);
    Eigen::Vector2d low = points[from].position;
    Eigen::Vector2d high = low;
    for (std::size_t i = from; i < to; ++i) {
      low = low.cwiseMin(points[i].position);
      high = high.cwiseMax(points[i].position);
    }
    const Eigen::Vector2d center = 0.5 * (low + high);
    double squared = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      squared = std::max(squared, (points[i].position - center).squaredNorm());
    }
    circles_.push_back({center, std::sqrt(squared) + kRounding * center.norm()});
  }
}

}  // namespace storey::detail
