// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/bounding_box_tree.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace storey::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Box emptyBox() {
  return {Eigen::Array3f::Constant(kInfinity), Eigen::Array3f::Constant(-kInfinity)};
}

}  // namespace

BoundingBoxTree::BoundingBoxTree(const pcl::PointCloud<pcl::PointXYZ>& positions) {
  const std::size_t n = positions.size();
  const std::size_t num_leaves = (n + kLeaf - 1) / kLeaf;
  levels_.push_back(emptySiblings(num_leaves));
  for (std::size_t leaf = 0; leaf < num_leaves; ++leaf) {
    Box box = emptyBox();
    for (std::size_t i = leaf * kLeaf; i < std::min(n, (leaf + 1) * kLeaf); ++i) {
      box.low = box.low.min(positions[i].getArray3fMap());
      box.high = box.high.max(positions[i].getArray3fMap());
    }
    setNode(levels_.back(), leaf, box);
  }
  while (levels_.back().size() > 1) {
    const std::vector<Siblings>& below = levels_.back();
    std::vector<Siblings> level = emptySiblings(below.size());
    for (std::size_t node = 0; node < below.size(); ++node) {
      setNode(level, node, around(below[node]));
    }
    levels_.push_back(std::move(level));
  }
  bounds_ = levels_.back().empty() ? emptyBox() : around(levels_.back().front());
}

bool BoundingBoxTree::leavesIn(const Box& box, std::size_t most,
                               std::vector<std::uint32_t>& leaves) const {
  struct Pending {
    std::uint32_t group;  // of siblings
    std::uint8_t level;
    std::uint8_t meeting;  // bit i: sibling i is still to be entered
  };
  leaves.clear();
  std::array<Pending, 16> path;  // 8^16 leaves are more than there are indices
  std::size_t depth = 0;
  const auto enter = [&](std::size_t level, std::uint32_t group) {
    const unsigned int met = levels_[level].empty() ? 0 : meeting(levels_[level][group], box);
    path[depth++] = {group, static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(met)};
  };
  enter(levels_.size() - 1, 0);
  while (depth > 0) {
    Pending& current = path[depth - 1];
    if (current.meeting == 0) {
      --depth;
      continue;
    }
    const auto sibling = static_cast<std::uint32_t>(__builtin_ctz(current.meeting));
    current.meeting = static_cast<std::uint8_t>(current.meeting & (current.meeting - 1));
    const auto node = static_cast<std::uint32_t>(current.group * kFanOut + sibling);
    if (current.level > 0) {
      enter(current.level - 1U, node);
    } else if (leaves.size() == most) {
      return false;
    } else {
      leaves.push_back(node);
    }
  }
  return true;
}

unsigned int BoundingBoxTree::meeting(const Siblings& siblings, const Box& box) {
  std::array<int, kFanOut> meets;
  for (std::size_t i = 0; i < kFanOut; ++i) {
    meets[i] = (siblings.low[0][i] <= box.high.x()) & (siblings.high[0][i] >= box.low.x()) &
               (siblings.low[1][i] <= box.high.y()) & (siblings.high[1][i] >= box.low.y()) &
               (siblings.low[2][i] <= box.high.z()) & (siblings.high[2][i] >= box.low.z());
  }
  unsigned int bits = 0;
  for (std::size_t i = 0; i < kFanOut; ++i) {
    bits |= static_cast<unsigned int>(meets[i]) << i;
  }
  return bits;
}

Box BoundingBoxTree::around(const Siblings& siblings) {
  Box box = emptyBox();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box.low[axis] = *std::min_element(siblings.low[a].begin(), siblings.low[a].end());
    box.high[axis] = *std::max_element(siblings.high[a].begin(), siblings.high[a].end());
  }
  return box;
}

std::vector<BoundingBoxTree::Siblings> BoundingBoxTree::emptySiblings(std::size_t num_nodes) {
  Siblings empty;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    empty.low[axis].fill(kInfinity);
    empty.high[axis].fill(-kInfinity);
  }
  return std::vector<Siblings>((num_nodes + kFanOut - 1) / kFanOut, empty);
}

void BoundingBoxTree::setNode(std::vector<Siblings>& level, std::size_t node, const Box& box) {
  Siblings& siblings = level[node / kFanOut];
  for (int axis = 0; axis < 3; ++axis) {
    siblings.low[static_cast<std::size_t>(axis)][node % kFanOut] = box.low[axis];
    siblings.high[static_cast<std::size_t>(axis)][node % kFanOut] = box.high[axis];
  }
}

}  // namespace storey::detail
