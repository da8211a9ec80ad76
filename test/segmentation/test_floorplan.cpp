// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/floorplan.h>

#include <cmath>
#include <random>

#include "floorplans.h"

namespace {

using namespace storey;
using namespace storey::test;

// An L of 10 x 10 without its upper right quarter, with a courtyard of 2 x 1, and a box of 3 x 3.
Floorplan lWithCourtyardAndBox(const Eigen::Vector2d& shift) {
  Floorplan plan;
  FloorplanComponent l;
  l.outer = ringOf(moved({{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}, 0.0, shift));
  l.holes.push_back(ringOf(moved(clockwise(box(1, 1, 3, 2)), 0.0, shift)));
  plan.components.push_back(l);
  plan.components.push_back({ringOf(moved(box(20, 0, 23, 3), 0.0, shift)), {}});
  return plan;
}

TEST(Floorplan, AreaPerimeterAndEdgesOfAnLWithACourtyardAndABox) {
  const Floorplan plan = lWithCourtyardAndBox({0.0, 0.0});
  EXPECT_DOUBLE_EQ(area(plan), 75.0 - 2.0 + 9.0);
  EXPECT_DOUBLE_EQ(perimeter(plan), 40.0 + 6.0 + 12.0);
  EXPECT_EQ(countEdges(plan), 6U + 4U + 4U);
}

TEST(Floorplan, SignedAreaFollowsTheSense) {
  EXPECT_DOUBLE_EQ(signedArea(ringOf(box(1, 1, 3, 4))), 6.0);
  EXPECT_DOUBLE_EQ(signedArea(ringOf(clockwise(box(1, 1, 3, 4)))), -6.0);
  // Regular 100-gon of radius 2: n/2 r^2 sin(2 pi / n).
  Corners circle;
  for (int i = 0; i < 100; ++i) {
    circle.emplace_back(2.0 * std::cos(0.02 * M_PI * i), 2.0 * std::sin(0.02 * M_PI * i));
  }
  EXPECT_NEAR(signedArea(ringOf(circle)), 200.0 * std::sin(0.02 * M_PI), 1e-12);
}

TEST(Floorplan, AreaIsExactTenThousandKilometresAway) {
  // Corners are whole numbers, so they are exact at 1e7, and their area must be too.
  EXPECT_DOUBLE_EQ(area(lWithCourtyardAndBox({1e7, -1e7})), 82.0);
}

TEST(Floorplan, ContainsByTheInequalitiesOfItsBoxes) {
  const Floorplan plan = lWithCourtyardAndBox({0.0, 0.0});
  const auto within = [](const Eigen::Vector2d& p, double x0, double y0, double x1, double y1) {
    return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-2.0, 25.0);
  std::uniform_real_distribution<double> y(-2.0, 12.0);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d p(x(random), y(random));
    const bool inside =
        (within(p, 0, 0, 10, 5) || within(p, 0, 0, 5, 10) || within(p, 20, 0, 23, 3)) &&
        !within(p, 1, 1, 3, 2);
    EXPECT_EQ(contains(plan, p), inside) << p.transpose();
  }
  // Level with corners, where a ray meets two edges at once.
  EXPECT_TRUE(contains(plan, {0.5, 1.0}));
  EXPECT_TRUE(contains(plan, {0.5, 5.0}));
  EXPECT_FALSE(contains(plan, {-0.5, 5.0}));
}

TEST(Floorplan, EmptyOnesAndRingsOfTwoCornersHoldNothing) {
  EXPECT_TRUE(Floorplan().empty());
  EXPECT_EQ(area(Floorplan()), 0.0);
  EXPECT_EQ(perimeter(Floorplan()), 0.0);
  EXPECT_EQ(countEdges(Floorplan()), 0U);
  EXPECT_FALSE(contains(Floorplan(), {0.0, 0.0}));
  EXPECT_EQ(signedArea(ringOf({})), 0.0);
  EXPECT_EQ(signedArea(ringOf({{0, 0}, {1, 1}})), 0.0);
}

}  // namespace
