// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_density.h>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::HeightDensity;

constexpr double kHeight = 16.0;
const Corners kRing = box(0.0, 0.0, 14.0, 9.0);

// What decides is the octave: half of one either way. Discs about points at the rims of walls are
// not full.
constexpr double kFactor = M_SQRT2;

void expectNear(double found, double density) {
  EXPECT_GT(found, density / kFactor);
  EXPECT_LT(found, density * kFactor);
}

WallSampling between(double z_min, double z_max, double density) {
  WallSampling sampling;
  sampling.z_min = z_min;
  sampling.z_max = z_max;
  sampling.density = density;
  return sampling;
}

TEST(HeightDensity, IsThatOfTheWalls) {
  for (const double density : {8.0, 40.0, 200.0}) {
    const WallSampling sampling = between(0.0, kHeight, density);
    const HeightDensity found(wallsOf(kRing, sampling, 1), scaleOf(sampling));
    for (const double z : {0.5, 4.0, 8.0, 12.0, 15.5}) expectNear(found.at(z), density);
    expectNear(found.least(), density);
  }
}

TEST(HeightDensity, FollowsStepsDownToANinth) {
  const WallSampling lower = between(0.0, 0.5 * kHeight, 90.0);
  const WallSampling upper = between(0.5 * kHeight, kHeight, 10.0);
  std::vector<WallPoint> points = wallsOf(kRing, lower, 2);
  const std::vector<WallPoint> thin = wallsOf(kRing, upper, 3);
  points.insert(points.end(), thin.begin(), thin.end());
  const HeightDensity found(points, {lower.noise, 50.0});
  for (const double z : {0.5, 3.0, 6.0}) expectNear(found.at(z), 90.0);
  for (const double z : {10.0, 13.0, 15.5}) expectNear(found.at(z), 10.0);
  expectNear(found.least(), 10.0);
}

TEST(HeightDensity, ScalesWithTheUnit) {
  constexpr double kUnit = 1000.0;
  const WallSampling sampling = between(0.0, kHeight, 40.0);
  std::vector<WallPoint> points = wallsOf(kRing, sampling, 4);
  const HeightDensity expected(points, scaleOf(sampling));
  for (WallPoint& p : points) {
    p.position *= kUnit;
    p.z *= kUnit;
  }
  const HeightDensity found(points, {kUnit * sampling.noise, sampling.density / (kUnit * kUnit)});
  for (const double z : {1.5, 8.5, 14.5}) {
    EXPECT_NEAR(found.at(kUnit * z) * kUnit * kUnit, expected.at(z), 1e-6 * expected.at(z));
  }
}

TEST(HeightDensity, IsTheCloudsWhereThereIsNothing) {
  const HeightDensity found({}, {0.05, 40.0});
  EXPECT_EQ(found.at(3.0), 40.0);
  EXPECT_EQ(found.least(), 40.0);
}

}  // namespace
