// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/point_classes.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "faces.h"

namespace storey::detail {
namespace {

const WallScale kScale{0.05, 100.0};
constexpr double kLeastWall = 1.0;

std::vector<PointClass> classesOf(const std::vector<OrientedPoint>& points) {
  return classifyPoints(points, std::vector<char>(points.size(), 1), kScale, kLeastWall);
}

bool allAre(const std::vector<PointClass>& classes, std::size_t from, std::size_t to,
            PointClass expected) {
  return std::all_of(classes.begin() + static_cast<std::ptrdiff_t>(from),
                     classes.begin() + static_cast<std::ptrdiff_t>(to),
                     [&](PointClass c) { return c == expected; });
}

TEST(PointClasses, WallsThatLeanAreSloped) {
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {8, 0, 0}, {0, 0, 8});
  const std::size_t upright = points.size();
  addFace(points, {0, 0, 8}, {8, 0, 0}, {0, 1.6, 7.8});  // 11.6 degrees
  const std::vector<PointClass> classes = classesOf(points);
  for (std::size_t i = 0; i < upright; ++i) {  // the cubes at the edge of both are mixed
    if (points[i].position.z() > 7.0f) continue;
    EXPECT_EQ(classes[i], PointClass::Wall);
  }
  // All but the mixed cubes, and those at the rim with too few points to tell.
  EXPECT_GT(std::count(classes.begin(), classes.end(), PointClass::Sloped),
            static_cast<std::ptrdiff_t>(0.8 * static_cast<double>(points.size() - upright)));
}

TEST(PointClasses, SmallGroupsBehindAGapAreApart) {
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {8, 0, 0}, {0, 0, 8});
  const std::size_t wall = points.size();
  addFace(points, {2, -4, 0}, {1, 0, 0}, {0, 0, 1});  // 1 of 64
  const std::size_t car = points.size();
  addFace(points, {0, 9, 0}, {4, 0, 0}, {0, 0, 4});  // a quarter
  const std::vector<PointClass> classes = classesOf(points);
  EXPECT_TRUE(allAre(classes, 0, wall, PointClass::Wall));
  EXPECT_TRUE(allAre(classes, wall, car, PointClass::Apart));
  EXPECT_TRUE(allAre(classes, car, points.size(), PointClass::Wall));
}

TEST(PointClasses, CrownsOfTreesAreSmall) {
  // What lies within 30 degrees of a plane's normal on a ball of radius 1.5 is a cap of 1.9, with
  // the cells that its rim cuts less than 5.
  constexpr double kRadius = 1.5;
  constexpr double kLeast = 6.0;
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {8, 0, 0}, {0, 0, 8});
  addFace(points, {2, -0.3, 4}, {1, 0, 0}, {0, 0, 1});  // a shutter in front of the wall
  const std::size_t shutter = points.size();
  addFace(points, {0, -9, 0}, {8, 0, 0}, {0, 8, 0});
  const std::size_t ground = points.size();
  constexpr int kOnBall = 3000;
  for (int i = 0; i < kOnBall; ++i) {  // a Fibonacci lattice
    const double z = 1.0 - (2.0 * i + 1.0) / kOnBall;
    const double turn = i * M_PI * (3.0 - std::sqrt(5.0));
    const Eigen::Vector3d normal(std::sqrt(1.0 - z * z) * std::cos(turn),
                                 std::sqrt(1.0 - z * z) * std::sin(turn), z);
    const Eigen::Vector3d place = Eigen::Vector3d(4.0, -6.0, 5.0) + kRadius * normal;
    points.push_back({place.cast<float>(), normal.cast<float>()});
  }
  const auto classes = classifyPoints(points, std::vector<char>(points.size(), 1), kScale, kLeast);
  EXPECT_TRUE(allAre(classes, 0, shutter, PointClass::Wall));
  EXPECT_TRUE(allAre(classes, shutter, ground, PointClass::Ground));
  EXPECT_TRUE(allAre(classes, ground, points.size(), PointClass::Small));
}

TEST(PointClasses, WhatIsNotPlanarStaysSo) {
  std::vector<OrientedPoint> points;
  addFace(points, {0, 0, 0}, {2, 0, 0}, {0, 0, 2});
  const auto classes =
      classifyPoints(points, std::vector<char>(points.size(), 0), kScale, kLeastWall);
  EXPECT_TRUE(allAre(classes, 0, points.size(), PointClass::NonPlanar));
}

}  // namespace
}  // namespace storey::detail
