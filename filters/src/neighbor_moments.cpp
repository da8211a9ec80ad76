// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/neighbor_search.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace storey::detail {
namespace {

constexpr std::size_t kGroup = 64;         // positions that share the leaves near them, at most
constexpr float kGroupSide = 2.5f;         // of a group's box, at most: reaches
constexpr std::ptrdiff_t kRange = 2048;    // positions in a task of a thread
constexpr float kReachMargin = 1.6f;       // of the squared reach of the group before
constexpr float kRounding = 1e-5f;         // of a squared distance in floats, with room to spare
constexpr std::size_t kLeaves = 32;        // near a group, at most,
constexpr std::size_t kLeavesForEach = 2;  // and so many more for each neighbour
constexpr std::size_t kRoom = 8;           // that kernels want behind a list

// Positions that share the leaves near them.
struct Group {
  std::array<std::uint32_t, kGroup> ids;
  std::size_t count = 0;
  Box box;

  void clear() { count = 0; }
  void add(std::uint32_t id, const Box& position) {
    box.low = count > 0 ? box.low.min(position.low) : position.low;
    box.high = count > 0 ? box.high.max(position.high) : position.high;
    ids[count++] = id;
  }
};

}  // namespace

// The visits of one thread. Positions that follow each other on the curve share the leaves near
// them, and those of a batch also their candidates, out of which each lane takes its own.
class MomentVisits {
 public:
  MomentVisits(const NeighborSearch& search, std::size_t k,
               const NeighborSearch::VisitMoments& visit)
      : search_(search), k_(k), visit_(visit) {}

  void visitRange(std::size_t begin, std::size_t end, const std::vector<char>& wanted) {
    Group group;
    for (std::size_t id = begin; id < end;) {
      id = nextGroup(id, end, wanted, group);
      visitGroup(group);
    }
  }

 private:
  std::size_t nextGroup(std::size_t id, std::size_t end, const std::vector<char>& wanted,
                        Group& group) const;
  void visitGroup(Group& group);
  void divideGroup(const Group& group);
  bool visitTogether(Group& group, float squared_reach);
  float visitBatch(const Group& group, std::size_t begin, float squared_reach, Group& left);
  void visitAlone(std::uint32_t id);

  const NeighborSearch& search_;
  std::size_t k_;
  const NeighborSearch::VisitMoments& visit_;
  NeighborSearch::Workspace workspace_;
  MomentBatch batch_;
  float left_reach_ = 0.0f;  // squared, within which the neighbours of those left lie
};

// Wanted positions that follow each other in a box not much larger than their neighbourhoods.
// Larger ones would have too many leaves near them, and smaller ones too few positions to share
// them.
std::size_t MomentVisits::nextGroup(std::size_t id, std::size_t end,
                                    const std::vector<char>& wanted, Group& group) const {
  const bool known = workspace_.squared_reach > 0.0f;
  const float side = kGroupSide * std::sqrt(workspace_.squared_reach);
  const std::size_t most = known ? kGroup : kLanes;
  group.clear();
  for (; id < end && group.count < most; ++id) {
    if (wanted[id] == 0) {
      continue;
    }
    const Box box = search_.boxOf(id);
    if (known && group.count > 0 &&
        (group.box.high.max(box.high) - group.box.low.min(box.low)).maxCoeff() > side) {
      break;
    }
    group.add(static_cast<std::uint32_t>(id), box);
  }
  return id;
}

void MomentVisits::visitGroup(Group& group) {
  if (group.count == 0) {
    return;
  }
  if (!(workspace_.squared_reach > 0.0f)) {
    workspace_.squared_reach = (group.box.high - group.box.low).square().sum();
  }
  if (!visitTogether(group, kReachMargin * workspace_.squared_reach)) {
    divideGroup(group);
    return;
  }
  // Of those whose neighbours may lie further out it is known now how far at most.
  const float usual = workspace_.squared_reach;
  if (group.count > 1) {
    visitTogether(group, left_reach_ * (1.0f + 4.0f * kRounding));
  }
  for (std::size_t i = 0; i < group.count; ++i) {
    workspace_.squared_reach = left_reach_;
    visitAlone(group.ids[i]);
  }
  workspace_.squared_reach = usual;
}

// For where positions are much denser, or much sparser, than those before.
void MomentVisits::divideGroup(const Group& group) {
  if (group.count == 1) {
    visitAlone(group.ids[0]);
    return;
  }
  Group half;
  for (std::size_t i = 0; i < group.count; ++i) {
    half.add(group.ids[i], search_.boxOf(group.ids[i]));
    if (i + 1 == group.count / 2 || i + 1 == group.count) {
      visitGroup(half);
      half.clear();
    }
  }
}

// Visits those of the group whose neighbours are proven to lie within the reach, and leaves the
// others in it. Does nothing and returns false if there are too many leaves for that, or too few.
bool MomentVisits::visitTogether(Group& group, float squared_reach) {
  if (!search_.gather(group.box, std::sqrt(squared_reach), kLeaves + kLeavesForEach * k_,
                      workspace_) ||
      search_.sizeOf(workspace_.leaves.data(), workspace_.leaves.size()) < k_) {
    return false;
  }
  left_reach_ = 0.0f;
  Group left;
  float sum = 0.0f;
  for (std::size_t i = 0; i < group.count; i += kLanes) {
    sum += visitBatch(group, i, squared_reach, left);
  }
  workspace_.squared_reach = sum / static_cast<float>(group.count);
  group = left;
  return true;
}

// Returns the sum of the squared reaches.
float MomentVisits::visitBatch(const Group& group, std::size_t begin, float squared_reach,
                               Group& left) {
  const std::size_t count = std::min(kLanes, group.count - begin);
  Group lanes;
  for (std::size_t i = begin; i < begin + count; ++i) {
    lanes.add(group.ids[i], search_.boxOf(group.ids[i]));
  }
  std::array<Lanes, 3> queries;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      queries[axis].of[lane] = search_.xyz_[axis][lanes.ids[lane < count ? lane : 0]];
    }
  }
  search_.chooseBlocks(lanes.box, squared_reach, k_, workspace_);
  const std::size_t most = workspace_.num_blocks * kLanes + kRoom;
  for (std::vector<float>& coordinate : workspace_.xyz) {
    coordinate.resize(std::max(coordinate.size(), most));
  }
  const std::array<float*, 3> chosen = {workspace_.xyz[0].data(), workspace_.xyz[1].data(),
                                        workspace_.xyz[2].data()};
  const auto candidatesWithin = [&](float reach) {
    return positionsWithin(search_.coordinates(), workspace_.blocks.data(), workspace_.num_blocks,
                           {lanes.box.low.data(), lanes.box.high.data()}, reach, chosen);
  };
  std::size_t n = candidatesWithin(squared_reach);
  if (n < k_) {  // all, to know how far the neighbours may be
    n = candidatesWithin(std::numeric_limits<float>::max());
  }
  Lanes limits;
  workspace_.distances.resize(std::max(workspace_.distances.size(), n));
  momentsOfNearest({chosen[0], chosen[1], chosen[2]}, n, queries, k_, workspace_.squared_reach,
                   workspace_.distances.data(), limits, batch_.moments);
  float sum = 0.0f;
  batch_.ids.fill(-1);
  batch_.count = k_;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const bool found = limits.of[lane] * (1.0f + kRounding) < squared_reach;  // not where it is NaN
    const float reach = limits.of[lane] > 0.0f ? limits.of[lane] : squared_reach;
    sum += reach;
    if (found) {
      batch_.ids[lane] = static_cast<pcl::index_t>(lanes.ids[lane]);
    } else {
      left_reach_ = std::max(left_reach_, reach);
      left.add(lanes.ids[lane], search_.boxOf(lanes.ids[lane]));
    }
  }
  visit_(batch_);
  return sum;
}

void MomentVisits::visitAlone(std::uint32_t id) {
  const auto found = search_.nearest(static_cast<pcl::index_t>(id), k_, workspace_);
  visit_(momentsOf(found, found.position));
}

MomentBatch momentsOf(const Neighborhood& neighborhood, const std::array<float, 3>& origin) {
  MomentBatch batch;
  batch.ids.fill(-1);
  batch.ids[0] = neighborhood.id;
  batch.count = neighborhood.count;
  std::array<double, 9> sums{};
  const auto difference = [](float to, float from) {
    return static_cast<double>(to) - static_cast<double>(from);
  };
  for (std::size_t i = 0; i < neighborhood.count; ++i) {
    const double dx = difference(neighborhood.x[i], origin[0]);
    const double dy = difference(neighborhood.y[i], origin[1]);
    const double dz = difference(neighborhood.z[i], origin[2]);
    const double terms[9] = {dx, dy, dz, dx * dx, dx * dy, dx * dz, dy * dy, dy * dz, dz * dz};
    for (std::size_t s = 0; s < 9; ++s) sums[s] += terms[s];
  }
  for (std::size_t s = 0; s < 9; ++s) batch.moments[s].fill(sums[s]);
  return batch;
}

void NeighborSearch::forEachMoments(std::size_t k, const std::vector<char>& wanted,
                                    unsigned int threads, const VisitMoments& visit) const {
  if (k >= size_) {  // one neighbourhood
    if (size_ == 0) {
      return;
    }
    Workspace workspace;
    const Neighborhood all = nearest(0, size_, workspace);
    MomentBatch batch = momentsOf(all, all.position);
    for (std::size_t id = 0; id < size_; ++id) {
      batch.ids[0] = static_cast<pcl::index_t>(id);
      if (wanted[id] != 0) {
        visit(batch);
      }
    }
    return;
  }
  const auto n = static_cast<std::ptrdiff_t>(size_);
#pragma omp parallel num_threads(threadsFor(threads))
  {
    MomentVisits visits(*this, k, visit);
#pragma omp for schedule(dynamic, 1)
    for (std::ptrdiff_t begin = 0; begin < n; begin += kRange) {
      visits.visitRange(static_cast<std::size_t>(begin),
                        static_cast<std::size_t>(std::min(n, begin + kRange)), wanted);
    }
  }
}

}  // namespace storey::detail
