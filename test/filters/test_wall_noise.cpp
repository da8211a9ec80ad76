// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/wall_relief.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace {

using storey::detail::estimateWallNoise;
using storey::detail::estimateWallRelief;

constexpr double kLength = 20.0;
constexpr double kHeight = 10.0;
constexpr double kNoise = 0.05;
constexpr double kPatch = 0.25;  // about 80 of them within a twentieth of the extent
const double kExtent = std::hypot(kLength, kHeight);
const double kRadius = 0.05 * kExtent;

struct Wall {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
};

// A wall in no special direction, far from the origin. Square patches of it stand off by N(0,
// relief), the points of each by N(0, noise) more.
Wall makeWall(double noise, double relief, std::size_t n = 20000) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::map<std::pair<int, int>, double> offsets;
  const Eigen::Vector3d out(std::cos(0.7), std::sin(0.7), 0.0);
  const Eigen::Vector3d along(-out.y(), out.x(), 0.0);
  Wall wall;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = kLength * unit(random);
    const double z = kHeight * unit(random);
    const std::pair<int, int> patch(static_cast<int>(s / kPatch), static_cast<int>(z / kPatch));
    const auto [offset, drawn] = offsets.emplace(patch, 0.0);
    if (drawn) offset->second = relief * normal(random);
    const Eigen::Vector3d p = Eigen::Vector3d(30.0, -20.0, z) + s * along +
                              (offset->second + noise * normal(random)) * out;
    wall.positions.push_back(p.cast<float>());
    wall.normals.push_back(out.cast<float>());
  }
  return wall;
}

TEST(WallNoise, IsTheSameForAnyNumberOfThreads) {
  const Wall wall = makeWall(kNoise, 0.0);
  const auto measure = [&](unsigned int threads) {
    return estimateWallRelief(wall.positions, wall.normals, kRadius, kNoise, threads);
  };
  EXPECT_EQ(measure(2), measure(1));
  EXPECT_EQ(measure(3), measure(1));
}

// Places overlap: some 50 neighbourhoods of 400 points are independent, the deviation of their
// median is below 1 %.
TEST(WallNoise, OfAPlaneIsThatOfItsPoints) {
  const Wall wall = makeWall(kNoise, 0.0);
  EXPECT_NEAR(estimateWallRelief(wall.positions, wall.normals, kRadius, kNoise), kNoise,
              0.04 * kNoise);
  EXPECT_EQ(estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent), kNoise);
}

// The points are N(0, sqrt(17) noise) about the wall, and those beyond the gate of eight noises,
// 1.94 of these deviations, do not count: the median deviation of the others is at
// erf(m / sqrt 2) = 0.9476 / 2, at m = 0.634 instead of 0.6745. Patches that count as one sample
// each scatter by 0.117 in a neighbourhood of 80, by a tenth of that in the median of all.
TEST(WallNoise, OfAWallWithReliefIsTheRelief) {
  const Wall wall = makeWall(kNoise, 4.0 * kNoise);
  const double expected = std::sqrt(17.0) * 0.634 / 0.6745 * kNoise;
  EXPECT_NEAR(estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent), expected,
              0.08 * expected);
}

TEST(WallNoise, ALittleReliefIsNoise) {
  const Wall wall = makeWall(kNoise, 0.5 * kNoise);  // sqrt(1.25) = 1.12 together
  EXPECT_EQ(estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent), kNoise);
}

TEST(WallNoise, WithoutAnyItIsAHundredThousandthOfTheExtent) {
  const Wall wall = makeWall(0.0, 0.0);
  EXPECT_DOUBLE_EQ(estimateWallNoise(wall.positions, wall.normals, 0.0, kExtent), 1e-5 * kExtent);
  EXPECT_DOUBLE_EQ(estimateWallNoise({}, {}, 0.0, kExtent), 1e-5 * kExtent);
}

TEST(WallNoise, WhereNoPlaceHasEnoughPointsItIsTheGivenOne) {
  const Wall wall = makeWall(kNoise, 4.0 * kNoise, 500);  // ten in a neighbourhood
  EXPECT_EQ(estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent), kNoise);
}

// Another wall across the corner, or a parallel one that faces away, is no relief.
TEST(WallNoise, WallsThatFaceElsewhereTakeNoPart) {
  Wall wall = makeWall(kNoise, 0.0);
  const std::size_t n = wall.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    wall.positions.push_back(wall.positions[i] -
                             static_cast<float>(4.0 * kNoise) * wall.normals[i]);
    wall.normals.push_back(-wall.normals[i]);
  }
  EXPECT_EQ(estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent), kNoise);
}

TEST(WallNoise, ScalesWithTheCloud) {
  Wall wall = makeWall(kNoise, 4.0 * kNoise);
  const double here = estimateWallNoise(wall.positions, wall.normals, kNoise, kExtent);
  for (Eigen::Vector3f& p : wall.positions) p *= 1000.0F;
  const double there =
      estimateWallNoise(wall.positions, wall.normals, 1000.0 * kNoise, 1000.0 * kExtent);
  EXPECT_NEAR(there / here, 1000.0, 1.0);
}

}  // namespace
