// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/neighbor_search.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace storey::detail {
namespace {

constexpr std::size_t kFanOut = BoundingBoxTree::kFanOut;
constexpr std::size_t kGroup = 64;         // positions that share their candidates, at most
constexpr float kGroupSide = 2.5f;         // of a group's box, at most: reaches
constexpr std::ptrdiff_t kRange = 2048;    // positions in a task of a thread
constexpr float kReachMargin = 1.6f;       // of the squared reach of the group before
constexpr std::size_t kLeavesForEach = 4;  // neighbour: more candidates than that are too many
constexpr std::size_t kLeavesForAny = 16;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr float kRounding = 1e-5f;  // of a squared distance in floats, with room to spare
constexpr int kCountings = 16;
constexpr float kWider = 1.2f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t mostLeaves(std::size_t k) { return kLeavesForAny + kLeavesForEach * k; }

std::size_t paddedSize(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

// A limit that exactly k of the values do not exceed, by counting; NaN if there is none to be
// found, because of ties. `guess` > 0.
float limitOf(const float* values, std::size_t n, std::size_t k, float guess) {
  float low = 0.0f;
  float high = kInfinity;
  float below = 0.0f;  // how many are within `low`, and within `high`
  float above = 0.0f;
  const auto wanted = static_cast<float>(k);
  float limit = guess;
  for (int round = 0; round < kCountings; ++round) {
    const std::size_t count = countWithin(values, n, limit);
    if (count == k) {
      return limit;
    }
    if (count < k) {
      low = limit;
      below = static_cast<float>(count);
    } else {
      high = limit;
      above = static_cast<float>(count);
    }
    // On a surface the number within a distance grows like its square, evenly between two limits.
    limit = high < kInfinity ? low + (high - low) * (wanted + 0.5f - below) / (above + 1.0f - below)
                             : kWider * low * wanted / std::max(below, 0.5f);
    if (!(limit > low && limit < high)) {
      limit = 0.5f * (low + high);
    }
  }
  return std::numeric_limits<float>::quiet_NaN();
}

// The places of the k least values where several equal the k-th: of those, the first ones.
float placesOfLeast(std::size_t k, std::size_t n, NeighborSearch::Workspace& workspace) {
  const std::vector<float>& squared = workspace.squared;
  workspace.sorted.assign(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(n));
  const auto last = workspace.sorted.begin() + static_cast<std::ptrdiff_t>(k) - 1;
  std::nth_element(workspace.sorted.begin(), last, workspace.sorted.end());
  const float limit = *last;
  auto ties = static_cast<std::ptrdiff_t>(k) -
              std::count_if(workspace.sorted.begin(), last, [=](float d) { return d < limit; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (squared[i] < limit || (squared[i] == limit && ties-- > 0)) {
      workspace.places[count++] = static_cast<std::uint32_t>(i);
    }
  }
  return limit;
}

// The candidates at some places. Padded with infinity, or with the first of them.
enum class Padding { Infinity, First };
void choose(const NeighborSearch::Candidates& from, std::size_t count,
            const std::vector<std::uint32_t>& places, Padding padding,
            NeighborSearch::Candidates& chosen) {
  chosen.resize(count);
  const std::uint32_t* const place = places.data();
  float* const x = chosen.x.data();
  float* const y = chosen.y.data();
  float* const z = chosen.z.data();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = from.x[place[i]];
    y[i] = from.y[place[i]];
    z[i] = from.z[place[i]];
    chosen.ids[i] = from.ids[place[i]];
  }
  const bool first = padding == Padding::First;
  for (std::size_t i = count; i < chosen.padded(); ++i) {
    x[i] = first ? x[0] : kInfinity;
    y[i] = first ? y[0] : 0.0f;
    z[i] = first ? z[0] : 0.0f;
  }
}

}  // namespace

float Neighborhood::squaredRadius() const {
  float largest = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    largest = std::max(largest, squaredDistance(i));
  }
  return largest;
}

Moments Neighborhood::moments() const {
  const std::array<float, 3> first{x[0], y[0], z[0]};
  return momentsAbout(x, y, z, paddedSize(count), first.data(), count);
}

std::size_t NeighborSearch::Candidates::padded() const { return paddedSize(count); }

void NeighborSearch::Candidates::resize(std::size_t size) {
  count = size;
  if (padded() > x.size()) {
    x.resize(padded());
    y.resize(padded());
    z.resize(padded());
    ids.resize(padded());
  }
}

NeighborSearch::NeighborSearch(const Cloud::ConstPtr& positions)
    : positions_(positions), tree_(*positions) {}

Neighborhood NeighborSearch::nearest(pcl::index_t id, std::size_t k, Workspace& workspace) const {
  return searchAlone(static_cast<std::size_t>(id), std::min(k, positions_->size()), workspace);
}

void NeighborSearch::forEach(std::size_t k, const std::vector<char>& wanted, unsigned int threads,
                             const Visit& visit) const {
  const auto n = static_cast<std::ptrdiff_t>(positions_->size());
  k = std::min(k, positions_->size());
#pragma omp parallel num_threads(threadsFor(threads))
  {
    Workspace workspace;
    Group group;
#pragma omp for schedule(dynamic, 1)
    for (std::ptrdiff_t begin = 0; begin < n; begin += kRange) {
      const auto end = static_cast<std::size_t>(std::min(n, begin + kRange));
      for (auto id = static_cast<std::size_t>(begin); id < end;) {
        id = nextGroup(id, end, wanted, workspace, group);
        visitGroup(group, k, workspace, visit);
      }
    }
  }
}

// Wanted positions that follow each other in a box not much larger than their neighbourhoods.
// Larger ones would have too many candidates, and smaller ones too few positions to share them.
std::size_t NeighborSearch::nextGroup(std::size_t id, std::size_t end,
                                      const std::vector<char>& wanted, const Workspace& workspace,
                                      Group& group) const {
  const float side =
      workspace.squared_reach > 0.0f ? kGroupSide * std::sqrt(workspace.squared_reach) : kInfinity;
  const std::size_t most = workspace.squared_reach > 0.0f ? kGroup : kGroup / 4;
  group.count = 0;
  for (; id < end && group.count < most; ++id) {
    if (wanted[id] == 0) {
      continue;
    }
    Box box = boxOf(id, id + 1);
    if (group.count > 0) {
      box.low = box.low.min(group.box.low);
      box.high = box.high.max(group.box.high);
      if ((box.high - box.low).maxCoeff() > side) {
        break;
      }
    }
    group.box = box;
    group.ids[group.count++] = static_cast<std::uint32_t>(id);
  }
  return id;
}

void NeighborSearch::visitGroup(Group& group, std::size_t k, Workspace& workspace,
                                const Visit& visit) const {
  if (group.count == 0) {
    return;
  }
  if (!(workspace.squared_reach > 0.0f)) {
    workspace.squared_reach = (group.box.high - group.box.low).square().sum();
  }
  if (!visitTogether(group, kReachMargin * workspace.squared_reach, k, workspace, visit)) {
    divideGroup(group, k, workspace, visit);
    return;
  }
  // Of those whose neighbours may lie further out it is known now how far at most.
  const float usual = workspace.squared_reach;
  if (group.count > 1) {
    visitTogether(group, group.squared_reach * (1.0f + 4.0f * kRounding), k, workspace, visit);
  }
  for (std::size_t i = 0; i < group.count; ++i) {
    workspace.squared_reach = group.squared_reach;
    visit(searchAlone(group.ids[i], k, workspace));
  }
  workspace.squared_reach = usual;
}

// For where positions are much denser, or much sparser, than those before.
void NeighborSearch::divideGroup(const Group& group, std::size_t k, Workspace& workspace,
                                 const Visit& visit) const {
  if (group.count == 1) {
    visit(searchAlone(group.ids[0], k, workspace));
    return;
  }
  Group half;
  for (std::size_t i = 0; i < group.count; ++i) {
    const Box box = boxOf(group.ids[i], group.ids[i] + 1);
    half.box.low = half.count > 0 ? half.box.low.min(box.low) : box.low;
    half.box.high = half.count > 0 ? half.box.high.max(box.high) : box.high;
    half.ids[half.count++] = group.ids[i];
    if (i + 1 == group.count / 2 || i + 1 == group.count) {
      visitGroup(half, k, workspace, visit);
      half.count = 0;
    }
  }
}

// Visits those of the group whose neighbours are proven to lie within the reach, and leaves the
// others in it, with what they need. Does nothing and returns false if there are too many
// candidates for that, or too few.
bool NeighborSearch::visitTogether(Group& group, float squared_reach, std::size_t k,
                                   Workspace& workspace, const Visit& visit) const {
  if (!gather(group.box, std::sqrt(squared_reach), mostLeaves(k), workspace) ||
      workspace.candidates.count < k) {
    return false;
  }
  group.squared_reach = 0.0f;
  float sum = 0.0f;
  std::size_t num_left = 0;
  const std::size_t count = group.count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = group.ids[i];
    const Neighborhood found = take(id, k, workspace);
    sum += workspace.squared_reach;
    if (workspace.squared_reach * (1.0f + kRounding) < squared_reach) {
      visit(found);
      continue;
    }
    const Box box = boxOf(id, id + 1);
    group.box.low = num_left > 0 ? group.box.low.min(box.low) : box.low;
    group.box.high = num_left > 0 ? group.box.high.max(box.high) : box.high;
    group.squared_reach = std::max(group.squared_reach, workspace.squared_reach);
    group.ids[num_left++] = id;
  }
  group.count = num_left;
  workspace.squared_reach = sum / static_cast<float>(count);
  return true;
}

Box NeighborSearch::boxOf(std::size_t begin, std::size_t end) const {
  Box box{(*positions_)[begin].getArray3fMap(), (*positions_)[begin].getArray3fMap()};
  for (std::size_t i = begin + 1; i < end; ++i) {
    box.low = box.low.min((*positions_)[i].getArray3fMap());
    box.high = box.high.max((*positions_)[i].getArray3fMap());
  }
  return box;
}

// Candidates: all positions of the leaves that meet the box widened by `reach`.
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
  fillFromLeaves(workspace);
  Candidates& all = workspace.in_leaves;
  workspace.squared.resize(std::max(workspace.squared.size(), all.padded()));
  workspace.places.resize(std::max(workspace.places.size(), all.padded() + kLanes));
  squaredDistancesToBox(all.x.data(), all.y.data(), all.z.data(), all.padded(), box.low.data(),
                        box.high.data(), workspace.squared.data());
  const float farthest = reach * reach * (1.0f + kRounding);
  choose(all,
         placesWithin(workspace.squared.data(), all.padded(), farthest, workspace.places.data()),
         workspace.places, Padding::Infinity, workspace.candidates);
  return true;
}

void NeighborSearch::fillFromLeaves(Workspace& workspace) const {
  Candidates& all = workspace.in_leaves;
  all.resize(workspace.leaves.size() * kFanOut);
  std::size_t place = 0;
  for (const std::uint32_t leaf : workspace.leaves) {
    const std::size_t first = leaf * kFanOut;
    const std::size_t last = std::min(first + kFanOut, positions_->size());
    for (std::size_t i = first; i < last; ++i, ++place) {
      const pcl::PointXYZ& p = (*positions_)[i];
      all.x[place] = p.x;
      all.y[place] = p.y;
      all.z[place] = p.z;
      all.ids[place] = static_cast<pcl::index_t>(i);
    }
  }
  all.count = place;
  std::fill(all.x.begin() + static_cast<std::ptrdiff_t>(place),
            all.x.begin() + static_cast<std::ptrdiff_t>(all.padded()), kInfinity);
}

Neighborhood NeighborSearch::searchAlone(std::size_t id, std::size_t k,
                                         Workspace& workspace) const {
  const Box box = boxOf(id, id + 1);
  float reach = std::sqrt(workspace.squared_reach) * (1.0f + kRounding);
  if (!(reach > 0.0f)) {
    const std::size_t other = id > 0 ? id - 1 : std::min(id + 1, positions_->size() - 1);
    reach = ((*positions_)[other].getVector3fMap() - (*positions_)[id].getVector3fMap()).norm();
    reach = std::max(reach, std::numeric_limits<float>::min());
  }
  bool grown = false;
  while (true) {
    if (!gather(box, reach, grown ? kNoLimit : mostLeaves(k), workspace)) {
      reach *= 0.5f;
    } else if (workspace.candidates.count < k) {
      reach *= 2.0f;
      grown = true;
    } else {
      break;
    }
  }
  workspace.squared_reach = std::max(reach * reach, std::numeric_limits<float>::min());
  const Neighborhood found = take(id, k, workspace);
  if (workspace.squared_reach * (1.0f + kRounding) < reach * reach) {
    return found;
  }
  gather(box, std::sqrt(workspace.squared_reach) * (1.0f + kRounding), kNoLimit, workspace);
  return take(id, k, workspace);
}

// The k nearest of the candidates; `workspace.squared_reach` becomes the square of a distance
// within which they lie.
Neighborhood NeighborSearch::take(std::size_t id, std::size_t k, Workspace& workspace) const {
  const pcl::PointXYZ& p = (*positions_)[id];
  const Candidates& candidates = workspace.candidates;
  squaredDistances(candidates.x.data(), candidates.y.data(), candidates.z.data(),
                   candidates.padded(), p.data, workspace.squared.data());
  float limit = limitOf(workspace.squared.data(), candidates.padded(), k, workspace.squared_reach);
  if (std::isnan(limit)) {
    limit = placesOfLeast(k, candidates.padded(), workspace);
  } else {
    placesWithin(workspace.squared.data(), candidates.padded(), limit, workspace.places.data());
  }
  choose(candidates, k, workspace.places, Padding::First, workspace.nearest);
  workspace.squared_reach = std::max(limit, std::numeric_limits<float>::min());
  const Candidates& nearest = workspace.nearest;
  return {static_cast<pcl::index_t>(id),
          {p.x, p.y, p.z},
          k,
          nearest.ids.data(),
          nearest.x.data(),
          nearest.y.data(),
          nearest.z.data()};
}

}  // namespace storey::detail
