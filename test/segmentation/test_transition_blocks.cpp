// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/transition_blocks.h>

#include <limits>

#include "cell_blocks.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::BlockOutline;
using detail::divideTransitions;
using detail::OutlineRun;
using detail::WallEvidence;

constexpr double kBin = 0.5;
constexpr double kRounded = 1e-3;  // seen areas are floats
const Shape kBox = rectangle(2, 2, 12, 12);
const Shape kHalf = rectangle(2, 2, 7, 12);
const Shape kQuarter = rectangle(2, 2, 7, 7);

LineArrangement plan3() {
  return arrangeLines(gridLines({2, 7, 12}, {2, 7, 12}), {0, 0}, {14, 14}, 1e-9);
}

// Evidence of the walls around a shape in each bin, of which shares are seen.
template <typename Share>
WallEvidence evidenceOf(const LineArrangement& plan, const std::vector<Shape>& shapes,
                        Share share) {
  WallEvidence evidence;
  evidence.bin = kBin;
  evidence.num_bins = shapes.size();
  evidence.seen.resize(plan.edges.size() * shapes.size());
  for (std::size_t b = 0; b < shapes.size(); ++b) {
    const std::vector<double> walls = wallsAround(plan, shapes[b]);
    for (std::size_t e = 0; e < walls.size(); ++e) {
      evidence.seen[e * shapes.size() + b] =
          static_cast<float>(walls[e] * share(e) * kBin * plan.edges[e].length());
    }
  }
  return evidence;
}

// What lies between two bins, summed here.
std::vector<double> sharesOf(const LineArrangement& plan, const WallEvidence& evidence,
                             std::size_t first, std::size_t last) {
  std::vector<double> shares;
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    double seen = 0.0;
    for (std::size_t b = first; b < last; ++b) {
      seen += static_cast<double>(evidence.seen[e * evidence.num_bins + b]);
    }
    const double area = kBin * static_cast<double>(last - first) * plan.edges[e].length();
    shares.push_back(area > 0.0 ? seen / area : 0.0);
  }
  return shares;
}

// A stack with these boundaries; each block is cut.
std::vector<CellBlock> stackOf(const LineArrangement& plan, const WallEvidence& evidence,
                               const std::vector<std::size_t>& bins) {
  std::vector<CellBlock> blocks;
  for (std::size_t b = 0; b + 1 < bins.size(); ++b) {
    blocks.push_back(
        blockOf(plan, sharesOf(plan, evidence, bins[b], bins[b + 1]), bins[b], bins[b + 1], kBin));
  }
  return blocks;
}

double objectiveOf(const LineArrangement& plan, double cost, const std::vector<CellBlock>& blocks) {
  double energy = 0.0;
  std::vector<std::vector<OutlineRun>> runs;
  std::vector<BlockOutline> stack;
  for (const CellBlock& block : blocks) {
    energy += energyOf(plan, block.terms, block.inside);
    runs.push_back(runsOf(plan, block.terms, block.inside));
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) stack.push_back({&blocks[b].inside, &runs[b]});
  return energy + cost * complexityOf(plan, stack);
}

TEST(TransitionBlocks, AChangeWithinALayerIsFoundAtItsBin) {
  const LineArrangement plan = plan3();
  for (std::size_t change = 11; change < 20; ++change) {
    std::vector<Shape> shapes(30, kBox);
    std::fill(shapes.begin() + static_cast<std::ptrdiff_t>(change), shapes.end(), kHalf);
    const WallEvidence evidence = evidenceOf(plan, shapes, [](std::size_t) { return 0.9; });
    std::vector<CellBlock> blocks = stackOf(plan, evidence, {0, 10, 20, 30});
    divideTransitions(plan, evidence, kGap, 1.0, blocks);
    ASSERT_EQ(blocks.size(), 2U) << change;
    EXPECT_EQ(blocks[0].last_bin, change);
    EXPECT_EQ(blocks[1].first_bin, change);
    EXPECT_EQ(blocks[1].last_bin, 30U);
    EXPECT_EQ(blocks[0].inside, cellsOf(plan, kBox));
    EXPECT_EQ(blocks[1].inside, cellsOf(plan, kHalf));
    for (const CellBlock& block : blocks) {
      // Nothing but the walls of its own shape is in it, and 0.9 of them are seen.
      const double height = kBin * static_cast<double>(block.last_bin - block.first_bin);
      const double length = block.first_bin == 0 ? 40.0 : 30.0;
      EXPECT_NEAR(block.energy, height * length * (-0.9 + kGap * 0.1), kRounded);
      EXPECT_NEAR(block.energy, energyOf(plan, block.terms, block.inside), kExact);
      for (std::size_t e = 0; e < plan.edges.size(); ++e) {
        EXPECT_NEAR(block.terms.area[e], height * plan.edges[e].length(), kExact);
        EXPECT_NEAR(block.coverage[e] * block.terms.area[e], block.terms.signed_area[e], kExact);
      }
    }
  }
}

TEST(TransitionBlocks, ABlockThatIsThereStaysWhileItEarnsItsFaces) {
  // Box, half and quarter on each other. Without the half, which has three walls of 10, 10 and 5
  // beyond those of the quarter and two faces (wall and terrace) of its own, its bins are best
  // given to the quarter: lost are its wall at y = 12, the parts of the others above y = 7, and
  // what the quarter's wall at y = 7 costs where nothing is seen.
  const LineArrangement plan = plan3();
  std::vector<Shape> shapes(30, kBox);
  std::fill(shapes.begin() + 10, shapes.end(), kHalf);
  std::fill(shapes.begin() + 20, shapes.end(), kQuarter);
  const WallEvidence evidence = evidenceOf(plan, shapes, [](std::size_t) { return 1.0; });
  const std::vector<CellBlock> before = stackOf(plan, evidence, {0, 10, 20, 30});
  ASSERT_EQ(before[1].inside, cellsOf(plan, kHalf));
  const double height = 10 * kBin;
  const double to_quarter = height * (5.0 + 5.0 + 5.0 + kGap * 5.0);
  // To the box: the wall at x = 7 is lost, those of the box's other half are guessed.
  const double to_box = height * (10.0 + kGap * (5.0 + 10.0 + 5.0));
  const std::vector<CellBlock> two = {before[0], before[2]};
  const double saved = objectiveOf(plan, 1.0, before) - objectiveOf(plan, 0.0, before) -
                       objectiveOf(plan, 1.0, two) + objectiveOf(plan, 0.0, two);
  ASSERT_GT(saved, 0.0);
  const double least = std::min(to_quarter, to_box) / saved;
  std::vector<CellBlock> blocks = before;
  divideTransitions(plan, evidence, kGap, 0.95 * least, blocks);
  ASSERT_EQ(blocks.size(), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(blocks[b].inside, before[b].inside);
    EXPECT_EQ(blocks[b].last_bin, before[b].last_bin);
  }
  divideTransitions(plan, evidence, kGap, 1.05 * least, blocks);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].last_bin, to_quarter < to_box ? 10U : 20U);
}

TEST(TransitionBlocks, TheDivisionIsTheBestOfAll) {
  const LineArrangement plan = plan3();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<Shape> all = {kBox, kHalf, kQuarter, rectangle(2, 7, 12, 12)};
  int divided = 0;
  int kept = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<double> seen;
    for (std::size_t e = 0; e < plan.edges.size(); ++e) seen.push_back(unit(random));
    std::vector<Shape> shapes(12, all[random() % 2]);
    std::fill(shapes.begin() + 2 + static_cast<std::ptrdiff_t>(random() % 3), shapes.end(),
              all[random() % 4]);
    std::fill(shapes.begin() + 6 + static_cast<std::ptrdiff_t>(random() % 3), shapes.end(),
              all[random() % 4]);
    const WallEvidence evidence = evidenceOf(plan, shapes, [&](std::size_t e) { return seen[e]; });
    const std::vector<CellBlock> before = stackOf(plan, evidence, {0, 4, 8, 12});
    const double cost = 3.0 * unit(random);
    const double now = objectiveOf(plan, cost, before);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t bin = 4; bin <= 8; ++bin) {
      std::vector<CellBlock> trial = {
          blockOf(plan, sharesOf(plan, evidence, 0, bin), 0, bin, kBin),
          blockOf(plan, sharesOf(plan, evidence, bin, 12), bin, 12, kBin)};
      trial[0].inside = before[0].inside;
      trial[1].inside = before[2].inside;
      least = std::min(least, objectiveOf(plan, cost, trial));
    }
    std::vector<CellBlock> after = before;
    divideTransitions(plan, evidence, kGap, cost, after);
    EXPECT_NEAR(objectiveOf(plan, cost, after), std::min(now, least), kRounded) << round;
    (after.size() < before.size() ? divided : kept) += 1;
    for (const CellBlock& block : after) {
      EXPECT_NEAR(block.energy, energyOf(plan, block.terms, block.inside), kExact);
    }
  }
  EXPECT_GT(divided, 20) << "weak cases";
  EXPECT_GT(kept, 20) << "weak cases";
}

TEST(TransitionBlocks, WhatLevelPointsSayIsSharedOutByHeight) {
  const LineArrangement plan = plan3();
  std::vector<Shape> shapes(30, kBox);
  std::fill(shapes.begin() + 13, shapes.end(), kHalf);
  const WallEvidence evidence = evidenceOf(plan, shapes, [](std::size_t) { return 1.0; });
  std::vector<CellBlock> blocks = stackOf(plan, evidence, {0, 10, 20, 30});
  const std::size_t cell = cellAt(plan, {3, 3});
  blocks[1].terms.unary[cell] = -2.0;
  blocks[1].energy -= 2.0;
  divideTransitions(plan, evidence, kGap, 1.0, blocks);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_NEAR(blocks[0].terms.unary[cell], -2.0 * 3 / 10, kExact);
  EXPECT_NEAR(blocks[1].terms.unary[cell], -2.0 * 7 / 10, kExact);
}

TEST(TransitionBlocks, StacksOfLessThanThreeStay) {
  const LineArrangement plan = plan3();
  const WallEvidence evidence =
      evidenceOf(plan, std::vector<Shape>(10, kBox), [](std::size_t) { return 1.0; });
  for (const std::vector<std::size_t>& bins : {std::vector<std::size_t>{0}, {0, 10}, {0, 5, 10}}) {
    std::vector<CellBlock> blocks = stackOf(plan, evidence, bins);
    divideTransitions(plan, evidence, kGap, 100.0, blocks);
    EXPECT_EQ(blocks.size(), bins.size() - 1);
  }
}

}  // namespace
