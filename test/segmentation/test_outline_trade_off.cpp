// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>
#include <storey/segmentation/detail/outline_trade_off.h>

#include <set>

#include "cell_blocks.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::BlockOutline;
using detail::OutlineRun;
using detail::OutlineTradeOff;
using detail::SimplicityLimits;
using detail::simplifyOutlines;

constexpr double kCost = 0.2;
constexpr int kStacks = 25;

LineArrangement somePlan() {
  return arrangeLines(gridLines({2, 4, 7, 10}, {1, 3, 6, 8}), {0, 0}, {12, 10}, 1e-9);
}

// Pruned, as the blocks are that come in.
std::vector<CellBlock> prunedStack(const LineArrangement& plan, std::mt19937& random) {
  std::vector<CellBlock> blocks = randomStack(plan, random);
  pruneOutlines(plan, kGap, kCost, blocks);
  return blocks;
}

std::size_t facesOf(const LineArrangement& plan, const std::vector<CellBlock>& blocks) {
  std::vector<std::vector<OutlineRun>> runs;
  std::vector<BlockOutline> stack;
  for (const CellBlock& block : blocks) runs.push_back(runsOf(plan, block.terms, block.inside));
  for (std::size_t b = 0; b < blocks.size(); ++b) stack.push_back({&blocks[b].inside, &runs[b]});
  return countFaces(plan, stack);
}

std::size_t typesOf(const std::vector<CellBlock>& blocks) {
  std::set<std::vector<char>> types;
  for (const CellBlock& block : blocks) {
    if (std::count(block.inside.begin(), block.inside.end(), 1) > 0) types.insert(block.inside);
  }
  return types.size();
}

double sumOfEnergies(const LineArrangement& plan, const std::vector<CellBlock>& blocks) {
  double sum = 0.0;
  for (const CellBlock& block : blocks) sum += energyOf(plan, block.terms, block.inside);
  return sum;
}

void expectSame(const std::vector<CellBlock>& one, const std::vector<CellBlock>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t b = 0; b < one.size(); ++b) {
    EXPECT_EQ(one[b].last_bin, other[b].last_bin);
    EXPECT_EQ(one[b].inside, other[b].inside);
  }
}

TEST(OutlineTradeOff, WithoutLimitsThereIsOnePointAndNothingChanges) {
  const LineArrangement plan = somePlan();
  std::mt19937 random(1);
  for (int round = 0; round < kStacks; ++round) {
    const std::vector<CellBlock> before = prunedStack(plan, random);
    std::vector<CellBlock> after = before;
    const std::vector<OutlineTradeOff> front = simplifyOutlines(plan, kGap, kCost, {}, after);
    expectSame(after, before);
    ASSERT_EQ(front.size(), 1U);
    EXPECT_EQ(front[0].face_cost, kCost);
    EXPECT_EQ(front[0].faces, facesOf(plan, before));
    EXPECT_EQ(front[0].types, typesOf(before));
    EXPECT_NEAR(front[0].energy, sumOfEnergies(plan, before), kExact);
  }
}

TEST(OutlineTradeOff, AlongTheFrontFacesFallWhileCostsAndEnergiesRise) {
  const LineArrangement plan = somePlan();
  std::mt19937 random(2);
  std::size_t points = 0;
  for (int round = 0; round < kStacks; ++round) {
    const std::vector<CellBlock> before = prunedStack(plan, random);
    std::vector<CellBlock> after = before;
    SimplicityLimits limits;
    limits.whole_front = true;
    const std::vector<OutlineTradeOff> front = simplifyOutlines(plan, kGap, kCost, limits, after);
    expectSame(after, before);  // the front alone was asked for
    points += front.size();
    for (std::size_t i = 0; i + 1 < front.size(); ++i) {
      EXPECT_GT(front[i].faces, front[i + 1].faces);
      EXPECT_LT(front[i].face_cost, front[i + 1].face_cost);
      EXPECT_LT(front[i].energy, front[i + 1].energy + kExact) << "round " << round;
    }
    // No solid of these walls has less faces than a box.
    EXPECT_GE(front.back().faces, front[0].faces > 0 ? 6U : 0U);
  }
  EXPECT_GT(points, 2U * kStacks) << "weak cases";
}

TEST(OutlineTradeOff, LimitsGiveTheFirstPointWithinOrTheSimplestModel) {
  const LineArrangement plan = somePlan();
  std::mt19937 random(3);
  int reached = 0;
  int missed = 0;
  for (int round = 0; round < kStacks; ++round) {
    const std::vector<CellBlock> before = prunedStack(plan, random);
    std::vector<CellBlock> same = before;
    SimplicityLimits whole;
    whole.whole_front = true;
    const std::vector<OutlineTradeOff> front = simplifyOutlines(plan, kGap, kCost, whole, same);
    for (const std::size_t max_faces : {5U, 6U, 8U, 12U, 20U, 100U}) {
      std::vector<CellBlock> after = before;
      SimplicityLimits limits;
      limits.max_faces = max_faces;
      simplifyOutlines(plan, kGap, kCost, limits, after);
      const auto first =
          std::find_if(front.begin(), front.end(),
                       [&](const OutlineTradeOff& point) { return point.faces <= max_faces; });
      const OutlineTradeOff& expected = first != front.end() ? *first : front.back();
      EXPECT_EQ(facesOf(plan, after), expected.faces);
      (first != front.end() ? reached : missed) += 1;
      if (first == front.begin()) expectSame(after, before);
      // The trade-off may be asked for as well, and does not change the model.
      limits.whole_front = true;
      std::vector<CellBlock> with_front = before;
      EXPECT_EQ(simplifyOutlines(plan, kGap, kCost, limits, with_front).size(), front.size());
      expectSame(with_front, after);
    }
  }
  EXPECT_GT(reached, kStacks) << "weak cases";
  EXPECT_GT(missed, kStacks / 2) << "weak cases";
}

TEST(OutlineTradeOff, LimitsOnTypesAreKept) {
  const LineArrangement plan = somePlan();
  std::mt19937 random(4);
  int simplified = 0;
  for (int round = 0; round < kStacks; ++round) {
    const std::vector<CellBlock> before = prunedStack(plan, random);
    for (const std::size_t max_types : {1U, 2U}) {
      std::vector<CellBlock> after = before;
      SimplicityLimits limits;
      limits.max_types = max_types;
      simplifyOutlines(plan, kGap, kCost, limits, after);
      EXPECT_LE(typesOf(after), max_types);
      EXPECT_EQ(typesOf(before) == 0, typesOf(after) == 0);
      if (typesOf(before) <= max_types) {
        expectSame(after, before);
      } else {
        ++simplified;
      }
    }
  }
  EXPECT_GT(simplified, 5) << "weak cases";
}

TEST(OutlineTradeOff, ABoxWithALowTowerBecomesABox) {
  // 8 faces and 6. One box for both misses the tower's wall of 10 and guesses 20 of its own, half
  // of it at the ends of two walls that are seen up to the tower.
  const LineArrangement plan = arrangeLines(gridLines({2, 7, 12}, {2, 12}), {0, 0}, {14, 14}, 1e-9);
  std::vector<CellBlock> blocks = {
      blockOf(plan, wallsAround(plan, rectangle(2, 2, 12, 12)), 0, 8, 0.5),
      blockOf(plan, wallsAround(plan, rectangle(2, 2, 7, 12)), 8, 10, 0.5)};
  SimplicityLimits limits;
  limits.max_faces = 7;
  const std::vector<OutlineTradeOff> front = simplifyOutlines(plan, kGap, 1.0, limits, blocks);
  ASSERT_EQ(front.size(), 2U);
  EXPECT_EQ(front[0].faces, 8U);
  EXPECT_EQ(front[0].types, 2U);
  EXPECT_NEAR(front[0].energy, -4.0 * 40.0 - 1.0 * 30.0, kExact);
  EXPECT_EQ(front[1].faces, 6U);
  EXPECT_EQ(front[1].types, 1U);
  EXPECT_NEAR(front[1].energy, front[0].energy + 10.0 + kGap * 20.0, kExact);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].inside, cellsOf(plan, rectangle(2, 2, 12, 12)));
}

TEST(OutlineTradeOff, AHighTowerIsNoReasonForNothing) {
  // Of box and tower, as high as each other, one box explains so little more than nothing that
  // nothing at all is better than either once a face costs 20; one type must still be a model.
  const LineArrangement plan = arrangeLines(gridLines({2, 7, 12}, {2, 12}), {0, 0}, {14, 14}, 1e-9);
  std::vector<CellBlock> blocks = {
      blockOf(plan, wallsAround(plan, rectangle(2, 2, 12, 12)), 0, 8, 0.5),
      blockOf(plan, wallsAround(plan, rectangle(2, 2, 7, 12)), 8, 16, 0.5)};
  SimplicityLimits limits;
  limits.max_types = 1;
  simplifyOutlines(plan, kGap, 1.0, limits, blocks);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].last_bin, 16U);
  EXPECT_EQ(facesOf(plan, blocks), 6U);
}

TEST(OutlineTradeOff, NoBlocksHaveNoFaces) {
  std::vector<CellBlock> none;
  SimplicityLimits limits;
  limits.max_faces = 6;
  limits.whole_front = true;
  const std::vector<OutlineTradeOff> front =
      simplifyOutlines(somePlan(), kGap, kCost, limits, none);
  ASSERT_EQ(front.size(), 1U);
  EXPECT_EQ(front[0].faces, 0U);
  EXPECT_TRUE(none.empty());
}

}  // namespace
