// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/point_blocks.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kRounding = 1e-12;  // of the distance from the origin

}  // namespace

PointBlocks::PointBlocks(const std::vector<WallPoint>& points) : num_points_(points.size()) {
  enclose([&](std::size_t i) { return points[i].position; });
}

PointBlocks::PointBlocks(const std::vector<WallPoint>& points, const std::vector<int>& numbers)
    : num_points_(numbers.size()) {
  enclose([&](std::size_t i) { return points[static_cast<std::size_t>(numbers[i])].position; });
}

template <typename PositionOf>
void PointBlocks::enclose(const PositionOf& positionOf) {
  circles_.reserve(num_points_ / kLength + 1);
  for (std::size_t from = 0; from < num_points_; from += kLength) {
    const std::size_t to = std::min(num_points_, from + kLength);
    Eigen::Vector2d low = positionOf(from);
    Eigen::Vector2d high = low;
    for (std::size_t i = from; i < to; ++i) {
      low = low.cwiseMin(positionOf(i));
      high = high.cwiseMax(positionOf(i));
    }
    const Eigen::Vector2d center = 0.5 * (low + high);
    double squared = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      squared = std::max(squared, (positionOf(i) - center).squaredNorm());
    }
    circles_.push_back({center, std::sqrt(squared) + kRounding * center.norm()});
  }
  encloseGroups();
}

void PointBlocks::encloseGroups() {
  for (std::size_t from = 0; from < size(); from += kGroup) {
    const std::size_t to = std::min(size(), from + kGroup);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t b = from; b < to; ++b) sum += circles_[b].center;
    const Eigen::Vector2d center = sum / static_cast<double>(to - from);
    double radius = 0.0;
    for (std::size_t b = from; b < to; ++b) {
      radius = std::max(radius, (circles_[b].center - center).norm() + circles_[b].radius);
    }
    groups_.push_back({center, radius + kRounding * center.norm()});
  }
}

}  // namespace storey::detail
