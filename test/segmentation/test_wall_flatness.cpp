// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_flatness.h>

#include <algorithm>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::atMainHeights;

constexpr double kLength = 15.0;
const Eigen::Vector2d kIn(0.0, 1.0);  // of a wall along +x, whose outside is at -y

WallSampling storey(double z_min, double z_max) {
  WallSampling sampling;
  sampling.z_min = z_min;
  sampling.z_max = z_max;
  return sampling;
}

void addStorey(double setback, const WallSampling& sampling, std::mt19937& random,
               std::vector<WallPoint>& points) {
  const Eigen::Vector2d from = setback * sampling.noise * kIn;
  addWall(from, from + Eigen::Vector2d(kLength, 0.0), sampling, random, points);
}

WallLine facade() {
  WallLine line;
  line.normal = -kIn;
  return line;
}

std::vector<int> mainOf(const std::vector<WallPoint>& points) {
  return atMainHeights({points, allOf(points), facade()}, 0.05).number;
}

TEST(MainHeights, AreThoseOfTheTallerOfTwoStoreys) {
  for (const double setback : {-3.0, -2.0, 2.0, 3.0}) {
    std::mt19937 random(1);
    std::vector<WallPoint> points;
    addStorey(0.0, storey(0.0, 6.0), random, points);
    const auto of_lower = static_cast<int>(points.size());
    addStorey(setback, storey(6.0, 10.0), random, points);
    const auto kept = mainOf(points);
    // Levels of height are a 48th of all: one of them may be of both storeys.
    const auto wrong =
        std::count_if(kept.begin(), kept.end(), [&](const int i) { return i >= of_lower; });
    EXPECT_LT(wrong, static_cast<int>(points.size()) / 40) << setback;
    EXPECT_GT(static_cast<int>(kept.size() - static_cast<std::size_t>(wrong)),
              of_lower - static_cast<int>(points.size()) / 40)
        << setback;
  }
}

TEST(MainHeights, AreTheMiddleStoreyIfItIsTheTallest) {
  std::mt19937 random(2);
  std::vector<WallPoint> points;
  addStorey(2.5, storey(0.0, 2.0), random, points);
  addStorey(0.0, storey(2.0, 9.0), random, points);
  addStorey(-2.5, storey(9.0, 12.0), random, points);
  for (const int i : mainOf(points)) {
    EXPECT_GT(points[static_cast<std::size_t>(i)].z, 2.0 - 12.0 / 48);
    EXPECT_LT(points[static_cast<std::size_t>(i)].z, 9.0 + 12.0 / 48);
  }
}

TEST(MainHeights, AreAllOfAFlatWallOrOneThatLeansWithinItsNoise) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<WallPoint> points;
    addStorey(0.0, storey(0.0, 10.0), random, points);
    EXPECT_EQ(mainOf(points).size(), points.size());
    for (WallPoint& p : points) p.position += (p.z / 10.0) * 0.05 * kIn;
    EXPECT_EQ(mainOf(points).size(), points.size());
  }
}

TEST(MainHeights, IgnoreRowsOfWindows) {
  // Panes 2 deviations behind the wall over two fifths of its length, in three of five strips.
  std::mt19937 random(3);
  std::vector<WallPoint> points;
  addStorey(0.0, storey(0.0, 10.0), random, points);
  for (WallPoint& p : points) {
    const bool strip = static_cast<int>(p.z / 2.0) % 2 == 0;
    const bool pane = std::fmod(p.position.x(), 3.0) < 1.2;
    if (strip && pane) p.position += 2.0 * 0.05 * kIn;
  }
  EXPECT_EQ(mainOf(points).size(), points.size());
}

TEST(MainHeights, OfNothingAreNothing) { EXPECT_TRUE(mainOf({}).empty()); }

}  // namespace
