// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_bends.h>

#include <algorithm>
#include <cmath>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::LinePoints;
using detail::onOneSideOfBend;

constexpr double kTurn = 0.3;   // rad, 17 degrees
constexpr double kMain = 6.0;   // length along +x, from the origin
constexpr double kShort = 1.5;  // of the wall after it

struct TwoWalls {
  WallSampling sampling;
  WallScale scale{sampling.noise, sampling.density};
  WallLine line;  // of the first wall
  std::vector<WallPoint> points;
  std::vector<int> support;

  TwoWalls() { line.normal = {0.0, -1.0}; }

  std::vector<int> keptSide() const {
    return onOneSideOfBend(points, LinePoints(points, support, line), scale, line).number;
  }

  void takeAll() {
    support.resize(points.size());
    std::iota(support.begin(), support.end(), 0);
  }
};

TwoWalls bentBy(double turn) {
  TwoWalls walls;
  std::mt19937 random(1);
  const Eigen::Vector2d corner(kMain, 0.0);
  addWall({0.0, 0.0}, corner, walls.sampling, random, walls.points);
  addWall(corner, corner + kShort * Eigen::Vector2d(std::cos(turn), std::sin(turn)), walls.sampling,
          random, walls.points);
  walls.takeAll();
  return walls;
}

TEST(OnOneSideOfBend, LeavesTheOtherWallOut) {
  for (const double turn : {kTurn, -kTurn}) {
    const TwoWalls walls = bentBy(turn);
    const std::vector<int> kept = walls.keptSide();
    double last = 0.0;
    for (const int i : kept)
      last = std::max(last, walls.points[static_cast<std::size_t>(i)].position.x());
    // A second line from the corner on turns away by one deviation within noise / sin(turn), and
    // columns are as wide as six points need.
    const double column = std::sqrt(6.0 / walls.sampling.density);
    EXPECT_NEAR(last, kMain, walls.sampling.noise / std::sin(kTurn) + column);
  }
}

TEST(OnOneSideOfBend, KeepsAStraightWall) {
  const TwoWalls walls = bentBy(0.0);
  EXPECT_EQ(walls.keptSide(), walls.support);
}

TEST(OnOneSideOfBend, KeepsAWallWithPanes) {
  // Set back by two deviations over the last third of the wall: a step that a bend fits as well as
  // noise would, but the normals do not turn.
  TwoWalls walls;
  std::mt19937 random(2);
  const Eigen::Vector2d back(0.0, 2.0 * walls.sampling.noise);
  addWall({0.0, 0.0}, {4.0, 0.0}, walls.sampling, random, walls.points);
  addWall(Eigen::Vector2d(4.0, 0.0) + back, Eigen::Vector2d(6.0, 0.0) + back, walls.sampling,
          random, walls.points);
  walls.takeAll();
  EXPECT_EQ(walls.keptSide(), walls.support);
}

}  // namespace
