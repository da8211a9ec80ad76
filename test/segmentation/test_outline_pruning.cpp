// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>

#include <limits>
#include <set>

#include "cell_blocks.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::BlockOutline;
using detail::OutlineRun;
using detail::pruneOutlines;

// F as its header states it; faces are counted as in test_outline_faces.
double objectiveOf(const LineArrangement& plan, double cost, const std::vector<CellBlock>& blocks) {
  double energy = 0.0;
  std::set<int> lines;
  std::vector<std::vector<OutlineRun>> runs;
  for (const CellBlock& block : blocks) {
    energy += energyOf(plan, block.terms, block.inside);
    runs.push_back(runsOf(plan, block.terms, block.inside));
    for (const PlanEdge& edge : plan.edges) {
      if (bounds(edge, block.inside)) lines.insert(edge.line);
    }
  }
  std::vector<BlockOutline> stack;
  for (std::size_t b = 0; b < blocks.size(); ++b) stack.push_back({&blocks[b].inside, &runs[b]});
  return energy + cost * (complexityOf(plan, stack) + static_cast<double>(lines.size()));
}

// The least energy of all labelings that are bounded by some of the edges that bound this one.
double leastWithItsEdges(const LineArrangement& plan, const CellBlock& block) {
  std::vector<std::size_t> free;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    if (plan.at_border[c] == 0) free.push_back(c);
  }
  double least = std::numeric_limits<double>::infinity();
  std::vector<char> inside(plan.cells.size(), 0);
  for (unsigned mask = 0; mask < 1U << free.size(); ++mask) {
    for (std::size_t i = 0; i < free.size(); ++i) inside[free[i]] = (mask >> i & 1U) != 0 ? 1 : 0;
    const bool allowed = std::all_of(
        plan.edges.begin(), plan.edges.end(),
        [&](const PlanEdge& edge) { return !bounds(edge, inside) || bounds(edge, block.inside); });
    if (allowed) least = std::min(least, energyOf(plan, block.terms, inside));
  }
  return least;
}

TEST(OutlinePruning, NeverRaisesTheObjectiveAndEachBlockIsTheBestWithItsEdges) {
  const LineArrangement plan =
      arrangeLines(gridLines({2, 4, 7, 10}, {1, 3, 6, 8}), {0, 0}, {12, 10}, 1e-9);
  std::mt19937 random(1);
  int simplified = 0;
  int merged = 0;
  for (int round = 0; round < 100; ++round) {
    const std::vector<CellBlock> before = randomStack(plan, random);
    const double cost = std::uniform_real_distribution<double>(0.05, 3.0)(random);
    std::vector<CellBlock> after = before;
    pruneOutlines(plan, kGap, cost, after);
    const double from = objectiveOf(plan, cost, before);
    const double to = objectiveOf(plan, cost, after);
    EXPECT_LE(to, from + kExact) << "round " << round;
    if (to < from - kExact) ++simplified;
    if (after.size() < before.size()) ++merged;
    // The blocks are still a stack of the same height, and hold the same areas.
    ASSERT_FALSE(after.empty());
    EXPECT_EQ(after.back().last_bin, before.back().last_bin);
    for (std::size_t b = 0; b < after.size(); ++b) {
      const CellBlock& block = after[b];
      EXPECT_EQ(block.first_bin, b > 0 ? after[b - 1].last_bin : 0U);
      for (std::size_t e = 0; e < plan.edges.size(); ++e) {
        double seen = 0.0;
        for (const CellBlock& part : before) {
          const bool within = part.first_bin >= block.first_bin && part.last_bin <= block.last_bin;
          if (within) seen += part.terms.signed_area[e];
        }
        EXPECT_NEAR(block.terms.signed_area[e], seen, kExact);
        EXPECT_NEAR(block.coverage[e] * block.terms.area[e], seen, kExact);
      }
      EXPECT_NEAR(block.energy, energyOf(plan, block.terms, block.inside), kExact);
      // Whatever is forbidden, the edges that bound it are not.
      EXPECT_NEAR(block.energy, leastWithItsEdges(plan, block), kExact) << "round " << round;
    }
  }
  EXPECT_GT(simplified, 30) << "weak cases";
  EXPECT_GT(merged, 10) << "weak cases";
}

TEST(OutlinePruning, TheSameInputGivesTheSameBlocksInAnyNumberOfThreads) {
  const LineArrangement plan =
      arrangeLines(gridLines({2, 4, 7, 10}, {1, 3, 6, 8}), {0, 0}, {12, 10}, 1e-9);
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    std::vector<CellBlock> one = randomStack(plan, random);
    std::vector<CellBlock> other = one;
    pruneOutlines(plan, kGap, 0.5, one, true, 1);
    pruneOutlines(plan, kGap, 0.5, other, true, 3);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t b = 0; b < one.size(); ++b) {
      EXPECT_EQ(one[b].last_bin, other[b].last_bin);
      EXPECT_EQ(one[b].inside, other[b].inside);
      EXPECT_EQ(one[b].energy, other[b].energy);
    }
  }
}

TEST(OutlinePruning, WithoutACostNothingChanges) {
  const LineArrangement plan =
      arrangeLines(gridLines({2, 4, 7, 10}, {1, 3, 6, 8}), {0, 0}, {12, 10}, 1e-9);
  std::mt19937 random(3);
  const std::vector<CellBlock> before = randomStack(plan, random);
  std::vector<CellBlock> after = before;
  pruneOutlines(plan, kGap, 0.0, after);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t b = 0; b < after.size(); ++b) EXPECT_EQ(after[b].inside, before[b].inside);
  std::vector<CellBlock> none;
  pruneOutlines(plan, kGap, 1.0, none);
  EXPECT_TRUE(none.empty());
}

// A box of 10 and a notch of 1 x 4 in its corner, of which more or less was seen.
class Notch {
 public:
  const LineArrangement plan =
      arrangeLines(gridLines({2, 11, 12}, {2, 6, 12}), {0, 0}, {14, 14}, 1e-9);
  const std::vector<char> box = cellsOf(plan, rectangle(2, 2, 12, 12));
  const std::vector<char> notched = cellsOf(plan, [](const Eigen::Vector2d& p) {
    return rectangle(2, 2, 12, 12)(p) && !rectangle(11, 2, 12, 6)(p);
  });

  // All walls of the box but the one at the notch are seen.
  CellBlock block(double at_box, double at_notch, double across) const {
    std::vector<double> shares = wallsAround(plan, rectangle(2, 2, 12, 12));
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      const PlanEdge& edge = plan.edges[e];
      const PlanLine& line = plan.lines[static_cast<std::size_t>(edge.line)];
      const Eigen::Vector2d middle =
          line.offset * line.normal + 0.5 * (edge.s_min + edge.s_max) * line.tangent();
      if ((middle - Eigen::Vector2d(12, 4)).norm() < 0.1) shares[e] = at_box;
      if ((middle - Eigen::Vector2d(11, 4)).norm() < 0.1) shares[e] = at_notch;
      // The inside is above the wall across, whose normal points up: its outside is behind.
      if ((middle - Eigen::Vector2d(11.5, 6)).norm() < 0.1) shares[e] = -across;
    }
    return blockOf(plan, shares, 0, 1, 1.0);
  }
};

TEST(OutlinePruning, ANotchStaysWhileItEarnsItsTwoFacesAndTwoLines) {
  // E of what differs, with areas 4 and 1 and a share s seen: -s A + gap (1 - s) A each.
  const auto earned = [](double share, double area) {
    return share * area - kGap * (1.0 - share) * area;
  };
  const Notch notch;
  struct Case {
    double at_box, at_notch, across;
  };
  for (const Case& c : {Case{0.5, 0.8, 0.0}, Case{0.0, 1.0, 1.0}, Case{0.2, 0.7, 0.6}}) {
    // The notch has its own wall and the one across; the box those on the outside.
    const double gain =
        earned(c.at_notch, 4.0) + earned(c.across, 1.0) - earned(c.at_box, 4.0) - earned(1.0, 1.0);
    ASSERT_GT(gain, 0.0);
    const CellBlock cut = notch.block(c.at_box, c.at_notch, c.across);
    ASSERT_EQ(cut.inside, notch.notched);
    std::vector<CellBlock> blocks = {cut};
    pruneOutlines(notch.plan, kGap, 0.95 * gain / 4.0, blocks);
    EXPECT_EQ(blocks[0].inside, notch.notched) << gain;
    blocks = {cut};
    pruneOutlines(notch.plan, kGap, 1.05 * gain / 4.0, blocks);
    EXPECT_EQ(blocks[0].inside, notch.box) << gain;
  }
}

TEST(OutlinePruning, AThinBlockThatDiffersByLittleBecomesOneWithItsNeighbour) {
  // Storeys of 8 below and above; between them, over a height of 0.2, the notch seems to be there.
  const Notch notch;
  const std::vector<double> whole = wallsAround(notch.plan, rectangle(2, 2, 12, 12));
  CellBlock thin = notch.block(0.0, 1.0, 1.0);
  ASSERT_EQ(thin.inside, notch.notched);
  thin = blockOf(notch.plan, thin.coverage, 40, 41, 0.2);
  std::vector<CellBlock> blocks = {blockOf(notch.plan, whole, 0, 40, 0.2), thin,
                                   blockOf(notch.plan, whole, 41, 81, 0.2)};
  pruneOutlines(notch.plan, kGap, 1.0, blocks);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].last_bin, 81U);
  EXPECT_EQ(blocks[0].inside, notch.box);
}

TEST(OutlinePruning, BlocksThatTrulyDifferStay) {
  // A tower of 4 on half of a box of 4: one block for both leaves 10 x 4 of wall unexplained, in
  // the middle or at the end, which saves three faces and a line.
  const LineArrangement plan = arrangeLines(gridLines({2, 7, 12}, {2, 12}), {0, 0}, {14, 14}, 1e-9);
  const Shape box = rectangle(2, 2, 12, 12);
  const Shape half = rectangle(2, 2, 7, 12);
  std::vector<CellBlock> blocks = {blockOf(plan, wallsAround(plan, box), 0, 8, 0.5),
                                   blockOf(plan, wallsAround(plan, half), 8, 16, 0.5)};
  pruneOutlines(plan, kGap, 2.0, blocks);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].inside, cellsOf(plan, box));
  EXPECT_EQ(blocks[1].inside, cellsOf(plan, half));
  EXPECT_EQ(blocks[0].last_bin, 8U);
}

}  // namespace
