// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/dominant_floorplans.h>

#include <random>
#include <set>

#include "../segmentation/floorplans.h"

namespace {

using namespace storey;
using namespace storey::test;

const Corners kL = {{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}};
const Corners kTower = box(0, 0, 10, 20);
const Corners kTop = box(0, 0, 10, 9);

Floorplan noisyPlan(const std::vector<Corners>& rings, double deviation, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, deviation);
  Floorplan plan;
  for (Corners ring : rings) {
    for (Eigen::Vector2d& v : ring) v += Eigen::Vector2d(noise(random), noise(random));
    plan.components.push_back({ringOf(ring), {}});
  }
  return plan;
}

// Slices of thickness 1 from z = 0, `count` of each kind, every one with noise of its own.
std::vector<FloorplanLayer> slicesOf(
    const std::vector<std::pair<std::vector<Corners>, int>>& storeys, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<FloorplanLayer> slices;
  for (const auto& [rings, count] : storeys) {
    for (int i = 0; i < count; ++i) {
      const auto z = static_cast<double>(slices.size());
      slices.push_back({z, z + 1.0, noisyPlan(rings, 0.02, random)});
    }
  }
  return slices;
}

DominantFloorplanOptions options() {
  DominantFloorplanOptions result;
  result.length_tolerance = 0.15;
  return result;
}

TEST(DominantFloorplans, ThreeStoreysUnderNoiseAreThreeTypes) {
  const auto slices = slicesOf({{{kL}, 12}, {{kTower}, 9}, {{kTop}, 7}}, 1);
  const DominantFloorplans found = selectDominantFloorplans(slices, options());
  EXPECT_EQ(found.num_types, 3);
  EXPECT_EQ(found.types, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(found.blocks.size(), 3U);
  const std::vector<Corners> truth = {kL, kTower, kTop};
  const std::vector<double> heights = {0.0, 12.0, 21.0, 28.0};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_DOUBLE_EQ(found.blocks[b].z_min, heights[b]);
    EXPECT_DOUBLE_EQ(found.blocks[b].z_max, heights[b + 1]);
    ASSERT_EQ(found.blocks[b].plan.components.size(), 1U);
    EXPECT_TRUE(sameCorners(found.blocks[b].plan.components[0].outer, truth[b], 0.06));
  }
  for (std::size_t i = 0; i < slices.size(); ++i) {
    EXPECT_EQ(found.slice_types[i], i < 12 ? 0 : i < 21 ? 1 : 2);
  }
  EXPECT_TRUE(found.labeling.optimal);
  EXPECT_EQ(found.labeling.labels.size(), slices.size());
}

TEST(DominantFloorplans, SpoiltSlicesTakeTheTypeOfTheirNeighbours) {
  auto slices = slicesOf({{{kL}, 10}, {{kTower}, 10}}, 2);
  // One lacks its wing, another has a hole in its wall, a third is of the wrong kind altogether.
  slices[4].plan.components[0].outer = ringOf(box(0, 0, 10, 20));
  slices[7].plan.components[0].outer = ringOf(
      {{0, 0}, {20, 0}, {20, 4}, {17, 4}, {17, 6}, {20, 6}, {20, 10}, {10, 10}, {10, 20}, {0, 20}});
  slices[15].plan.components[0].outer = ringOf({{1, 2}, {7, 3}, {9, 12}});
  const DominantFloorplans found = selectDominantFloorplans(slices, options());
  EXPECT_EQ(found.num_types, 2);
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_GE(found.num_candidates, 4);
  for (std::size_t i = 0; i < slices.size(); ++i) EXPECT_EQ(found.slice_types[i], i < 10 ? 0 : 1);
}

// A block with a notch in its long wall, at a place and of a depth of its own.
Corners notched(double width, std::mt19937& random) {
  const double y = std::uniform_real_distribution<double>(2.0, 15.0)(random);
  const double x = width - std::uniform_real_distribution<double>(1.0, 4.0)(random);
  return {{0, 0}, {width, 0}, {width, y}, {x, y}, {x, y + 3}, {width, y + 3}, {width, 20}, {0, 20}};
}

TEST(DominantFloorplans, OfManyDifferentSlicesFewStandForAll) {
  constexpr int kStorey = 60;
  auto slices = slicesOf({{{box(0, 0, 30, 20)}, kStorey}, {{box(0, 0, 15, 20)}, kStorey}}, 8);
  std::mt19937 random(9);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (i % 3 == 0) continue;
    slices[i].plan = noisyPlan({notched(i < kStorey ? 30.0 : 15.0, random)}, 0.0, random);
  }
  const DominantFloorplans found = selectDominantFloorplans(slices, options());
  EXPECT_EQ(found.num_types, 2);
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_DOUBLE_EQ(found.blocks[0].z_max, kStorey);
  EXPECT_EQ(found.blocks[0].plan.components[0].outer.size(), 4U);
  EXPECT_EQ(found.blocks[1].plan.components[0].outer.size(), 4U);
  EXPECT_GT(found.num_candidates, 2);
  EXPECT_LE(found.num_candidates, 66);
}

TEST(DominantFloorplans, ATypeThatComesBackIsOneType) {
  const DominantFloorplans found =
      selectDominantFloorplans(slicesOf({{{kL}, 8}, {{kTower}, 8}, {{kL}, 8}}, 3), options());
  EXPECT_EQ(found.num_types, 2);
  EXPECT_EQ(found.types, (std::vector<int>{0, 1, 0}));
  ASSERT_EQ(found.blocks.size(), 3U);
  const FloorplanRing& first = found.blocks[0].plan.components[0].outer;
  const FloorplanRing& third = found.blocks[2].plan.components[0].outer;
  EXPECT_EQ(first.vertices, third.vertices);
}

TEST(DominantFloorplans, WallsThatGoOnKeepTheirIdAndAllEdgesHaveOne) {
  const DominantFloorplans found =
      selectDominantFloorplans(slicesOf({{{kL}, 8}, {{kTower}, 8}}, 4), options());
  ASSERT_EQ(found.blocks.size(), 2U);
  const auto wallAt = [&](std::size_t block, const Eigen::Vector2d& from) {
    const FloorplanRing& ring = found.blocks[block].plan.components[0].outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if ((ring.vertices[i] - from).norm() < 0.2) return ring.edges[i].wall;
    }
    return -2;
  };
  std::set<int> ids;
  for (const FloorplanLayer& block : found.blocks) {
    for (const FloorplanEdge& edge : block.plan.components[0].outer.edges) {
      EXPECT_GE(edge.wall, 0);
      ids.insert(edge.wall);
    }
  }
  // The tower's four walls are all walls of the L, its right one that over (10, 10).
  EXPECT_EQ(ids.size(), 6U);
  EXPECT_EQ(wallAt(0, {0, 0}), wallAt(1, {0, 0}));
  EXPECT_EQ(wallAt(0, {0, 20}), wallAt(1, {0, 20}));
  EXPECT_EQ(wallAt(0, {10, 10}), wallAt(1, {10, 0}));
  EXPECT_EQ(wallAt(0, {10, 20}), wallAt(1, {10, 20}));
}

TEST(DominantFloorplans, SkippedSlicesAreSharedHalfAndHalf) {
  auto slices = slicesOf({{{kL}, 10}, {{kTower}, 10}}, 5);
  for (const std::size_t i : {0U, 4U, 8U, 9U, 10U, 11U, 19U}) slices[i].plan = {};
  const DominantFloorplans found = selectDominantFloorplans(slices, options());
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_DOUBLE_EQ(found.blocks[0].z_min, 1.0);   // the foot was not seen
  EXPECT_DOUBLE_EQ(found.blocks[0].z_max, 10.0);  // 8 to 12: half each
  EXPECT_DOUBLE_EQ(found.blocks[1].z_min, 10.0);
  EXPECT_DOUBLE_EQ(found.blocks[1].z_max, 19.0);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    EXPECT_EQ(found.slice_types[i], slices[i].plan.empty() ? -1 : i < 10 ? 0 : 1);
  }
}

TEST(DominantFloorplans, SeveralComponentsThatGrowTogether) {
  const Corners left = box(0, 0, 10, 10);
  const Corners right = box(16, 0, 26, 10);
  const Corners both = box(0, 0, 26, 10);
  const DominantFloorplans found =
      selectDominantFloorplans(slicesOf({{{left, right}, 9}, {{both}, 9}}, 6), options());
  EXPECT_EQ(found.num_types, 2);
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_EQ(found.blocks[0].plan.components.size(), 2U);
  EXPECT_EQ(found.blocks[1].plan.components.size(), 1U);
}

TEST(DominantFloorplans, ThePapersWayFindsTheClearCaseToo) {
  DominantFloorplanOptions paper = options();
  paper.exact = false;
  paper.encoding = FloorplanGrammar::Encoding::Turns;
  const auto slices = slicesOf({{{kL}, 12}, {{kTower}, 9}, {{kTop}, 7}}, 1);
  EXPECT_EQ(selectDominantFloorplans(slices, paper).num_types, 3);
  paper.encoding = FloorplanGrammar::Encoding::Walls;
  const DominantFloorplans expanded = selectDominantFloorplans(slices, paper);
  const DominantFloorplans exact = selectDominantFloorplans(slices, options());
  EXPECT_GE(expanded.labeling.energy, exact.labeling.energy - 1e-9);
}

TEST(DominantFloorplans, NoMoreTypesThanAllowed) {
  const auto slices = slicesOf({{{kL}, 12}, {{kTower}, 9}, {{kTop}, 7}}, 1);
  for (const bool exact : {true, false}) {
    DominantFloorplanOptions limited = options();
    limited.exact = exact;
    for (limited.max_types = 1; limited.max_types <= 4; ++limited.max_types) {
      const DominantFloorplans found = selectDominantFloorplans(slices, limited);
      EXPECT_EQ(found.num_types, std::min(static_cast<int>(limited.max_types), 3));
      EXPECT_TRUE(found.labeling.optimal || !exact);
    }
  }
}

TEST(DominantFloorplans, TheTradeOffIsListedUpToTheTypesThatThereAre) {
  const auto slices = slicesOf({{{kL}, 12}, {{kTower}, 9}, {{kTop}, 7}}, 1);
  const DominantFloorplans found = selectDominantFloorplans(slices, options());
  ASSERT_EQ(found.trade_off.size(), 3U);
  // L and tower share 4 walls, L and top 3 of 6, tower and top 3 of 4: NEdist 1/3, 1/2, 1/4.
  // Changes cost 0.1 x 3 each. One type for all, the L: 9/3 + 7/2, the tower: 12/3 + 7/4. Two:
  // the L and the tower, which stands for the top: 7/4 and a change. Three: two changes.
  EXPECT_NEAR(found.trade_off[0].labeling.energy, 12.0 / 3.0 + 7.0 / 4.0, 1e-9);
  EXPECT_NEAR(found.trade_off[1].labeling.energy, 7.0 / 4.0 + 0.3, 1e-9);
  EXPECT_NEAR(found.trade_off[2].labeling.energy, 0.6, 1e-9);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(found.trade_off[k].num_labels, k + 1);
}

TEST(DominantFloorplans, NoFloorplansGiveNoBlocks) {
  EXPECT_TRUE(selectDominantFloorplans({}, options()).blocks.empty());
  const DominantFloorplans found =
      selectDominantFloorplans(std::vector<FloorplanLayer>{{0, 1, {}}, {1, 2, {}}}, options());
  EXPECT_TRUE(found.blocks.empty());
  EXPECT_EQ(found.slice_types, (std::vector<int>{-1, -1}));
  EXPECT_EQ(found.num_types, 0);
}

TEST(DominantFloorplans, ABadToleranceGivesNoBlocks) {
  DominantFloorplanOptions bad = options();
  bad.length_tolerance = 0.0;
  EXPECT_TRUE(selectDominantFloorplans(slicesOf({{{kL}, 4}}, 7), bad).blocks.empty());
}

}  // namespace
