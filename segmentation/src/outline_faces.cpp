// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/union_find.h>

#include <algorithm>

namespace storey::detail {
namespace {

constexpr double kFloatingFaces = 8.0;  // that a part in the air costs beyond its own
constexpr double kTouching = 1e-6;      // of the length of an edge

// +1 if the inside is behind the line, -1 if it is ahead, 0 if the edge is no boundary.
int sideOf(const PlanEdge& edge, const std::vector<char>& inside) {
  return int{inside[static_cast<std::size_t>(edge.behind)]} -
         int{inside[static_cast<std::size_t>(edge.ahead)]};
}

// The connected parts of the cells with equal marks.
UnionFind<> partsOf(const LineArrangement& plan, const std::vector<int>& marks) {
  UnionFind<> parts(marks.size());
  for (const PlanEdge& edge : plan.edges) {
    const auto a = static_cast<std::size_t>(edge.behind);
    const auto b = static_cast<std::size_t>(edge.ahead);
    if (marks[a] != 0 && marks[a] == marks[b]) parts.unite(a, b);
  }
  return parts;
}

// Connected parts of the cells that one block has inside and the other has not, either way.
// \param lower, upper null: there is no block
std::size_t countCaps(const LineArrangement& plan, const std::vector<char>* lower,
                      const std::vector<char>* upper) {
  std::vector<int> change(plan.cells.size());
  for (std::size_t c = 0; c < change.size(); ++c) {
    change[c] =
        (lower != nullptr ? int{(*lower)[c]} : 0) - (upper != nullptr ? int{(*upper)[c]} : 0);
  }
  UnionFind<> parts = partsOf(plan, change);
  std::size_t count = 0;
  for (std::size_t c = 0; c < change.size(); ++c) count += change[c] != 0 && parts.find(c) == c;
  return count;
}

std::size_t countFloating(const LineArrangement& plan, const std::vector<char>& lower,
                          const std::vector<char>& upper) {
  UnionFind<> parts = partsOf(plan, {upper.begin(), upper.end()});
  std::vector<char> rests(upper.size(), 0);
  for (std::size_t c = 0; c < upper.size(); ++c) {
    if (upper[c] != 0 && lower[c] != 0) rests[parts.find(c)] = 1;
  }
  std::size_t count = 0;
  for (std::size_t c = 0; c < upper.size(); ++c) {
    count += upper[c] != 0 && parts.find(c) == c && rests[c] == 0;
  }
  return count;
}

}  // namespace

std::vector<OutlineRun> runsOf(const LineArrangement& plan, const CellTerms& terms,
                               const std::vector<char>& inside) {
  std::vector<OutlineRun> runs;
  int side = 0;  // of the edge before
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    const int own = sideOf(edge, inside);
    const bool joined = e > 0 && side == own && plan.edges[e - 1].line == edge.line &&
                        edge.s_min - plan.edges[e - 1].s_max < kTouching * edge.length();
    side = own;
    if (own == 0) continue;
    if (!joined) runs.push_back({e, e, own, 0.0});
    runs.back().last = e;
    runs.back().seen += std::max(0.0, own * terms.signed_area[e]);
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
  std::vector<const std::vector<OutlineRun>*> runs;
  for (const BlockOutline& block : blocks) runs.push_back(block.runs);
  std::size_t faces = countWalls(runs);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    faces += countCaps(plan, b > 0 ? blocks[b - 1].inside : nullptr, blocks[b].inside);
  }
  if (!blocks.empty()) faces += countCaps(plan, blocks.back().inside, nullptr);
  return faces;
}

std::size_t countFloating(const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
  std::size_t floating = 0;
  for (std::size_t b = 1; b < blocks.size(); ++b) {
    floating += countFloating(plan, *blocks[b - 1].inside, *blocks[b].inside);
  }
  return floating;
}

double jointComplexity(const LineArrangement& plan, const std::vector<char>* lower,
                       const std::vector<char>* upper) {
  const bool between = lower != nullptr && upper != nullptr;
  const std::size_t floating = between ? countFloating(plan, *lower, *upper) : 0;
  return static_cast<double>(countCaps(plan, lower, upper)) +
         kFloatingFaces * static_cast<double>(floating);
}

double complexityOf(const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
  return static_cast<double>(countFaces(plan, blocks)) +
         kFloatingFaces * static_cast<double>(countFloating(plan, blocks));
}

}  // namespace storey::detail
