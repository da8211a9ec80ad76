// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/union_find.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kFloatingFaces = 8.0;  // that a part in the air costs beyond its own
constexpr double kTouching = 1e-6;      // of the length of an edge

// +1 if the inside is behind the line, -1 if it is ahead, 0 if the edge is no boundary.
int sideOf(const PlanEdge& edge, const std::vector<char>& inside) {
  return int{inside[static_cast<std::size_t>(edge.behind)]} -
         int{inside[static_cast<std::size_t>(edge.ahead)]};
}

// What lies between two neighbouring blocks.
struct Joint {
  std::size_t caps = 0;      // connected parts of the cells inside in one alone, either way
  std::size_t floating = 0;  // connected parts of the upper that rest on nothing
};

// Calls `visit(cell)` for the cells whose labels differ. Most are the same: it is blocks of them
// that are compared.
template <typename Visit>
void forEachDifference(const std::vector<char>& one, const std::vector<char>& other,
                       const Visit& visit) {
  constexpr std::size_t kBlock = 64;
  for (std::size_t from = 0; from < one.size(); from += kBlock) {
    const std::size_t to = std::min(one.size(), from + kBlock);
    if (std::memcmp(one.data() + from, other.data() + from, to - from) == 0) continue;
    for (std::size_t c = from; c < to; ++c) {
      if (one[c] != other[c]) visit(c);
    }
  }
}

// Floods the cells that change. A part of the upper block floats if all of it does and no cell
// beside it is inside in both. \param lower, upper null: there is no block
Joint jointBetween(const CellNeighbors& neighbors, const std::vector<char>* lower,
                   const std::vector<char>* upper) {
  const std::vector<char> none(neighbors.size(), 0);
  const std::vector<char>& below = lower != nullptr ? *lower : none;
  const std::vector<char>& above = upper != nullptr ? *upper : none;
  std::vector<signed char> change(neighbors.size(), 0);
  forEachDifference(below, above, [&](std::size_t c) {
    change[c] = static_cast<signed char>(below[c] - above[c]);
  });
  Joint joint;
  std::vector<std::size_t> front;
  forEachDifference(below, above, [&](std::size_t c) {
    if (change[c] == 0) return;  // flooded
    const signed char way = std::exchange(change[c], {});
    bool rests = way > 0;
    front = {c};
    while (!front.empty()) {
      const std::size_t cell = front.back();
      front.pop_back();
      neighbors.forEach(cell, [&](std::size_t next) {
        rests = rests || (below[next] != 0 && above[next] != 0);
        if (change[next] != way) return;
        change[next] = 0;
        front.push_back(next);
      });
    }
    ++joint.caps;
    if (!rests) ++joint.floating;
  });
  return joint;
}

}  // namespace

std::vector<OutlineRun> runsOf(const LineArrangement& plan, const CellTerms& terms,
                               const std::vector<char>& inside) {
  std::vector<OutlineRun> runs;
  int side = 0;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    const int before = std::exchange(side, sideOf(edge, inside));
    if (side == 0) continue;
    const bool joined = side == before && plan.edges[e - 1].line == edge.line &&
                        edge.s_min - plan.edges[e - 1].s_max < kTouching * edge.length();
    if (!joined) runs.push_back({e, e, side, 0.0});
    runs.back().last = e;
    runs.back().seen += std::max(0.0, side * terms.signed_area[e]);
  }
  return runs;
}

std::size_t countWalls(const std::vector<const std::vector<OutlineRun>*>& blocks) {
  std::size_t num_runs = 0;
  for (const auto* runs : blocks) num_runs += runs->size();
  UnionFind<> walls(num_runs);
  std::size_t lower_id = 0;  // of the first run of the lower block
  for (std::size_t b = 1; b < blocks.size(); ++b) {
    const std::vector<OutlineRun>& lower = *blocks[b - 1];
    const std::vector<OutlineRun>& upper = *blocks[b];
    const std::size_t upper_id = lower_id + lower.size();
    std::size_t from = 0;  // both are sorted, and runs of one block do not overlap
    for (std::size_t u = 0; u < upper.size(); ++u) {
      while (from < lower.size() && lower[from].last < upper[u].first) ++from;
      for (std::size_t l = from; l < lower.size() && lower[l].first <= upper[u].last; ++l) {
        if (lower[l].side == upper[u].side) walls.unite(lower_id + l, upper_id + u);
      }
    }
    lower_id = upper_id;
  }
  std::size_t count = 0;
  for (std::size_t r = 0; r < num_runs; ++r) count += walls.find(r) == r;
  return count;
}

std::size_t countFaces(const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
  const CellNeighbors neighbors(plan);
  std::vector<const std::vector<OutlineRun>*> runs;
  for (const BlockOutline& block : blocks) runs.push_back(block.runs);
  std::size_t faces = countWalls(runs);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    faces += jointBetween(neighbors, b > 0 ? blocks[b - 1].inside : nullptr, blocks[b].inside).caps;
  }
  if (!blocks.empty()) faces += jointBetween(neighbors, blocks.back().inside, nullptr).caps;
  return faces;
}

std::size_t countFloating(const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
  const CellNeighbors neighbors(plan);
  std::size_t floating = 0;
  for (std::size_t b = 1; b < blocks.size(); ++b) {
    floating += jointBetween(neighbors, blocks[b - 1].inside, blocks[b].inside).floating;
  }
  return floating;
}

double jointComplexity(const CellNeighbors& neighbors, const std::vector<char>* lower,
                       const std::vector<char>* upper) {
  const Joint joint = jointBetween(neighbors, lower, upper);
  const std::size_t floating = lower != nullptr ? joint.floating : 0;  // or it is on the ground
  return static_cast<double>(joint.caps) + kFloatingFaces * static_cast<double>(floating);
}

double complexityOf(const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
  return static_cast<double>(countFaces(plan, blocks)) +
         kFloatingFaces * static_cast<double>(countFloating(plan, blocks));
}

}  // namespace storey::detail
