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
constexpr std::size_t kGroup = 16;          // positions that share their candidates
constexpr std::ptrdiff_t kRange = 64;       // groups in a task of a thread
constexpr float kReachMargin = 1.4f;        // of the squared reach of the group before
constexpr std::size_t kLeavesForEach = 4;   // neighbour: more candidates than that are too many
constexpr std::size_t kLeavesForAny = 16;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr float kRounding = 1e-5f;  // of a squared distance in floats, with room to spare
constexpr int kCountings = 12;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t mostLeaves(std::size_t k) { return kLeavesForAny + kLeavesForEach * k; }

std::size_t paddedSize(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

// A limit that exactly k of the values do not exceed, by counting; NaN if there is none to be found,
// because of ties. `guess` > 0.
float limitOf(const std::vector<float>& values, std::size_t n, std::size_t k, float guess) {
  float low = 0.0f;
  float high = kInfinity;
  float limit = guess;
  for (int round = 0; round < kCountings; ++round) {
    const std::size_t count = countWithin(values.data(), n, limit);
    if (count == k) {
      return limit;
    }
    (count < k ? low : high) = limit;
    // On a surface the number of points within grows like the square of the distance.
    limit *= static_cast<float>(k) / std::max(static_cast<float>(count), 0.5f);
    if (!(limit > low && limit < high)) {
      limit = high < kInfinity ? 0.5f * (low + high) : 2.0f * low;
    }
  }
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

float Neighborhood::squaredRadius() const {
  float largest = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - position[0];
    const float dy = y[i] - position[1];
    const float dz = z[i] - position[2];
    largest = std::max(largest, dx * dx + dy * dy + dz * dz);
  }
  return largest;
}

Moments Neighborhood::moments() const {
  const std::array<float, 3> first{x[0], y[0], z[0]};
  return momentsAbout(x, y, z, paddedSize(count), first.data(), count);
}

NeighborSearch::NeighborSearch(const Cloud::ConstPtr& positions)
    : positions_(positions), tree_(*positions) {}

Neighborhood NeighborSearch::nearest(pcl::index_t id, std::size_t k, Workspace& workspace) const {
  return searchAlone(static_cast<std::size_t>(id), std::min(k, positions_->size()), workspace);
}

void NeighborSearch::forEach(std::size_t k, const std::vector<char>& wanted, unsigned int threads,
                             const Visit& visit) const {
  const std::size_t n = positions_->size();
  k = std::min(k, n);
  const auto num_groups = static_cast<std::ptrdiff_t>((n + kGroup - 1) / kGroup);
#pragma omp parallel num_threads(threadsFor(threads))
  {
    Workspace workspace;
#pragma omp for schedule(dynamic, kRange)
    for (std::ptrdiff_t group = 0; group < num_groups; ++group) {
      const std::size_t begin = static_cast<std::size_t>(group) * kGroup;
      const std::size_t end = std::min(n, begin + kGroup);
      if (std::find(wanted.begin() + static_cast<std::ptrdiff_t>(begin),
                    wanted.begin() + static_cast<std::ptrdiff_t>(end),
                    1) != wanted.begin() + static_cast<std::ptrdiff_t>(end)) {
        visitRange(begin, end, k, wanted, workspace, visit);
      }
    }
  }
}

// Where the curve leaps, a group spans more than its neighbourhood and is divided.
void NeighborSearch::visitRange(std::size_t begin, std::size_t end, std::size_t k,
                                const std::vector<char>& wanted, Workspace& workspace,
                                const Visit& visit) const {
  const Box box = boxOf(begin, end);
  if (!(workspace.squared_reach > 0.0f)) {
    workspace.squared_reach = (box.high - box.low).square().sum();
  }
  const float squared_reach = kReachMargin * workspace.squared_reach;
  const bool together = gather(box, std::sqrt(squared_reach), mostLeaves(k), workspace);
  if (!together && end - begin > 1) {
    const std::size_t middle = begin + (end - begin) / 2;
    visitRange(begin, middle, k, wanted, workspace, visit);
    visitRange(middle, end, k, wanted, workspace, visit);
    return;
  }
  float sum = 0.0f;
  float count = 0.0f;
  struct Unproven {
    std::size_t id;
    float squared_reach;
  };
  std::array<Unproven, kGroup> unproven;
  std::size_t num_unproven = 0;
  for (std::size_t id = begin; id < end; ++id) {
    if (wanted[id] == 0) {
      continue;
    }
    if (!together || workspace.num_candidates < k) {
      unproven[num_unproven++] = {id, squared_reach};
      continue;
    }
    const Neighborhood found = take(id, k, workspace);
    sum += workspace.squared_reach;
    count += 1.0f;
    if (workspace.squared_reach * (1.0f + kRounding) < squared_reach) {
      visit(found);
    } else {
      unproven[num_unproven++] = {id, workspace.squared_reach};
    }
  }
  for (std::size_t i = 0; i < num_unproven; ++i) {
    workspace.squared_reach = unproven[i].squared_reach;
    visit(searchAlone(unproven[i].id, k, workspace));
  }
  if (count > 0.0f) {
    workspace.squared_reach = sum / count;
  }
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
  const std::size_t n = workspace.leaves.size() * kFanOut;
  const std::size_t padded = paddedSize(n);
  workspace.x.resize(padded);
  workspace.y.resize(padded);
  workspace.z.resize(padded);
  workspace.squared.resize(padded);
  workspace.num_candidates = 0;
  std::size_t place = 0;
  for (const std::uint32_t leaf : workspace.leaves) {
    const std::size_t first = leaf * kFanOut;
    const std::size_t count = std::min(kFanOut, positions_->size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const pcl::PointXYZ& p = (*positions_)[first + i];
      workspace.x[place + i] = p.x;
      workspace.y[place + i] = p.y;
      workspace.z[place + i] = p.z;
    }
    workspace.num_candidates += count;
    place += count;
  }
  std::fill(workspace.x.begin() + static_cast<std::ptrdiff_t>(place), workspace.x.end(), kInfinity);
  std::fill(workspace.y.begin() + static_cast<std::ptrdiff_t>(place), workspace.y.end(), 0.0f);
  std::fill(workspace.z.begin() + static_cast<std::ptrdiff_t>(place), workspace.z.end(), 0.0f);
  return true;
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
    } else if (workspace.num_candidates < k) {
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

// The k nearest of the candidates; `workspace.squared_reach` becomes the square of a distance within
// which they lie.
Neighborhood NeighborSearch::take(std::size_t id, std::size_t k, Workspace& workspace) const {
  const pcl::PointXYZ& p = (*positions_)[id];
  const std::size_t n = workspace.squared.size();
  Neighborhood result;
  result.id = static_cast<pcl::index_t>(id);
  result.position = {p.x, p.y, p.z};
  result.count = k;
  std::vector<float>& squared = workspace.squared;
  squaredDistances(workspace.x.data(), workspace.y.data(), workspace.z.data(), n,
                   result.position.data(), squared.data());
  float limit = limitOf(squared, n, k, workspace.squared_reach);
  std::size_t ties = k;  // taken of those at the limit itself
  if (std::isnan(limit)) {
    workspace.sorted.assign(squared.begin(), squared.end());
    const auto last = workspace.sorted.begin() + static_cast<std::ptrdiff_t>(k) - 1;
    std::nth_element(workspace.sorted.begin(), last, workspace.sorted.end());
    limit = *last;
    ties = k - static_cast<std::size_t>(std::count_if(squared.begin(), squared.end(),
                                                      [limit](float d) { return d < limit; }));
  }
  const std::size_t padded = paddedSize(k);
  workspace.nearest_x.resize(padded + 1);  // one more: the loop writes before it knows
  workspace.nearest_y.resize(padded + 1);
  workspace.nearest_z.resize(padded + 1);
  workspace.nearest_ids.resize(padded + 1);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < workspace.num_candidates; ++i) {
    workspace.nearest_x[taken] = workspace.x[i];
    workspace.nearest_y[taken] = workspace.y[i];
    workspace.nearest_z[taken] = workspace.z[i];
    workspace.nearest_ids[taken] =
        static_cast<pcl::index_t>(workspace.leaves[i / kFanOut] * kFanOut + i % kFanOut);
    const bool at_limit = squared[i] == limit;
    taken += (squared[i] < limit) | (at_limit & (ties > 0));
    ties -= at_limit & (ties > 0);
  }
  for (std::size_t i = k; i < padded; ++i) {
    workspace.nearest_x[i] = workspace.nearest_x[0];
    workspace.nearest_y[i] = workspace.nearest_y[0];
    workspace.nearest_z[i] = workspace.nearest_z[0];
  }
  workspace.squared_reach = std::max(limit, std::numeric_limits<float>::min());
  result.ids = workspace.nearest_ids.data();
  result.x = workspace.nearest_x.data();
  result.y = workspace.nearest_y.data();
  result.z = workspace.nearest_z.data();
  return result;
}

}  // namespace storey::detail
