// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/weak_parts.h>

#include "plans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::dropWeakParts;

constexpr double kMargin = 1e-6;  // of a share, to either side of it

// Lines along all the boxes below.
LineArrangement finePlan() {
  return arrangeLines(gridLines({0, 2, 4, 8, 10, 14, 16, 18}, {0, 2, 4, 8, 10}), {-2, -2}, {22, 14},
                      1e-9);
}

FloorplanComponent part(const Corners& corners) { return {ringOf(corners), {}}; }

FloorplanLayer layerOf(double z_min, double z_max, std::vector<FloorplanComponent> components) {
  return {z_min, z_max, {std::move(components)}};
}

std::vector<FloorplanLayer> dropped(std::vector<FloorplanLayer> layers, double keep) {
  dropWeakParts(finePlan(), keep, layers);
  return layers;
}

const FloorplanComponent kMain = part(box(0, 0, 10, 10));
const FloorplanComponent kNeighbour = part(box(14, 0, 18, 4));
const FloorplanComponent kTower = part(box(2, 2, 4, 4));

bool isSame(const FloorplanComponent& a, const FloorplanComponent& b) {
  return a.outer.vertices == b.outer.vertices && a.holes.size() == b.holes.size();
}

TEST(WeakParts, ANeighbourNeedsItsShareOfTheBestPart) {
  const std::vector<FloorplanLayer> layers = {layerOf(0, 6, {kNeighbour, kMain})};
  const double share = 16.0 / 40.0;  // of the perimeter, at one height
  ASSERT_EQ(dropped(layers, share - kMargin)[0].plan.components.size(), 2U);
  const std::vector<FloorplanLayer> after = dropped(layers, share + kMargin);
  ASSERT_EQ(after.size(), 1U);
  ASSERT_EQ(after[0].plan.components.size(), 1U);
  EXPECT_TRUE(isSame(after[0].plan.components[0], kMain));
  EXPECT_EQ(after[0].z_max, 6.0);
}

TEST(WeakParts, SupportIsOfAllLayers) {
  // The main part goes on for as much again.
  const std::vector<FloorplanLayer> layers = {layerOf(0, 6, {kMain, kNeighbour}),
                                              layerOf(6, 12, {kMain})};
  const double share = 16.0 / 80.0;
  EXPECT_EQ(dropped(layers, share - kMargin)[0].plan.components.size(), 2U);
  EXPECT_EQ(dropped(layers, share + kMargin)[0].plan.components.size(), 1U);
}

TEST(WeakParts, ATowerOverTheMainPartStaysHoweverLittleItShows) {
  FloorplanComponent unseen = kTower;
  for (FloorplanEdge& edge : unseen.outer.edges) edge.hypothetical = true;
  const std::vector<FloorplanLayer> layers = {
      layerOf(0, 6, {kMain}), layerOf(6, 6.5, {kTower, kNeighbour}), layerOf(6.5, 7, {unseen})};
  const std::vector<FloorplanLayer> after = dropped(layers, 1.0);
  ASSERT_EQ(after.size(), 3U);
  ASSERT_EQ(after[1].plan.components.size(), 1U);  // what floats beside it goes
  EXPECT_TRUE(isSame(after[1].plan.components[0], kTower));
  EXPECT_TRUE(isSame(after[2].plan.components[0], kTower));
}

TEST(WeakParts, APartAboveJoinsTwoBelow) {
  const FloorplanComponent left = part(box(0, 0, 4, 10));
  const FloorplanComponent right = part(box(8, 0, 18, 10));
  const FloorplanComponent bridge = part(box(0, 0, 18, 10));
  EXPECT_EQ(dropped({layerOf(0, 6, {left, right})}, 1.0)[0].plan.components.size(), 1U);
  EXPECT_EQ(dropped({layerOf(0, 6, {left, right}), layerOf(6, 8, {bridge})}, 1.0)[0]
                .plan.components.size(),
            2U);
  // A gap of a layer between them joins nothing.
  EXPECT_EQ(dropped({layerOf(0, 6, {left, right}), layerOf(6, 8, {right}), layerOf(8, 9, {bridge})},
                    1.0)[0]
                .plan.components.size(),
            1U);
}

TEST(WeakParts, HypotheticalWallsAreNoSupport) {
  // Both are alike but for three guessed walls of one: a quarter is left of its support.
  FloorplanComponent guessed = part(box(14, 0, 18, 4));
  for (std::size_t i = 0; i < 3; ++i) guessed.outer.edges[i].hypothetical = true;
  const std::vector<FloorplanLayer> layers = {layerOf(0, 6, {part(box(0, 0, 4, 4)), guessed})};
  EXPECT_EQ(dropped(layers, 0.25 - kMargin)[0].plan.components.size(), 2U);
  EXPECT_EQ(dropped(layers, 0.25 + kMargin)[0].plan.components.size(), 1U);
}

TEST(WeakParts, WallsOfCourtyardsAreSupport) {
  FloorplanComponent court = part(box(0, 0, 10, 10));
  court.holes.push_back(ringOf(clockwise(box(2, 2, 8, 8))));
  const std::vector<FloorplanLayer> layers = {layerOf(0, 6, {court, kNeighbour})};
  const double share = 16.0 / (40.0 + 24.0);
  EXPECT_EQ(dropped(layers, share - kMargin)[0].plan.components.size(), 2U);
  EXPECT_EQ(dropped(layers, share + kMargin)[0].plan.components.size(), 1U);
}

TEST(WeakParts, APartInACourtyardIsNoPartOfWhatIsAround) {
  FloorplanComponent court = part(box(0, 0, 10, 10));
  court.holes.push_back(ringOf(clockwise(box(2, 2, 8, 8))));
  const std::vector<FloorplanLayer> layers = {layerOf(0, 6, {court}), layerOf(6, 7, {kTower})};
  EXPECT_EQ(dropped(layers, 0.5).size(), 1U);
}

TEST(WeakParts, LayersThatAreLeftEmptyGo) {
  const std::vector<FloorplanLayer> after = dropped(
      {layerOf(0, 1, {kNeighbour}), layerOf(1, 2, {kNeighbour, kMain}), layerOf(2, 6, {kMain})},
      0.5);
  ASSERT_EQ(after.size(), 2U);
  EXPECT_EQ(after[0].z_min, 1.0);
  EXPECT_EQ(after[1].z_max, 6.0);
  EXPECT_TRUE(dropped({}, 0.5).empty());
}

}  // namespace
