// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>
#include <storey/segmentation/detail/outline_trade_off.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace storey::detail {
namespace {

constexpr double kCostStep = 1.25;

OutlineTradeOff describe(const LineArrangement& plan, double face_cost,
                         const std::vector<CellBlock>& blocks) {
  OutlineTradeOff point;
  point.face_cost = face_cost;
  std::vector<std::vector<OutlineRun>> runs;
  std::set<std::vector<char>> types;
  for (const CellBlock& block : blocks) {
    point.energy += block.energy;
    runs.push_back(runsOf(plan, block.terms, block.inside));
    if (!runs.back().empty()) types.insert(block.inside);
  }
  std::vector<BlockOutline> outlines;
  for (std::size_t b = 0; b < blocks.size(); ++b) outlines.push_back({&blocks[b].inside, &runs[b]});
  point.faces = countFaces(plan, outlines);
  point.types = types.size();
  return point;
}

// No two models differ by more in what they explain: where a face costs as much, only their faces
// count.
double decisiveCost(const std::vector<CellBlock>& blocks) {
  double sum = 0.0;
  for (const CellBlock& block : blocks) {
    for (const double area : block.terms.area) sum += area;
    for (const double cost : block.terms.unary) sum += std::abs(cost);
  }
  return 2.0 * sum;
}

// The whole height as one block.
CellBlock joined(const LineArrangement& plan, double gap, const std::vector<CellBlock>& blocks) {
  CellBlock one = blocks.front();
  for (std::size_t b = 1; b < blocks.size(); ++b) one.terms.add(blocks[b].terms);
  one.last_bin = blocks.back().last_bin;
  one.energy = minimumCut(plan, one.terms, gap, one.inside);
  one.measureCoverage();
  return one;
}

bool isWithin(const OutlineTradeOff& point, const SimplicityLimits& limits) {
  return (limits.max_faces == 0 || point.faces <= limits.max_faces) &&
         (limits.max_types == 0 || point.types <= limits.max_types);
}

}  // namespace

std::vector<OutlineTradeOff> simplifyOutlines(const LineArrangement& plan, double gap,
                                              double face_cost, const SimplicityLimits& limits,
                                              std::vector<CellBlock>& blocks,
                                              unsigned int threads) {
  std::vector<OutlineTradeOff> front = {describe(plan, face_cost, blocks)};
  bool within = isWithin(front.back(), limits);
  std::vector<CellBlock> current = blocks;
  const double decisive = decisiveCost(blocks);
  while (face_cost < decisive && front.back().faces > 0) {
    if (within && !limits.whole_front) break;
    face_cost *= kCostStep;
    // Step by step a stack may not come down to one block.
    if (face_cost >= decisive) current = {joined(plan, gap, current)};
    pruneOutlines(plan, gap, face_cost, current, false, threads);
    const OutlineTradeOff point = describe(plan, face_cost, current);
    if (point.faces == 0) break;  // nothing holds at all heights
    const bool simpler = point.faces < front.back().faces;
    if (simpler) front.push_back(point);
    if (!within && (simpler || isWithin(point, limits))) {
      blocks = current;
      within = isWithin(point, limits);
    }
  }
  return front;
}

}  // namespace storey::detail
