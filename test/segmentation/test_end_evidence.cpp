// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/detail/end_evidence.h>

#include <cmath>
#include <vector>

#include "plans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::noteEnds;
using detail::WallEnd;
using detail::WallEvidence;

constexpr double kReach = 2.5;
constexpr double kApart = 0.1;
constexpr std::size_t kBins = 12;
constexpr double kBin = 0.5;

WallEvidence nothingSeen(const LineArrangement& plan) {
  WallEvidence evidence;
  evidence.z_min = 1.0;
  evidence.bin = kBin;
  evidence.num_bins = kBins;
  evidence.seen.assign(plan.edges.size() * kBins, 0.0f);
  return evidence;
}

// Of a wall on x = 2 that faces -x, and goes on to neither more nor less than y.
WallEnd endAt(double y, bool up) {
  return {{2.0, y}, {-1.0, 0.0}, {0.0, up ? 1.0 : -1.0}, 2.0, 5.0, 3.0};
}

bool isOnFirstLine(const PlanEdge& edge) { return edge.line == 0; }

TEST(NoteEnds, AreTheStretchesBeyondOnTheWallsOwnLineAtItsHeights) {
  const LineArrangement plan = arrangeLines(gridLines({2, 5}, {1, 4, 8}), {0, 0}, {10, 10}, 1e-6);
  for (const bool up : {false, true}) {
    WallEvidence evidence = nothingSeen(plan);
    noteEnds(plan, {endAt(5.0, up)}, kReach, kApart, evidence);
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      double length = 0.0;  // of the edge that is beyond, point by point
      constexpr int kSteps = 1000;
      const PlanLine& line = plan.lines[static_cast<std::size_t>(plan.edges[e].line)];
      for (int i = 0; i < kSteps; ++i) {
        const double s = plan.edges[e].s_min + plan.edges[e].length() * (i + 0.5) / kSteps;
        const Eigen::Vector2d p = line.offset * line.normal + s * line.tangent();
        const double beyond = up ? p.y() - 5.0 : 5.0 - p.y();
        if (isOnFirstLine(plan.edges[e]) && beyond > 0.0 && beyond < kReach) {
          length += plan.edges[e].length() / kSteps;
        }
      }
      for (std::size_t b = 0; b < kBins; ++b) {
        const double z = evidence.z_min + kBin * (static_cast<double>(b) + 0.5);
        const double area = z > 2.0 && z < 5.0 ? length * kBin : 0.0;
        EXPECT_NEAR(evidence.beyond[e * kBins + b], area, 0.01) << up << e << b;
      }
    }
  }
}

TEST(NoteEnds, TwoOfOneWallAtOnePlaceAreOne) {
  const LineArrangement plan = arrangeLines(gridLines({2, 5}, {1, 4, 8}), {0, 0}, {10, 10}, 1e-6);
  WallEvidence once = nothingSeen(plan);
  WallEvidence twice = once;
  noteEnds(plan, {endAt(5.0, true)}, kReach, kApart, once);
  noteEnds(plan, {endAt(5.0, true), endAt(5.0, true)}, kReach, kApart, twice);
  EXPECT_EQ(once.beyond, twice.beyond);
  noteEnds(plan, {}, kReach, kApart, once);
  EXPECT_EQ(once.beyond, twice.beyond);
}

TEST(NoteEnds, AWallOnAnotherLineHasNone) {
  PlanLines lines = gridLines({2, 5}, {1, 4, 8});
  lines[0].hypothetical = true;
  for (const bool guessed : {false, true}) {
    const double x = guessed ? 2.0 : 2.0 + 2.0 * kApart;
    lines[0].hypothetical = guessed;
    const LineArrangement plan = arrangeLines(lines, {0, 0}, {10, 10}, 1e-6);
    WallEvidence evidence = nothingSeen(plan);
    WallEnd end = endAt(5.0, true);
    end.place.x() = x;
    noteEnds(plan, {end}, kReach, kApart, evidence);
    for (const float area : evidence.beyond) EXPECT_EQ(area, 0.0f);
  }
}

// Three sides of a square with a chamfer at (8, 8) that nothing shows: it is as long as sqrt(2) of
// what either wall lacks of the corner, the walls twice that.
TEST(NoteEnds, AWallBetweenTwoEndsIsPreferredToTheirCorner) {
  constexpr double kCut = 1.0;
  PlanLines lines = gridLines({2, 8}, {2, 8});
  const double diagonal = std::sqrt(0.5);
  lines.push_back({{diagonal, diagonal}, diagonal * (16.0 - kCut), true});
  const LineArrangement plan = arrangeLines(lines, {0, 0}, {10, 10}, 1e-6);
  WallEvidence evidence = nothingSeen(plan);
  const auto inside = [&](const Eigen::Vector2d& p, bool chamfered) {
    return p.x() > 2 && p.x() < 8 && p.y() > 2 && p.y() < 8 &&
           (!chamfered || p.x() + p.y() < 16.0 - kCut);
  };
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const PlanEdge& edge = plan.edges[e];
    if (plan.lines[static_cast<std::size_t>(edge.line)].hypothetical) continue;
    const auto in = [&](int c) {
      return inside(middleOf(plan.cells[static_cast<std::size_t>(c)]), true) ? 1.0 : 0.0;
    };
    const double seen = (in(edge.behind) - in(edge.ahead)) * edge.length() * kBin;
    for (std::size_t b = 0; b < kBins; ++b) {
      evidence.seen[e * kBins + b] = static_cast<float>(seen);
    }
  }
  const double z_max = evidence.heightOf(kBins);
  const std::vector<WallEnd> ends = {
      {{8.0, 8.0 - kCut}, {1.0, 0.0}, {0.0, 1.0}, evidence.z_min, z_max, z_max},
      {{8.0 - kCut, 8.0}, {0.0, 1.0}, {1.0, 0.0}, evidence.z_min, z_max, z_max}};
  const auto gain = [&](const WallEvidence& known) {  // of the chamfer over the corner
    const detail::CellTerms terms = detail::termsOfBins(plan, known, 0, kBins);
    std::vector<char> with, without;
    for (const PlanCell& cell : plan.cells) {
      with.push_back(inside(middleOf(cell), true) ? 1 : 0);
      without.push_back(inside(middleOf(cell), false) ? 1 : 0);
    }
    constexpr double kGap = 0.5;
    return (detail::energyOf(plan, terms, kGap, without) -
            detail::energyOf(plan, terms, kGap, with)) /
           (kGap * kBin * kBins);
  };
  EXPECT_NEAR(gain(evidence), (2.0 - std::sqrt(2.0)) * kCut, 1e-5);
  noteEnds(plan, ends, kReach, kApart, evidence);
  EXPECT_NEAR(gain(evidence), (4.0 - std::sqrt(2.0)) * kCut, 1e-5);
}

}  // namespace
