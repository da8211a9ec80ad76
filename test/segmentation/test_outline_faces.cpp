// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/outline_faces.h>

#include "cell_blocks.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::BlockOutline;
using detail::CellTerms;
using detail::countFaces;
using detail::countFloating;
using detail::OutlineRun;
using detail::runsOf;

Shape either(const Shape& a, const Shape& b) {
  return [=](const Eigen::Vector2d& p) { return a(p) || b(p); };
}

Shape without(const Shape& a, const Shape& b) {
  return [=](const Eigen::Vector2d& p) { return a(p) && !b(p); };
}

const Shape kNothing = [](const Eigen::Vector2d&) { return false; };

// The lines cross all shapes: edges of an outline are many stretches, and yet one face.
LineArrangement finePlan() {
  return arrangeLines(gridLines({1, 3, 5, 7, 9}, {1, 3, 5, 7, 9}), {0, 0}, {10, 10}, 1e-9);
}

CellTerms blankTerms(const LineArrangement& plan) {
  CellTerms terms;
  for (const PlanEdge& edge : plan.edges) terms.area.push_back(edge.length());
  terms.signed_area.assign(plan.edges.size(), 0.0);
  terms.unary.assign(plan.cells.size(), 0.0);
  return terms;
}

// What a measure says of the stack of these plans, bottom to top.
template <typename Measure>
auto measured(const std::vector<Shape>& shapes, Measure measure) {
  const LineArrangement plan = finePlan();
  std::vector<std::vector<char>> insides;
  std::vector<std::vector<OutlineRun>> runs;
  for (const Shape& shape : shapes) {
    insides.push_back(cellsOf(plan, shape));
    runs.push_back(runsOf(plan, blankTerms(plan), insides.back()));
  }
  std::vector<BlockOutline> blocks;
  for (std::size_t b = 0; b < shapes.size(); ++b) blocks.push_back({&insides[b], &runs[b]});
  return measure(plan, blocks);
}

// Faces of the solid.
std::size_t facesOf(const std::vector<Shape>& shapes) { return measured(shapes, countFaces); }

std::size_t floatingOf(const std::vector<Shape>& shapes) {
  return measured(shapes, [](const LineArrangement& plan, const std::vector<BlockOutline>& blocks) {
    return countFloating(plan, blocks);
  });
}

// What is added to the faces.
double surchargeOf(const std::vector<Shape>& shapes) {
  return measured(shapes, detail::complexityOf) - static_cast<double>(facesOf(shapes));
}

const Shape kBox = rectangle(1, 1, 9, 9);

TEST(OutlineFaces, APrismHasOneFaceAnEdgeAndTwoCaps) {
  EXPECT_EQ(facesOf({}), 0U);
  EXPECT_EQ(facesOf({kNothing}), 0U);
  EXPECT_EQ(facesOf({kBox}), 4U + 2U);
  EXPECT_EQ(facesOf({without(kBox, rectangle(5, 5, 9, 9))}), 6U + 2U);  // L
  EXPECT_EQ(facesOf({without(kBox, rectangle(3, 5, 7, 9))}),
            8U + 2U);  // U: of two walls on one line
  EXPECT_EQ(facesOf({without(kBox, rectangle(3, 3, 7, 7))}), 8U + 2U);  // courtyard
}

TEST(OutlineFaces, PartsOnTheSameLinesHaveFacesOfTheirOwn) {
  EXPECT_EQ(facesOf({either(rectangle(1, 1, 3, 9), rectangle(7, 1, 9, 9))}), 2U * 6U);
  // Two parts that touch in an edge of the solid: on each line one wall faces the other way.
  EXPECT_EQ(facesOf({either(rectangle(1, 1, 5, 5), rectangle(5, 5, 9, 9))}), 2U * 6U);
}

TEST(OutlineFaces, WallsThatGoOnAreOneAndTerracesCount) {
  EXPECT_EQ(facesOf({kBox, kBox, kBox}), 6U);
  // Half of it goes on: an L upright, six sides and two ends.
  EXPECT_EQ(facesOf({kBox, rectangle(1, 1, 5, 9)}), 6U + 2U);
  EXPECT_EQ(facesOf({rectangle(1, 1, 5, 9), kBox}), 6U + 2U);
  // Set back all around: four walls more, the terrace a ring.
  EXPECT_EQ(facesOf({kBox, rectangle(3, 3, 7, 7)}), 4U + 4U + 3U);
  // Set back from two opposite sides: terraces apart, and two walls that go on.
  EXPECT_EQ(facesOf({kBox, rectangle(3, 1, 7, 9)}), 4U + 2U + 2U + 2U);
  // A stair of three: as many sides as a staircase has, 8, and two ends.
  EXPECT_EQ(facesOf({kBox, rectangle(1, 1, 7, 9), rectangle(1, 1, 3, 9)}), 8U + 2U);
  // Shifted along one direction: all four walls are others but those along it.
  EXPECT_EQ(facesOf({rectangle(1, 1, 7, 9), rectangle(3, 1, 9, 9)}), 2U + 4U + 4U);
}

TEST(OutlineFaces, TowersAndLegsShareTheWallsOfTheBodyBetween) {
  // A U upright, and the same upside down: eight sides and two ends.
  const Shape two = either(rectangle(1, 1, 3, 9), rectangle(7, 1, 9, 9));
  EXPECT_EQ(facesOf({kBox, two}), 8U + 2U);
  EXPECT_EQ(facesOf({two, kBox}), 8U + 2U);
  // An H: twelve sides and two ends. A frame: four sides, four of its hole, two ends.
  EXPECT_EQ(facesOf({two, kBox, two}), 12U + 2U);
  EXPECT_EQ(facesOf({kBox, two, kBox}), 4U + 4U + 2U);
}

TEST(OutlineFaces, AWallThatTurnsToTheOtherSideOfItsLineIsAnother) {
  // Below on one side of the line, above on the other: no wall goes on but the two across, which
  // touch in an edge of the solid only and do not go on either.
  EXPECT_EQ(facesOf({rectangle(1, 1, 5, 9), rectangle(5, 1, 9, 9)}), 2U * 6U);
}

TEST(OutlineFaces, PartsThatRestOnNothingFloat) {
  const Shape corner = rectangle(1, 1, 3, 3);
  const Shape opposite = rectangle(7, 7, 9, 9);
  const Shape both = either(corner, opposite);
  EXPECT_EQ(floatingOf({}), 0U);
  EXPECT_EQ(floatingOf({both}), 0U);  // on the ground
  EXPECT_EQ(floatingOf({kBox, both, corner}), 0U);
  EXPECT_EQ(floatingOf({corner, kBox}), 0U);  // an overhang rests on a part of itself
  EXPECT_EQ(floatingOf({corner, both}), 1U);
  EXPECT_EQ(floatingOf({corner, opposite}), 1U);
  EXPECT_EQ(floatingOf({kNothing, both}), 2U);
  EXPECT_EQ(floatingOf({corner, both, both}), 1U);  // what stands on it does not float
  EXPECT_EQ(floatingOf({both, kNothing, both}), 2U);
  // Beside each other and corner to corner is not upon each other.
  EXPECT_EQ(floatingOf({rectangle(1, 1, 5, 9), rectangle(5, 1, 9, 9)}), 1U);
  EXPECT_EQ(floatingOf({rectangle(1, 1, 5, 5), rectangle(5, 5, 9, 9)}), 1U);
  // In a courtyard, and on what is around it.
  const Shape court = without(kBox, rectangle(3, 3, 7, 7));
  EXPECT_EQ(floatingOf({court, rectangle(3, 3, 5, 5)}), 1U);
  EXPECT_EQ(floatingOf({court, rectangle(1, 1, 5, 5)}), 0U);
}

TEST(OutlineFaces, EachPartThatFloatsCostsTheSameMore) {
  const Shape corner = rectangle(1, 1, 3, 3);
  const Shape opposite = rectangle(7, 7, 9, 9);
  EXPECT_EQ(surchargeOf({}), 0.0);
  EXPECT_EQ(surchargeOf({kBox, either(corner, opposite)}), 0.0);
  const double one = surchargeOf({corner, opposite});
  EXPECT_GT(one, 0.0);
  EXPECT_EQ(surchargeOf({corner, either(corner, opposite)}), one);
  EXPECT_EQ(surchargeOf({kNothing, either(corner, opposite)}), 2.0 * one);
  EXPECT_EQ(surchargeOf({corner, opposite, corner}), 2.0 * one);
}

TEST(OutlineRuns, AreByLineAndWithTheAreaSeenFromTheirSide) {
  const LineArrangement plan = finePlan();
  CellTerms terms = blankTerms(plan);
  const std::vector<char> inside = cellsOf(plan, kBox);
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    // All face the ends of the axes: the walls at 9 do so from outside, those at 1 from inside.
    terms.signed_area[e] = 0.25 * plan.edges[e].length();
  }
  const std::vector<OutlineRun> runs = runsOf(plan, terms, inside);
  ASSERT_EQ(runs.size(), 4U);
  for (const OutlineRun& run : runs) {
    const PlanEdge& first = plan.edges[run.first];
    const PlanEdge& last = plan.edges[run.last];
    EXPECT_EQ(first.line, last.line);
    EXPECT_NEAR(first.s_min, std::min(first.s_min, last.s_min), 0.0);
    EXPECT_NEAR(last.s_max - first.s_min, 8.0, 1e-9);
    const bool far = plan.lines[static_cast<std::size_t>(first.line)].offset > 5.0;
    EXPECT_EQ(run.side, far ? 1 : -1);
    EXPECT_NEAR(run.seen, far ? 0.25 * 8.0 : 0.0, 1e-9);
  }
  for (std::size_t r = 0; r + 1 < runs.size(); ++r) EXPECT_LT(runs[r].last, runs[r + 1].first);
}

}  // namespace
