// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/segment_linking.h>

#include <random>

#include "floorplans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::assembleFloorplan;

// How often the ring runs around the point, by the angles that its edges subtend.
int windingByAngles(const FloorplanRing& ring, const Eigen::Vector2d& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring.vertices[i] - p;
    const Eigen::Vector2d b = ring.vertices[(i + 1) % ring.size()] - p;
    sum += std::atan2(crossOf(a, b), a.dot(b));
  }
  return static_cast<int>(std::lround(sum / (2.0 * M_PI)));
}

TEST(AssembleFloorplan, OfOneRingIsThatRing) {
  const Corners l = {{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}};
  FloorplanRing ring = ringOf(l);
  ring.edges[2] = {7, true};
  const Floorplan plan = assembleFloorplan({ring}, 1.0);
  ASSERT_EQ(plan.components.size(), 1U);
  expectValid(plan);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, l, 1e-12));
  EXPECT_DOUBLE_EQ(area(plan), 75.0);
  const FloorplanRing& outer = plan.components[0].outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const bool third = (outer.vertices[i] - l[2]).norm() < 1e-9;
    EXPECT_EQ(outer.edges[i].wall, third ? 7 : -1);
    EXPECT_EQ(outer.edges[i].hypothetical, third);
  }
}

TEST(AssembleFloorplan, ClockwiseRingsAreCourtyardsAndRingsInThemIslands) {
  const Floorplan plan = assembleFloorplan(
      {ringOf(box(4, 4, 6, 6)), ringOf(clockwise(box(2, 2, 8, 8))), ringOf(box(0, 0, 10, 10))},
      0.5);
  expectValid(plan);
  ASSERT_EQ(plan.components.size(), 2U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, box(0, 0, 10, 10), 1e-12));
  ASSERT_EQ(plan.components[0].holes.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].holes[0], clockwise(box(2, 2, 8, 8)), 1e-12));
  EXPECT_TRUE(sameCorners(plan.components[1].outer, box(4, 4, 6, 6), 1e-12));
  EXPECT_DOUBLE_EQ(area(plan), 100.0 - 36.0 + 4.0);
}

TEST(AssembleFloorplan, TheLobeThatRunsBackwardsIsOutside) {
  // An 8 whose lower lobe, with corners (0, 0), (4, 0), (2, 2), runs counter-clockwise and whose
  // smaller upper one clockwise.
  const Floorplan plan = assembleFloorplan({ringOf({{0, 0}, {4, 0}, {1, 3}, {3, 3}})}, 0.0);
  ASSERT_EQ(plan.components.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, {{0, 0}, {4, 0}, {2, 2}}, 1e-9));
  // Turned the other way round only the upper lobe is left.
  const Floorplan turned = assembleFloorplan({ringOf({{3, 3}, {1, 3}, {4, 0}, {0, 0}})}, 0.0);
  ASSERT_EQ(turned.components.size(), 1U);
  EXPECT_NEAR(area(turned), 1.0, 1e-9);
}

TEST(AssembleFloorplan, OverlapsAreUnitedWithoutCollinearVertices) {
  // Two boxes side by side share half a wall; the outline is that of 10 x 5.
  const Floorplan plan =
      assembleFloorplan({ringOf(box(0, 0, 5, 5)), ringOf(box(5, 0, 10, 5))}, 0.0);
  ASSERT_EQ(plan.components.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, box(0, 0, 10, 5), 1e-12));
  EXPECT_EQ(countHypothetical(plan.components[0].outer), 0U);
}

TEST(AssembleFloorplan, AClockwiseRingAloneEnclosesNothing) {
  EXPECT_TRUE(assembleFloorplan({ringOf(clockwise(box(0, 0, 5, 5)))}, 0.0).empty());
  EXPECT_TRUE(assembleFloorplan({}, 0.0).empty());
  EXPECT_TRUE(assembleFloorplan({ringOf({{0, 0}, {5, 0}, {9, 0}})}, 0.0).empty());
}

TEST(AssembleFloorplan, SmallComponentsAndCourtyardsAreDropped) {
  const std::vector<FloorplanRing> rings = {ringOf(box(0, 0, 10, 10)), ringOf(box(20, 0, 21, 1)),
                                            ringOf(clockwise(box(2, 2, 3, 3)))};
  const Floorplan all = assembleFloorplan(rings, 0.9);
  ASSERT_EQ(all.components.size(), 2U);
  EXPECT_EQ(all.components[0].holes.size(), 1U);
  const Floorplan large = assembleFloorplan(rings, 1.1);
  ASSERT_EQ(large.components.size(), 1U);
  EXPECT_TRUE(large.components[0].holes.empty());
}

TEST(AssembleFloorplan, IsTheRegionOfPositiveWindingOfRandomRings) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> whole(0, 8);  // touching, collinear and repeated corners
  std::uniform_real_distribution<double> real(0.0, 8.0);
  std::uniform_real_distribution<double> probe(-1.0, 9.0);
  for (int round = 0; round < 200; ++round) {
    std::vector<FloorplanRing> rings;
    for (int r = 0; r < 3; ++r) {
      Corners corners;
      for (int i = 0; i < 5; ++i) {
        corners.emplace_back(round % 2 == 0 ? Eigen::Vector2d(real(random), real(random))
                                            : Eigen::Vector2d(whole(random), whole(random)));
      }
      rings.push_back(ringOf(corners));
    }
    const Floorplan plan = assembleFloorplan(rings, 0.0);
    for (const FloorplanComponent& component : plan.components) {
      EXPECT_TRUE(isSimple(component.outer));
      EXPECT_GT(signedArea(component.outer), 0.0);
      for (const FloorplanRing& hole : component.holes) EXPECT_LT(signedArea(hole), 0.0);
    }
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d p(probe(random), probe(random));
      int winding = 0;
      for (const FloorplanRing& ring : rings) winding += windingByAngles(ring, p);
      EXPECT_EQ(contains(plan, p), winding > 0) << "round " << round << " at " << p.transpose();
    }
  }
}

TEST(AssembleFloorplan, IsTheSameFarAway) {
  const std::vector<FloorplanRing> here = {ringOf(box(0, 0, 10, 10)),
                                           ringOf(clockwise(box(4, 4, 12, 6)))};
  std::vector<FloorplanRing> there = here;
  const Eigen::Vector2d far(1e7, -3e6);
  for (FloorplanRing& ring : there) ring.vertices = moved(ring.vertices, 0.0, far);
  const Floorplan near_plan = assembleFloorplan(here, 0.5);
  const Floorplan far_plan = assembleFloorplan(there, 0.5);
  ASSERT_EQ(near_plan.components.size(), 1U);
  ASSERT_EQ(far_plan.components.size(), 1U);
  // Whole numbers: exact at both places.
  EXPECT_TRUE(sameCorners(far_plan.components[0].outer,
                          moved(near_plan.components[0].outer.vertices, 0.0, far), 0.0));
  EXPECT_DOUBLE_EQ(area(near_plan), 100.0 - 12.0);
}

}  // namespace
