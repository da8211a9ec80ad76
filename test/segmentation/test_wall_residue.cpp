// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_residue.h>

#include <cmath>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::DensePlace;
using detail::findDensePlaces;

const std::vector<double> kAngles = {0.0, M_PI_2, M_PI, 1.5 * M_PI};

// Points anywhere in a cube, whose normals point anywhere.
void addClutter(int count, double side, std::mt19937& random, std::vector<WallPoint>& points) {
  std::uniform_real_distribution<double> place(0.0, side);
  std::uniform_real_distribution<double> turn(0.0, 2.0 * M_PI);
  for (int i = 0; i < count; ++i) {
    const double angle = turn(random);
    points.push_back(
        {{place(random), place(random)}, place(random), {std::cos(angle), std::sin(angle)}});
  }
}

TEST(FindDensePlaces, FindsAShortWallInClutter) {
  WallSampling sampling;
  std::mt19937 random(1);
  std::vector<WallPoint> points;
  addClutter(5000, 10.0, random, points);
  addWall({5.0, 5.0}, {6.0, 5.0}, sampling, random, points);  // its outside is at -y
  const std::vector<char> left(points.size(), 1);
  const std::vector<DensePlace> places = findDensePlaces(points, left, kAngles, sampling.noise);
  ASSERT_FALSE(places.empty());
  for (const DensePlace& place : places) {  // the tangent of a normal along -y is +x
    EXPECT_NEAR(place.normal.y(), -1.0, 1e-12);
    EXPECT_NEAR(place.offset, -5.0, sampling.noise);
    EXPECT_LT(place.s_min, 6.0);
    EXPECT_GT(place.s_max, 5.0);
  }
}

TEST(FindDensePlaces, FindsNothingInClutterAlone) {
  // One search in a hundred may find a place: two of ten have a chance of less than one half in a
  // hundred.
  int found = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    std::vector<WallPoint> points;
    addClutter(3000, 10.0, random, points);
    const std::vector<char> left(points.size(), 1);
    found += findDensePlaces(points, left, kAngles, 0.05).empty() ? 0 : 1;
  }
  EXPECT_LE(found, 1);
}

TEST(FindDensePlaces, TakesNoPointsOfWallsForOne) {
  WallSampling sampling;
  std::mt19937 random(3);
  std::vector<WallPoint> points;
  addWall({0.0, 0.0}, {6.0, 0.0}, sampling, random, points);
  std::vector<char> left(points.size(), 0);  // but for what strays farthest
  for (std::size_t i = 0; i < points.size(); ++i)
    left[i] = std::abs(points[i].position.y()) > 2.0 * sampling.noise;
  EXPECT_TRUE(findDensePlaces(points, left, kAngles, sampling.noise).empty());
}

}  // namespace
