// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>
#include <storey/segmentation/detail/outline_trade_off.h>

#include <algorithm>
#include <set>

namespace storey::detail {
namespace {

constexpr double kCostStep = 1.25;
constexpr int kMaxSteps = 120;  // 1.25^120 is more than any building explains

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

bool isWithin(const OutlineTradeOff& point, const SimplicityLimits& limits) {
  return (limits.max_faces == 0 || point.faces <= limits.max_faces) &&
         (limits.max_types == 0 || point.types <= limits.max_types);
}

}  // namespace

std::vector<OutlineTradeOff> simplifyOutlines(const LineArrangement& plan, double gap,
                                              double face_cost, const SimplicityLimits& limits,
                                              std::vector<CellBlock>& blocks) {
  std::vector<OutlineTradeOff> front = {describe(plan, face_cost, blocks)};
  bool within = isWithin(front.back(), limits);
  std::vector<CellBlock> current = blocks;
  for (int step = 0; step < kMaxSteps && front.back().faces > 0; ++step) {
    if (within && !limits.whole_front) break;
    face_cost *= kCostStep;
    pruneOutlines(plan, gap, face_cost, current);
    const OutlineTradeOff point = describe(plan, face_cost, current);
    if (point.faces == 0) break;  // nothing earns its cost any more
    if (point.faces < front.back().faces) front.push_back(point);
    if (!within) {
      blocks = current;
      within = isWithin(point, limits);
    }
  }
  return front;
}

}  // namespace storey::detail
