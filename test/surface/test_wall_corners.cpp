// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/detail/wall_corners.h>

#include <cmath>

#include "ring_fits.h"

namespace {

using namespace storey;
using namespace storey::test;

const Corners kSquare = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
// The square, its corner at (10, 10) cut by the line x + y = 20 - cut, which is edge 2.
Corners chamfered(double cut) {
  return {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0 - cut}, {10.0 - cut, 10.0}, {0.0, 10.0}};
}

TEST(MoveCorners, TakesThemToTheIntersectionsOfTheLines) {
  std::vector<FloorplanLayer> layers = layerOf(kSquare);
  detail::moveCorners(layers, fitsOf(kSquare, {1.0, 2.0, 3.0, 4.0}));
  expectCorners(ringOf(layers), {{-4.0, -1.0}, {12.0, -1.0}, {12.0, 13.0}, {-4.0, 13.0}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, 2, 3}));
}

TEST(MoveCorners, KeepsAShortEdgeThatStaysTheRightWayRound) {
  // The line x + y = 20 - 0.5 moved to x + y = 20 - 0.1.
  const Corners ring = chamfered(0.5);
  std::vector<FloorplanLayer> layers = layerOf(ring);
  detail::moveCorners(layers, fitsOf(ring, {0.0, 0.0, 0.4 * M_SQRT1_2, 0.0, 0.0}));
  expectCorners(ringOf(layers), chamfered(0.1));
}

TEST(MoveCorners, DropsAShortEdgeThatWouldTurnAround) {
  // The line of the cut moved past the corner of the square.
  const Corners ring = chamfered(0.5);
  std::vector<FloorplanLayer> layers = layerOf(ring);
  detail::moveCorners(layers, fitsOf(ring, {0.0, 0.0, 0.6 * M_SQRT1_2, 0.0, 0.0}));
  expectCorners(ringOf(layers), kSquare);
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, 3, 4}));
}

TEST(MoveCorners, DropsTheLastEdgeOfARingAsAnyOther) {
  const Corners ring = {{9.5, 10.0}, {0.0, 10.0}, {0.0, 0.0}, {10.0, 0.0}, {10.0, 9.5}};
  std::vector<FloorplanLayer> layers = layerOf(ring);
  detail::moveCorners(layers, fitsOf(ring, {0.0, 0.0, 0.0, 0.0, 0.6 * M_SQRT1_2}));
  expectCorners(ringOf(layers), {{10.0, 10.0}, {0.0, 10.0}, {0.0, 0.0}, {10.0, 0.0}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, 2, 3}));
}

TEST(MoveCorners, DropsAShortEdgeThatTurnsALongerOneAround) {
  // The short edge from (10, 9) to (10.02, 9.2), moved in by 0.1, would cross x = 10.02 at a height
  // of 10.2, beyond the top of the edge on that line. Without it that edge is parallel to the
  // longer one on x = 10, which the corner is put on.
  const Corners ring = {{0.0, 0.0},   {10.0, 0.0},   {10.0, 9.0},
                        {10.02, 9.2}, {10.02, 10.0}, {0.0, 10.0}};
  std::vector<FloorplanLayer> layers = layerOf(ring);
  detail::moveCorners(layers, fitsOf(ring, {0.0, 0.0, -0.1, 0.0, 0.0, 0.0}));
  expectCorners(ringOf(layers), {{0.0, 0.0}, {10.0, 0.0}, {10.0, 9.2}, {10.02, 10.0}, {0.0, 10.0}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, -1, 4, 5}));
}

TEST(MoveCorners, EdgesOfOneWallThatFollowEachOtherAreOne) {
  const Corners ring = {{10.0, 10.2}, {4.0, 10.1}, {0.0, 10.0}, {0.0, 0.0}, {10.0, 0.0}};
  std::vector<FloorplanLayer> layers = layerOf(ring);
  std::map<int, WallFit> fits = fitsOf(ring, {0.0, 0.0, 0.0, 0.0, 0.0});
  fits[0].normal = {0.0, 1.0};
  fits[0].offset = 10.1;
  layers.front().plan.components.front().outer.edges[1].wall = 0;
  detail::moveCorners(layers, fits);
  expectCorners(ringOf(layers), {{10.0, 10.1}, {0.0, 10.1}, {0.0, 0.0}, {10.0, 0.0}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 2, 3, 4}));
}

TEST(MoveCorners, LeavesRingsAloneWhoseLongEdgesWouldTurnAround) {
  // A side of the square moved past the opposite one.
  std::vector<FloorplanLayer> layers = layerOf(kSquare);
  detail::moveCorners(layers, fitsOf(kSquare, {-11.0, 0.0, 0.0, 0.0}));
  expectCorners(ringOf(layers), kSquare);
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{-1, -1, -1, -1}));
}

TEST(MoveCorners, ReleasesTheShorterOfParallelNeighbours) {
  // Without the step its neighbours are parallel and meet nowhere. The longer one, then from (10,
  // 10) to (5, 9.9), keeps its line y = 9.8.
  const Corners step = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {5.0, 10.0}, {5.0, 9.9}, {0.0, 9.9}};
  std::vector<FloorplanLayer> layers = layerOf(step);
  detail::moveCorners(layers, fitsOf(step, {0.0, 0.0, -0.2, 0.0, 0.0, 0.0}));
  expectCorners(ringOf(layers), {{0.0, 0.0}, {10.0, 0.0}, {10.0, 9.8}, {5.0, 9.8}, {0.0, 9.9}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, 2, -1, 5}));
}

// The square, its upper side bent at its middle by a hundredth.
const Corners kBent = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {5.0, 10.05}, {0.0, 10.05}};

TEST(MoveCorners, TakesTheCornerOfABendToTheIntersectionNearby) {
  // y = 10.05 moved to 10.06 meets the other half, which falls by 0.01 x from (5, 10.05), at x = 4.
  std::vector<FloorplanLayer> layers = layerOf(kBent);
  detail::moveCorners(layers, fitsOf(kBent, {0.0, 0.0, 0.0, 0.01, 0.0}));
  expectCorners(ringOf(layers),
                {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {4.0, 10.06}, {0.0, 10.06}});
  EXPECT_EQ(idsOf(ringOf(layers)), (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(MoveCorners, KeepsTheCornerOfABendWhoseLinesCrossFarAway) {
  // y = 10.05 moved to 10.15 would meet the other half at x = -5.
  std::vector<FloorplanLayer> layers = layerOf(kBent);
  detail::moveCorners(layers, fitsOf(kBent, {0.0, 0.0, 0.0, 0.1, 0.0}));
  const FloorplanRing& ring = ringOf(layers);
  EXPECT_EQ(idsOf(ring), (std::vector<int>{0, 1, 2, -1, 4}));
  ASSERT_EQ(ring.size(), kBent.size());
  EXPECT_LT((ring.vertices[3] - kBent[3]).norm(), 1e-12);  // it lies on the longer edge's line
  EXPECT_LT((ring.vertices[4] - Eigen::Vector2d(0.0, 10.15)).norm(), 1e-12);
}

}  // namespace
