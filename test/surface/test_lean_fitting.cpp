// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.1;
constexpr double kDegree = M_PI / 180.0;
constexpr double kHeight = 20.0;
constexpr double kSide = 20.0;
constexpr double kDensity = 20.0;

// A square tower, far from the origin.
const std::vector<FloorplanLayer>& tower() {
  static const std::vector<FloorplanLayer> layers = [] {
    std::vector<FloorplanLayer> result = {
        layer(100, 100 + kHeight, {rectangle(40, 70, 40 + kSide, 70 + kSide)})};
    int next = 0;
    for (FloorplanEdge& edge : result[0].plan.components[0].outer.edges) edge.wall = next++;
    return result;
  }();
  return layers;
}

const Eigen::Vector3d kMiddle(40 + kSide / 2, 70 + kSide / 2, 100 + kHeight / 2);

FitPoints cloud(unsigned seed) {
  WallSampler sampler(kSigma, seed);
  FitPoints points;
  sampler.addLayers(tower(), kDensity, points);
  return points;
}

void turn(const Eigen::Quaterniond& rotation, FitPoints& points) {
  for (Eigen::Vector3f& p : points.positions) {
    p = (kMiddle + rotation * (p.cast<double>() - kMiddle)).cast<float>();
  }
}

// Deviation of each component of the vertical, rad: four walls of n points each, two of which tell
// it, with heights of variance H^2 / 12 and walls that lean by 3e-4 themselves.
double verticalDeviation() {
  const double n = kDensity * kSide * kHeight;
  const double slope = kSigma / std::sqrt(n * kHeight * kHeight / 12.0);
  return std::sqrt((slope * slope + 3e-4 * 3e-4) / 2.0);
}

TEST(FitUpright, SetsALeaningCloudUpright) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const double azimuth = 0.6 * seed;
    const double tilt = 0.15 * kDegree;
    const Eigen::Quaterniond rotation(
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)));
    FitPoints points = cloud(seed);
    turn(rotation, points);
    const Eigen::Isometry3d upright = fitUpright(tower(), points, kSigma);
    const Eigen::Vector3d up = upright.linear() * (rotation * Eigen::Vector3d::UnitZ());
    EXPECT_LT(up.head<2>().norm(), 4.0 * verticalDeviation()) << "seed " << seed;
    EXPECT_NEAR((upright * kMiddle - kMiddle).norm(), 0.0, tilt);  // the middle is the points' own
    EXPECT_NEAR(upright.linear().determinant(), 1.0, 1e-12);
  }
}

TEST(FitUpright, AnUprightCloudStays) {
  // Chance: exp(-8) in each of 20 draws.
  for (unsigned seed = 100; seed < 120; ++seed) {
    EXPECT_TRUE(fitUpright(tower(), cloud(seed), kSigma).isApprox(Eigen::Isometry3d::Identity()))
        << "seed " << seed;
  }
}

TEST(FitUpright, OneWallThatLeansDoesNotTurnTheBuilding) {
  // 1 degree, as from two walls behind each other at different heights. Huber's weight lets it pull
  // like a wall that is two deviations off.
  FitPoints points = cloud(7);
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    if (points.normals[i].x() < 0.9F) continue;
    points.positions[i].x() +=
        static_cast<float>(1.0 * kDegree * (points.positions[i].z() - kMiddle.z()));
  }
  const Eigen::Isometry3d upright = fitUpright(tower(), points, kSigma);
  EXPECT_LT(upright.linear().col(2).head<2>().norm(), 4.0 * verticalDeviation());
}

TEST(FitUpright, WallsOfOneDirectionTellNothing) {
  FitPoints all = cloud(8);
  turn(Eigen::Quaterniond(Eigen::AngleAxisd(kDegree, Eigen::Vector3d::UnitY())), all);
  FitPoints facing;
  for (std::size_t i = 0; i < all.positions.size(); ++i) {
    if (std::abs(all.normals[i].x()) < 0.9F) continue;
    facing.positions.push_back(all.positions[i]);
    facing.normals.push_back(all.normals[i]);
  }
  EXPECT_TRUE(fitUpright(tower(), facing, kSigma).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(FitUpright, BadInputGivesTheIdentity) {
  FitPoints points = cloud(9);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(fitUpright(tower(), points, bad).isApprox(Eigen::Isometry3d::Identity()));
  }
  EXPECT_TRUE(fitUpright(tower(), {}, kSigma).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(fitUpright({}, points, kSigma).isApprox(Eigen::Isometry3d::Identity()));
  points.normals.pop_back();
  EXPECT_TRUE(fitUpright(tower(), points, kSigma).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
