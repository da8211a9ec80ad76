// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <algorithm>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::findWallLines;

// Right and oblique angles, parallel walls, one on the line of none other.
const Corners kPolygon = {{0, 0}, {14, 0}, {18, 5}, {18, 12}, {7, 12}, {7, 9}, {0, 9}};
constexpr double kMinArea = 2.0;

struct TrueWall {
  Eigen::Vector2d middle;
  Eigen::Vector2d normal;
  double length;
};

std::vector<TrueWall> trueWalls(const Corners& ring) {
  std::vector<TrueWall> walls;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d along = ring[(i + 1) % ring.size()] - ring[i];
    walls.push_back(
        {ring[i] + 0.5 * along, Eigen::Vector2d(along.y(), -along.x()).normalized(), along.norm()});
  }
  return walls;
}

// One line a wall, as good as its points allow: five deviations, and a tenth for the robust fit.
void expectOneLineEach(const std::vector<WallLine>& lines, const Corners& ring,
                       const WallSampling& sampling) {
  const std::vector<TrueWall> walls = trueWalls(ring);
  EXPECT_EQ(lines.size(), walls.size());
  for (const TrueWall& wall : walls) {
    const LineDeviation expected = deviationOf(wall.length, sampling);
    const auto fits = [&](const WallLine& line) {
      return std::abs(angleError(line, wall.normal)) < 5.5 * expected.angle &&
             std::abs(line.across(wall.middle)) < 5.5 * expected.offset;
    };
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(), fits), 1)
        << "wall at " << wall.middle.transpose();
  }
  for (const WallLine& line : lines) {
    const auto wall =
        std::min_element(walls.begin(), walls.end(), [&](const TrueWall& a, const TrueWall& b) {
          return (a.normal - line.normal).norm() + std::abs(line.across(a.middle)) <
                 (b.normal - line.normal).norm() + std::abs(line.across(b.middle));
        });
    // Points near a corner may go to the other wall, and cells at the ends be half full.
    const double cell = std::max(3.0 * sampling.noise, std::sqrt(6.0 / sampling.density));
    EXPECT_NEAR(line.s_max - line.s_min, wall->length, 4.0 * cell);
    EXPECT_NEAR(line.along(wall->middle), 0.5 * (line.s_min + line.s_max), 3.0 * cell);
  }
  EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end(), [](const WallLine& a, const WallLine& b) {
    return a.support > b.support;
  }));
}

TEST(WallLines, APolygonsWallsAreOneLineEach) {
  const WallSampling sampling;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<WallPoint> points = wallsOf(kPolygon, sampling, seed);
    expectOneLineEach(findWallLines(points, scaleOf(sampling), {kMinArea}), kPolygon, sampling);
  }
}

TEST(WallLines, TurnedAndShiftedTheSame) {
  const WallSampling sampling;
  for (const double yaw : {0.37, 1.2, M_PI_2, -2.4}) {
    const Corners ring = moved(kPolygon, yaw, {40.0 * yaw, -25.0});
    const std::vector<WallPoint> points = wallsOf(ring, sampling, 1);
    expectOneLineEach(findWallLines(points, scaleOf(sampling), {kMinArea}), ring, sampling);
  }
}

TEST(WallLines, InAnyUnitTheSame) {
  const WallSampling sampling;
  const std::vector<WallPoint> points = wallsOf(kPolygon, sampling, 1);
  const std::vector<WallLine> expected = findWallLines(points, scaleOf(sampling), {kMinArea});
  for (const double unit : {1.0 / 256.0, 1024.0}) {  // powers of two: no rounding
    std::vector<WallPoint> scaled = points;
    for (WallPoint& p : scaled) {
      p.position *= unit;
      p.z *= unit;
    }
    const WallScale scale{sampling.noise * unit, sampling.density / (unit * unit)};
    const auto lines = findWallLines(scaled, scale, {kMinArea * unit * unit});
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t l = 0; l < lines.size(); ++l) {
      EXPECT_NEAR(lines[l].offset, expected[l].offset * unit, 1e-9 * unit);
      EXPECT_NEAR((lines[l].normal - expected[l].normal).norm(), 0.0, 1e-9);
      EXPECT_EQ(lines[l].support, expected[l].support);
    }
  }
}

TEST(WallLines, WallsThatFaceEachOtherOnOneLineAreTwo) {
  // The two faces of a partition three deviations thick differ by their normals alone.
  const WallSampling sampling;
  const double thickness = 3.0 * sampling.noise;
  std::mt19937 random(3);
  std::vector<WallPoint> points;
  addWall({0, 0}, {10, 0}, sampling, random, points);
  addWall({10, thickness}, {0, thickness}, sampling, random, points);
  const auto lines = findWallLines(points, scaleOf(sampling), {kMinArea});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_LT(lines[0].normal.dot(lines[1].normal), -0.99);
  const double bound = 5.5 * deviationOf(10.0, sampling).offset;
  for (const WallLine& line : lines) {
    EXPECT_NEAR(line.across({5.0, line.normal.y() < 0.0 ? 0.0 : thickness}), 0.0, bound);
  }
}

TEST(WallLines, ParallelWallsSixDeviationsApartAreTwo) {
  // A storey set back by 0.3 over another one, with the other walls that give the direction.
  const WallSampling lower;
  WallSampling upper = lower;
  upper.z_min = lower.z_max;
  upper.z_max = lower.z_max + 4.0;
  const double setback = 6.0 * lower.noise;
  std::vector<WallPoint> points = wallsOf(box(0, 0, 12, 8), lower, 4);
  for (const WallPoint& p : wallsOf(box(0, setback, 12, 8), upper, 5)) points.push_back(p);
  const auto lines = findWallLines(points, scaleOf(lower), {kMinArea});
  EXPECT_EQ(lines.size(), 5U);
  const double bound = 5.5 * deviationOf(12.0, lower).offset;
  for (const double y : {0.0, setback}) {
    EXPECT_EQ(
        std::count_if(lines.begin(), lines.end(),
                      [&](const WallLine& line) {
                        return line.normal.y() < -0.99 && std::abs(line.across({6.0, y})) < bound;
                      }),
        1)
        << "y = " << y;
  }
}

TEST(WallLines, WallsBelowTheLeastAreaAreNone) {
  const WallSampling sampling;
  std::mt19937 random(6);
  std::vector<WallPoint> points = wallsOf(box(0, 0, 12, 8), sampling, 6);
  addWall({20, 3}, {21, 3}, sampling, random, points);  // area 4
  EXPECT_EQ(findWallLines(points, scaleOf(sampling), {8.0}).size(), 4U);
  EXPECT_EQ(findWallLines(points, scaleOf(sampling), {1.0}).size(), 5U);
}

TEST(WallLines, AFacadeSeenFromAfarIsAWall) {
  const WallSampling near;
  WallSampling far = near;
  far.density = near.density / 7.0;
  std::mt19937 random(8);
  std::vector<WallPoint> points;
  addWall({0, 0}, {12, 0}, near, random, points);
  addWall({12, 0}, {12, 8}, near, random, points);
  addWall({12, 8}, {0, 8}, far, random, points);  // area 48, with the points of 7 seen nearby
  addWall({0, 8}, {0, 0}, near, random, points);
  const auto facesBack = [](const WallLine& line) { return line.normal.y() > 0.99; };
  const auto lines = findWallLines(points, scaleOf(near), {kMinArea});
  EXPECT_EQ(lines.size(), 4U);
  const auto back = std::find_if(lines.begin(), lines.end(), facesBack);
  ASSERT_NE(back, lines.end());
  EXPECT_NEAR(back->across({6.0, 8.0}), 0.0, 5.5 * deviationOf(12.0, far).offset);
  // Clutter may have so few points, where the least wall seen nearby has more.
  const auto large = findWallLines(points, scaleOf(near), {20.0});
  EXPECT_TRUE(std::none_of(large.begin(), large.end(), facesBack));
}

TEST(WallLines, InAnyNumberOfThreadsTheSame) {
  // Among clutter, and with a least area that clutter nearly has, most peaks are no lines.
  const WallSampling sampling;
  std::mt19937 random(9);
  std::vector<WallPoint> points = wallsOf(kPolygon, sampling, 9);
  std::uniform_real_distribution<double> place(-2.0, 20.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  for (int i = 0; i < 6000; ++i) {
    const double a = angle(random);
    points.push_back(
        {{place(random), place(random)}, 0.2 * place(random), {std::cos(a), std::sin(a)}});
  }
  detail::WallLineOptions options{0.5};
  options.threads = 1;
  const auto alone = findWallLines(points, scaleOf(sampling), options);
  options.threads = 4;
  const auto together = findWallLines(points, scaleOf(sampling), options);
  ASSERT_GE(alone.size(), kPolygon.size());
  ASSERT_EQ(alone.size(), together.size());
  for (std::size_t l = 0; l < alone.size(); ++l) {
    EXPECT_EQ(alone[l].normal, together[l].normal);
    EXPECT_EQ(alone[l].offset, together[l].offset);
    EXPECT_EQ(alone[l].support, together[l].support);
    EXPECT_EQ(alone[l].runs, together[l].runs);
  }
}

TEST(WallLines, ScatteredPointsAreNoWalls) {
  const WallSampling sampling;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::vector<WallPoint> points;
  for (int i = 0; i < 4000; ++i) {
    const double a = angle(random);
    points.push_back(
        {{place(random), place(random)}, 0.2 * place(random), {std::cos(a), std::sin(a)}});
  }
  EXPECT_TRUE(findWallLines(points, scaleOf(sampling), {kMinArea}).empty());
  EXPECT_TRUE(findWallLines({}, scaleOf(sampling), {kMinArea}).empty());
}

}  // namespace
