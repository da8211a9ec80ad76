// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// A stretch of a strip about the line normal . x = offset, between two places along its tangent.
struct PlanStrip {
  Eigen::Vector2d normal;
  double offset;
  double reach;  ///< to either side
  double s_min;
  double s_max;
};

/// Runs of consecutive points, with a circle around each in plan. Of points in the order of their
/// places (`orderByPlace`) most blocks are nowhere near a line, which one look at the circle tells.
class PointBlocks {
 public:
  static constexpr std::size_t kLength = 64;  ///< points, but for the last block

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

  /// Calls `work(block)` for the blocks, ascending, of which a point may be in the strip.
  template <typename Work>
  void forEachIn(const PlanStrip& strip, const Work& work) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (!meets(groups_[g], strip)) continue;
      const std::size_t end = (g + 1) * kGroup < size() ? (g + 1) * kGroup : size();
      for (std::size_t block = g * kGroup; block < end; ++block) {
        if (meets(circles_[block], strip)) work(block);
      }
    }
  }

 private:
  static constexpr std::size_t kGroup = 16;  // blocks

  struct Circle {
    Eigen::Vector2d center;
    double radius;
  };

  static bool meets(const Circle& circle, const PlanStrip& strip) {
    const Eigen::Vector2d& n = strip.normal;
    const double off = n.dot(circle.center) - strip.offset;
    const double s = n.x() * circle.center.y() - n.y() * circle.center.x();
    return std::abs(off) < strip.reach + circle.radius && s + circle.radius >= strip.s_min &&
           s - circle.radius <= strip.s_max;
  }

  template <typename PositionOf>
  void enclose(const PositionOf& positionOf);
  void encloseGroups();

  std::size_t num_points_;
  std::vector<Circle> circles_;  // of the blocks
  std::vector<Circle> groups_;   // around those of some blocks
};

}  // namespace storey::detail
