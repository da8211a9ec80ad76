// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/short_edges.h>

#include "ring_fits.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kLeast = 0.3;

// What is left of a ring whose lines are those of its edges, but of the one without a wall.
FloorplanRing simplified(const Corners& corners, std::size_t without_wall = 1000) {
  std::vector<FloorplanLayer> layers = layerOf(corners);
  std::vector<FloorplanEdge>& edges = layers.front().plan.components.front().outer.edges;
  if (without_wall < edges.size()) edges[without_wall].wall = -1;
  const std::vector<double> where_they_are(corners.size(), 0.0);
  detail::dropShortEdges(layers, fitsOf(corners, where_they_are), kLeast);
  return ringOf(layers);
}

// A square whose corner is cut off, by edge 2.
Corners chamfered(double cut) {
  return {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0 - cut}, {10.0 - cut, 10.0}, {0.0, 10.0}};
}

// A square whose upper side has a step, edge 3.
Corners stepped(double step) {
  return {{0.0, 0.0},  {10.0, 0.0},        {10.0, 10.0},
          {4.0, 10.0}, {4.0, 10.0 + step}, {0.0, 10.0 + step}};
}

TEST(DropShortEdges, NeighboursOfAShortEdgeMeetWhereTheirLinesDo) {
  const FloorplanRing ring = simplified(chamfered(0.2));
  expectCorners(ring, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}});
  EXPECT_EQ(idsOf(ring), (std::vector<int>{0, 1, 3, 4}));
}

TEST(DropShortEdges, LongerEdgesStay) {
  expectCorners(simplified(chamfered(0.25)), chamfered(0.25));  // 0.35 long
  expectCorners(simplified(stepped(0.35)), stepped(0.35));
}

TEST(DropShortEdges, OfNoWallALongerOneGoesWhereNothingMovesFar) {
  const FloorplanRing ring = simplified(chamfered(0.4), 2);  // the corner is 0.28 off
  expectCorners(ring, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}});
  EXPECT_EQ(idsOf(ring), (std::vector<int>{0, 1, 3, 4}));
  expectCorners(simplified(chamfered(0.45), 2), chamfered(0.45));
}

TEST(DropShortEdges, AWallWithAStepIsOneWallInThePlaneOfItsLongerPart) {
  for (const double step : {0.2, 0.001, -0.2}) {
    const FloorplanRing ring = simplified(stepped(step));
    expectCorners(ring, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}});
    EXPECT_EQ(idsOf(ring), (std::vector<int>{0, 1, 2, 5})) << step;
  }
}

TEST(DropShortEdges, OneAfterTheOtherGoes) {
  const FloorplanRing ring =
      simplified({{0.0, 0.0}, {10.0, 0.0}, {10.0, 9.8}, {9.95, 9.9}, {9.8, 10.0}, {0.0, 10.0}});
  expectCorners(ring, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}});
}

TEST(DropShortEdges, TheEndOfAWedgeStaysWhereItsSidesMeetFarAway) {
  const Corners wedge = {{0.0, 0.0}, {9.0, 0.0}, {9.0, 0.2}, {0.0, 2.0}};  // they meet at x = 10
  expectCorners(simplified(wedge), wedge);
}

TEST(DropShortEdges, ThreeEdgesStay) {
  const Corners small = {{0.0, 0.0}, {0.2, 0.0}, {0.1, 0.2}};
  expectCorners(simplified(small), small);
}

}  // namespace
