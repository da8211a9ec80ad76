// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <storey/filters/detail/distance_kernels.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// An axis-parallel box, closed on all sides.
struct Box {
  Eigen::Array3f low;
  Eigen::Array3f high;
};

/// A packed tree of bounding boxes over positions in Morton order: a leaf is the box of a block of
/// positions that follow each other, an inner node that of eight nodes. It goes by the number of
/// points alone, so it is as good where they are dense as where they are sparse, and no outlier
/// makes it larger. About 1.7 bytes a position.
class BoundingBoxTree {
 public:
  static constexpr std::size_t kLeaf = kLanes;  ///< positions
  static constexpr std::size_t kFanOut = 8;

  /// O(n). \param positions need not be distinct; they are not kept
  explicit BoundingBoxTree(const pcl::PointCloud<pcl::PointXYZ>& positions);

  /// The box of all positions.
  const Box& bounds() const { return bounds_; }

  /// Numbers of the leaves that meet the box, ascending; leaf l holds the positions from l `kLeaf`
  /// on. Gives up and returns false when there are more than `most`.
  bool leavesIn(const Box& box, std::size_t most, std::vector<std::uint32_t>& leaves) const;

  /// A side of the box of a leaf: low x, y, z, then high x, y, z.
  float sideOf(std::uint32_t leaf, std::size_t side) const {
    const Siblings& siblings = levels_.front()[leaf / kFanOut];
    return (side < 3 ? siblings.low[side] : siblings.high[side - 3])[leaf % kFanOut];
  }

 private:
  // Sides of eight siblings together, for one comparison of them all; nodes that do not exist are
  // empty and meet nothing.
  struct Siblings {
    std::array<std::array<float, kFanOut>, 3> low;
    std::array<std::array<float, kFanOut>, 3> high;
  };

  static unsigned int meeting(const Siblings& siblings, const Box& box);
  static Box around(const Siblings& siblings);
  static std::vector<Siblings> emptySiblings(std::size_t num_nodes);
  static void setNode(std::vector<Siblings>& level, std::size_t node, const Box& box);

  std::vector<std::vector<Siblings>> levels_;  ///< leaves first, the root's children last
  Box bounds_;
};

}  // namespace storey::detail
