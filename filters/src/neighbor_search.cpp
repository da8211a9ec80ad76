// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/neighbor_search.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace storey::detail {
namespace {

constexpr std::size_t kLeavesForEach = 2;  // neighbour: more are too many
constexpr std::size_t kLeavesForAny = 16;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr float kRounding = 1e-5f;  // of a squared distance in floats, with room to spare
constexpr std::size_t kHalfLanes = kLanes / 2;
constexpr float kFarthest = std::numeric_limits<float>::max();  // padding lies farther
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t paddedSize(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

// Room for so many, which is never taken back.
template <typename T>
void growTo(std::size_t size, std::vector<T>& values) {
  if (values.size() < size) {
    values.resize(size);
  }
}

// Leaves the k least of the distances where several equal the k-th, of those the first ones, and
// makes the others infinite. The k-th is returned.
float keepLeast(std::size_t k, std::size_t n, NeighborSearch::Workspace& workspace) {
  std::vector<float>& squared = workspace.squared;
  workspace.sorted.assign(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(n));
  const auto last = workspace.sorted.begin() + static_cast<std::ptrdiff_t>(k) - 1;
  std::nth_element(workspace.sorted.begin(), last, workspace.sorted.end());
  const float limit = *last;
  auto ties = static_cast<std::ptrdiff_t>(k) -
              std::count_if(workspace.sorted.begin(), last, [=](float d) { return d < limit; });
  for (std::size_t i = 0; i < n; ++i) {
    if (squared[i] == limit && ties-- <= 0) {
      squared[i] = kInfinity;
    }
  }
  return limit;
}

}  // namespace

float Neighborhood::squaredRadius() const {
  float largest = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    largest = std::max(largest, squaredDistance(i));
  }
  return largest;
}

NeighborSearch::NeighborSearch(const Cloud::ConstPtr& positions)
    : size_(positions->size()), tree_(*positions) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    xyz_[axis].reserve(paddedSize(size_));
    for (const pcl::PointXYZ& p : *positions) {
      xyz_[axis].push_back(p.data[axis]);
    }
    xyz_[axis].resize(paddedSize(size_), kInfinity);
  }
}

Box NeighborSearch::boxOf(std::size_t id) const {
  const Eigen::Array3f position(xyz_[0][id], xyz_[1][id], xyz_[2][id]);
  return {position, position};
}

// The leaves that meet the box widened by `reach`, and their boxes.
bool NeighborSearch::gather(const Box& box, float reach, std::size_t most_leaves,
                            Workspace& workspace) const {
  Box wide;
  for (int axis = 0; axis < 3; ++axis) {  // rounded outwards
    wide.low[axis] = std::nextafter(box.low[axis] - reach, -kInfinity);
    wide.high[axis] = std::nextafter(box.high[axis] + reach, kInfinity);
  }
  if (!tree_.leavesIn(wide, most_leaves, workspace.leaves)) {
    return false;
  }
  const std::size_t padded = paddedSize(workspace.leaves.size());
  for (std::size_t side = 0; side < 6; ++side) {
    std::vector<float>& sides = workspace.boxes[side];
    sides.resize(padded);
    for (std::size_t i = 0; i < workspace.leaves.size(); ++i) {
      sides[i] = tree_.sideOf(workspace.leaves[i], side);
    }
    std::fill(sides.begin() + static_cast<std::ptrdiff_t>(workspace.leaves.size()), sides.end(),
              kInfinity);
  }
  return true;
}

// The blocks that come within reach of the box, or all leaves if those hold too few positions.
void NeighborSearch::chooseBlocks(const Box& box, float squared_reach, std::size_t k,
                                  Workspace& workspace) const {
  const std::vector<std::uint32_t>& leaves = workspace.leaves;
  const std::array<std::vector<float>, 6>& boxes = workspace.boxes;
  growTo(boxes[0].size() + kHalfLanes, workspace.places);
  growTo(leaves.size(), workspace.blocks);
  workspace.num_blocks = boxesWithin({boxes[0].data(), boxes[1].data(), boxes[2].data(),
                                      boxes[3].data(), boxes[4].data(), boxes[5].data()},
                                     boxes[0].size(), {box.low.data(), box.high.data()},
                                     std::min(squared_reach, kFarthest), workspace.places.data());
  for (std::size_t b = 0; b < workspace.num_blocks; ++b) {
    workspace.blocks[b] = leaves[workspace.places[b]];
  }
  if (sizeOf(workspace.blocks.data(), workspace.num_blocks) < k) {
    workspace.num_blocks = leaves.size();
    std::copy(leaves.begin(), leaves.end(), workspace.blocks.begin());
  }
}

// Finds the blocks with the k nearest, and the squared distance within which exactly they lie.
float NeighborSearch::searchAlone(std::size_t id, std::size_t k, Workspace& workspace) const {
  const Box box = boxOf(id);
  float reach = std::sqrt(workspace.squared_reach) * (1.0f + kRounding);
  if (!(reach > 0.0f)) {
    const std::size_t other = id > 0 ? id - 1 : std::min(id + 1, size_ - 1);
    reach = std::sqrt((boxOf(other).low - box.low).square().sum());
    reach = std::max(reach, std::numeric_limits<float>::min());
  }
  bool grown = false;
  const std::size_t most_leaves = kLeavesForAny + kLeavesForEach * k;
  while (true) {
    if (!gather(box, reach, grown ? kNoLimit : most_leaves, workspace)) {
      reach *= 0.5f;
    } else if (sizeOf(workspace.leaves.data(), workspace.leaves.size()) < k) {
      reach *= 2.0f;
      grown = true;
    } else {
      break;
    }
  }
  const float limit = take(id, k, reach * reach, workspace);
  if (workspace.squared_reach * (1.0f + kRounding) < reach * reach) {
    return limit;
  }
  reach = std::sqrt(workspace.squared_reach) * (1.0f + kRounding);
  gather(box, reach, kNoLimit, workspace);
  return take(id, k, kInfinity, workspace);
}

float NeighborSearch::take(std::size_t id, std::size_t k, float squared_reach,
                           Workspace& workspace) const {
  const Box box = boxOf(id);
  chooseBlocks(box, squared_reach, k, workspace);
  const std::size_t n = workspace.num_blocks * kLanes;
  growTo(n, workspace.squared);
  squaredDistances(coordinates(), workspace.blocks.data(), workspace.num_blocks, box.low.data(),
                   workspace.squared.data());
  float limit = limitOf(workspace.squared.data(), n, k,
                        std::max(workspace.squared_reach, std::numeric_limits<float>::min()));
  if (std::isnan(limit)) {
    limit = keepLeast(k, n, workspace);
  }
  workspace.squared_reach = std::max(limit, std::numeric_limits<float>::min());
  return limit;
}

Neighborhood NeighborSearch::nearest(pcl::index_t id, std::size_t k, Workspace& workspace) const {
  k = std::min(k, size_);
  const float limit = searchAlone(static_cast<std::size_t>(id), k, workspace);
  const std::size_t n = workspace.num_blocks * kLanes;
  growTo(n + kHalfLanes, workspace.places);
  growTo(k, workspace.ids);
  placesWithin(workspace.squared.data(), n, limit, workspace.places.data());
  for (std::vector<float>& coordinate : workspace.xyz) {
    growTo(k, coordinate);
  }
  for (std::size_t i = 0; i < k; ++i) {
    const std::uint32_t place = workspace.places[i];
    const std::size_t neighbor = workspace.blocks[place / kLanes] * kLanes + place % kLanes;
    workspace.ids[i] = static_cast<pcl::index_t>(neighbor);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      workspace.xyz[axis][i] = xyz_[axis][neighbor];
    }
  }
  const Eigen::Array3f position = boxOf(static_cast<std::size_t>(id)).low;
  return {id,
          {position.x(), position.y(), position.z()},
          k,
          workspace.ids.data(),
          workspace.xyz[0].data(),
          workspace.xyz[1].data(),
          workspace.xyz[2].data()};
}

// How many positions there are in some blocks, ascending; the last of all may not be full.
std::size_t NeighborSearch::sizeOf(const std::uint32_t* blocks, std::size_t num_blocks) const {
  if (num_blocks == 0) {
    return 0;
  }
  const std::size_t end = (blocks[num_blocks - 1] + std::size_t{1}) * kLanes;
  return num_blocks * kLanes - (end > size_ ? end - size_ : 0);
}

}  // namespace storey::detail
