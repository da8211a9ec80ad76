// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/cell_labels.h>

#include <algorithm>
#include <random>

#include "plans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::CellBlock;
using detail::outlineOf;

const Eigen::Vector2d kLow(0.0, 0.0);
const Eigen::Vector2d kHigh(20.0, 16.0);
constexpr double kTolerance = 1e-6;

// All edges seen, whichever side the outside is on.
CellBlock blockOf(const LineArrangement& plan, const std::vector<char>& inside) {
  CellBlock block;
  block.inside = inside;
  for (const PlanEdge& edge : plan.edges) {
    block.coverage.push_back(inside[static_cast<std::size_t>(edge.behind)] -
                             inside[static_cast<std::size_t>(edge.ahead)]);
  }
  return block;
}

CellBlock blockOfCellsAt(const LineArrangement& plan, const Corners& places) {
  std::vector<char> inside(plan.cells.size(), 0);
  for (const Eigen::Vector2d& p : places) inside[cellAt(plan, p)] = 1;
  return blockOf(plan, inside);
}

double areaInside(const LineArrangement& plan, const CellBlock& block) {
  double sum = 0.0;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    if (block.inside[c] != 0) sum += plan.cells[c].area;
  }
  return sum;
}

// Parts that are connected over edges; parts that touch in a corner are two.
std::size_t countParts(const LineArrangement& plan, const CellBlock& block) {
  std::vector<std::size_t> part(plan.cells.size());
  for (std::size_t c = 0; c < part.size(); ++c) part[c] = c;
  for (std::size_t round = 0; round < part.size(); ++round) {
    for (const PlanEdge& edge : plan.edges) {
      const auto a = static_cast<std::size_t>(edge.behind);
      const auto b = static_cast<std::size_t>(edge.ahead);
      if (block.inside[a] == 0 || block.inside[b] == 0) continue;
      part[a] = part[b] = std::min(part[a], part[b]);
    }
  }
  std::size_t count = 0;
  for (std::size_t c = 0; c < part.size(); ++c) count += block.inside[c] != 0 && part[c] == c;
  return count;
}

// Every edge lies on the line that it names, with the outside on the side that it says.
void expectWallsNamed(const LineArrangement& plan, const Floorplan& outline) {
  const auto expectRing = [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring.vertices[i];
      const Eigen::Vector2d& b = ring.vertices[(i + 1) % ring.size()];
      ASSERT_GE(ring.edges[i].wall, 0);
      const PlanLine& line = plan.lines.at(static_cast<std::size_t>(ring.edges[i].wall) / 2);
      EXPECT_NEAR(line.across(a), 0.0, 10.0 * kTolerance);
      EXPECT_NEAR(line.across(b), 0.0, 10.0 * kTolerance);
      // The building is on the left: behind the line when running along its tangent.
      EXPECT_EQ(ring.edges[i].wall % 2 == 0, line.tangent().dot(b - a) > 0.0);
    }
  };
  for (const FloorplanComponent& component : outline.components) {
    expectRing(component.outer);
    for (const FloorplanRing& hole : component.holes) expectRing(hole);
  }
}

LineArrangement gridPlan() {
  return arrangeLines(gridLines({2, 6, 9, 14, 18}, {2, 5, 9, 14}), kLow, kHigh, kTolerance);
}

TEST(OutlineOf, NothingInsideHasNoOutline) {
  const LineArrangement plan = gridPlan();
  EXPECT_TRUE(outlineOf(plan, blockOfCellsAt(plan, {}), kTolerance, 0.0, 0.0).empty());
}

TEST(OutlineOf, CellsInARowAreOneRectangle) {
  const LineArrangement plan = gridPlan();
  const Floorplan outline =
      outlineOf(plan, blockOfCellsAt(plan, {{4, 3}, {7, 3}, {12, 3}}), kTolerance, 0.0, 0.0);
  ASSERT_EQ(outline.components.size(), 1U);
  EXPECT_TRUE(sameCorners(outline.components[0].outer, box(2, 2, 14, 5), 1e-6));
  expectWallsNamed(plan, outline);
}

TEST(OutlineOf, ARingOfCellsHasACourtyard) {
  const LineArrangement plan = gridPlan();
  const Floorplan outline = outlineOf(
      plan,
      blockOfCellsAt(plan, {{4, 3}, {7, 3}, {12, 3}, {4, 7}, {12, 7}, {4, 12}, {7, 12}, {12, 12}}),
      kTolerance, 0.0, 0.0);
  ASSERT_EQ(outline.components.size(), 1U);
  expectValid(outline);
  EXPECT_TRUE(sameCorners(outline.components[0].outer, box(2, 2, 14, 14), 1e-6));
  ASSERT_EQ(outline.components[0].holes.size(), 1U);
  EXPECT_TRUE(sameCorners(outline.components[0].holes[0], clockwise(box(6, 5, 9, 9)), 1e-6));
  expectWallsNamed(plan, outline);
}

TEST(OutlineOf, PartsThatTouchAtACornerAreTwo) {
  const LineArrangement plan = gridPlan();
  for (const Corners& places : {Corners{{4, 3}, {7, 7}}, Corners{{7, 3}, {4, 7}}}) {
    const CellBlock block = blockOfCellsAt(plan, places);
    const Floorplan outline = outlineOf(plan, block, kTolerance, 0.0, 0.0);
    ASSERT_EQ(outline.components.size(), 2U);
    expectValid(outline);
    for (const FloorplanComponent& component : outline.components) {
      EXPECT_EQ(component.outer.size(), 4U);
      EXPECT_TRUE(component.holes.empty());
    }
    EXPECT_NEAR(area(outline), areaInside(plan, block), 1e-6);
    expectWallsNamed(plan, outline);
  }
}

TEST(OutlineOf, AnyCellsOfAnyPlanKeepAreaPartsAndWalls) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, M_PI);
  std::uniform_real_distribution<double> x(3.0, 17.0);
  std::uniform_real_distribution<double> y(3.0, 13.0);
  for (int round = 0; round < 100; ++round) {
    LineArrangement plan = gridPlan();
    if (round % 2 == 1) {
      PlanLines lines;
      for (int i = 0; i < 8; ++i)
        lines.push_back(lineThrough({x(random), y(random)}, angle(random)));
      plan = arrangeLines(lines, kLow, kHigh, kTolerance);
    }
    std::vector<char> inside(plan.cells.size(), 0);
    for (std::size_t c = 0; c < inside.size(); ++c) {
      inside[c] = plan.at_border[c] == 0 && random() % 2 == 0 ? 1 : 0;
    }
    const CellBlock block = blockOf(plan, inside);
    const Floorplan outline = outlineOf(plan, block, kTolerance, 0.0, 0.0);
    // The overlay rounds by 1e-9 of the extent, vertices are one within the tolerance.
    EXPECT_NEAR(area(outline), areaInside(plan, block), 100.0 * kTolerance) << "round " << round;
    EXPECT_EQ(outline.components.size(), countParts(plan, block)) << "round " << round;
    for (const FloorplanComponent& component : outline.components) {
      EXPECT_GT(signedArea(component.outer), 0.0);
      for (const FloorplanRing& hole : component.holes) EXPECT_LT(signedArea(hole), 0.0);
    }
    expectWallsNamed(plan, outline);
  }
}

TEST(OutlineOf, WallsSeenByLessThanAThirdAreHypothetical) {
  const LineArrangement plan = arrangeLines(gridLines({2, 10}, {2, 10}), kLow, kHigh, kTolerance);
  CellBlock block = blockOfCellsAt(plan, {{5, 5}});
  const double shares[] = {0.0, 0.2, 0.5, 1.0};
  std::size_t wall = 0;
  std::vector<bool> hypothetical(2 * plan.lines.size(), false);
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    if (block.coverage[e] == 0.0) continue;
    const double share = shares[wall++];
    const bool ahead = block.coverage[e] > 0.0;
    hypothetical[2 * static_cast<std::size_t>(plan.edges[e].line) + (ahead ? 0 : 1)] =
        share < 1.0 / 3.0;
    block.coverage[e] *= share;
  }
  ASSERT_EQ(wall, 4U);
  const Floorplan outline = outlineOf(plan, block, kTolerance, 0.0, 0.0);
  ASSERT_EQ(outline.components.size(), 1U);
  EXPECT_EQ(countHypothetical(outline.components[0].outer), 2U);
  for (const FloorplanEdge& edge : outline.components[0].outer.edges) {
    EXPECT_EQ(edge.hypothetical, hypothetical[static_cast<std::size_t>(edge.wall)]);
  }
}

TEST(OutlineOf, PartsAndCourtyardsBelowTheLeastAreaGo) {
  const LineArrangement plan =
      arrangeLines(gridLines({2, 6, 7, 12, 16, 17}, {2, 5, 6, 12}), kLow, kHigh, kTolerance);
  // A box with a courtyard of 1 x 1 in it, and a part of 1 x 1 beside it.
  const CellBlock block = blockOfCellsAt(
      plan, {{4, 3}, {6.5, 3}, {9, 3}, {4, 5.5}, {9, 5.5}, {4, 8}, {6.5, 8}, {9, 8}, {16.5, 5.5}});
  const Floorplan all = outlineOf(plan, block, kTolerance, 0.0, 0.5);
  ASSERT_EQ(all.components.size(), 2U);
  EXPECT_EQ(all.components[0].holes.size(), 1U);
  const Floorplan large = outlineOf(plan, block, kTolerance, 0.0, 1.5);
  ASSERT_EQ(large.components.size(), 1U);
  EXPECT_TRUE(large.components[0].holes.empty());
  EXPECT_TRUE(sameCorners(large.components[0].outer, box(2, 2, 12, 12), 1e-6));
}

TEST(OutlineOf, AShortEdgeWhoseNeighboursMeetNearbyGoes) {
  // The corner (12, 12) is cut by a line 0.1 off it.
  PlanLines lines = gridLines({2, 12}, {2, 12});
  lines.push_back(lineThrough({11.9, 12.0}, M_PI / 4.0));
  const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kTolerance);
  const CellBlock block = blockOfCellsAt(plan, {{7, 7}});
  const Floorplan exact = outlineOf(plan, block, kTolerance, 0.0, 0.0);
  ASSERT_EQ(exact.components.size(), 1U);
  EXPECT_EQ(exact.components[0].outer.size(), 5U);
  const Floorplan tidy = outlineOf(plan, block, kTolerance, 0.3, 0.0);
  ASSERT_EQ(tidy.components.size(), 1U);
  EXPECT_TRUE(sameCorners(tidy.components[0].outer, box(2, 2, 12, 12), 1e-6));
}

}  // namespace
