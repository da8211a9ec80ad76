// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Runs of consecutive points, with a circle around each in plan. Of points in the order of their
/// places (`orderByPlace`) most blocks are nowhere near a line, which one look at the circle tells.
class PointBlocks {
 public:
  explicit PointBlocks(const std::vector<WallPoint>& points);
  /// Of the points of these numbers; block by block it is places in this list that are told.
  PointBlocks(const std::vector<WallPoint>& points, const std::vector<int>& numbers);

  std::size_t size() const { return circles_.size(); }
  std::size_t begin(std::size_t block) const { return block * kLength; }
  std::size_t end(std::size_t block) const {
    return begin(block) + kLength < num_points_ ? begin(block) + kLength : num_points_;
  }

  /// Whether a point of the block may be within `reach` of the line normal . x = offset.
  bool mayBeNear(std::size_t block, const Eigen::Vector2d& normal, double offset,
                 double reach) const {
    const Circle& circle = circles_[block];
    const double off = normal.dot(circle.center) - offset;
    return off < reach + circle.radius && off > -reach - circle.radius;
  }

  /// Whether a point p of the block may have low <= direction . p <= high.
  bool mayBeBetween(std::size_t block, const Eigen::Vector2d& direction, double low,
                    double high) const {
    const Circle& circle = circles_[block];
    const double place = direction.dot(circle.center);
    return place + circle.radius >= low && place - circle.radius <= high;
  }

 private:
  static constexpr std::size_t kLength = 64;

  struct Circle {
    Eigen::Vector2d center;
    double radius;
  };

  template <typename PositionOf>
  void enclose(const PositionOf& positionOf);

  std::size_t num_points_;
  std::vector<Circle> circles_;
};

}  // namespace storey::detail
