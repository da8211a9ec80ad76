// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_support.h>

#include <algorithm>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::fitToSupport;
using detail::supportCellSize;

const Eigen::Vector2d kFrom(3.0, -2.0);
constexpr double kLength = 12.0;
constexpr double kYaw = 0.6;
const Eigen::Vector2d kAlong(std::cos(kYaw), std::sin(kYaw));
const Eigen::Vector2d kOut(std::sin(kYaw), -std::cos(kYaw));

WallLine lineOf(const Eigen::Vector2d& normal, const Eigen::Vector2d& through) {
  WallLine line;
  line.normal = normal;
  line.offset = normal.dot(through);
  return line;
}

// A guess that is off by up to two deviations of noise at the ends of the wall.
WallLine guessOf(const WallSampling& sampling, std::mt19937& random) {
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  const double turn = 2.0 * sampling.noise / kLength * off(random);
  const Eigen::Vector2d middle = kFrom + 0.5 * kLength * kAlong;
  return lineOf(Eigen::Rotation2Dd(turn) * kOut, middle + sampling.noise * off(random) * kOut);
}

TEST(WallSupport, FitsAreAsGoodAsLeastSquares) {
  // Errors in units of what least squares would have, over 60 walls. The weights of a robust fit
  // and its cut cost some of the efficiency: 10 % more, and 4 deviations of a root mean square of
  // 60 values, 1 / sqrt(120) each.
  const WallSampling sampling;
  const LineDeviation expected = deviationOf(kLength, sampling);
  const Eigen::Vector2d middle = kFrom + 0.5 * kLength * kAlong;
  std::mt19937 random(1);
  double offsets = 0.0;
  double angles = 0.0;
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<WallPoint> points;
    addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
    WallLine line = guessOf(sampling, random);
    const std::vector<int> support =
        fitToSupport(points, allOf(points), scaleOf(sampling), {}, line);
    ASSERT_FALSE(support.empty());
    EXPECT_NEAR(line.normal.norm(), 1.0, 1e-12);
    offsets += std::pow(line.across(middle) / expected.offset, 2);
    angles += std::pow(angleError(line, kOut) / expected.angle, 2);
    // What it says of itself. A deviation of n values is known to 1 / sqrt(2 n): here to 2 %, and
    // the robust weights take the tails away.
    EXPECT_NEAR(line.residual, sampling.noise, 0.2 * sampling.noise);
    EXPECT_NEAR(line.angle_deviation, expected.angle, 0.25 * expected.angle);
  }
  const double limit = 1.1 * (1.0 + 4.0 / std::sqrt(2.0 * kRounds));
  EXPECT_LE(std::sqrt(offsets / kRounds), limit);
  EXPECT_LE(std::sqrt(angles / kRounds), limit);
}

TEST(WallSupport, ALockedDirectionStaysAndTheOffsetIsBetter) {
  const WallSampling sampling;
  const double expected = deviationOf(kLength, sampling).offset;
  std::mt19937 random(2);
  double squares = 0.0;
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<WallPoint> points;
    addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
    WallLine line = lineOf(kOut, kFrom + (round % 2 == 0 ? 1.5 : -1.5) * sampling.noise * kOut);
    const auto support = fitToSupport(points, allOf(points), scaleOf(sampling), {false}, line);
    ASSERT_FALSE(support.empty());
    EXPECT_NEAR(angleError(line, kOut), 0.0, 1e-12);
    squares += std::pow(line.across(kFrom) / expected, 2);
  }
  EXPECT_LE(std::sqrt(squares / kRounds), 1.1 * (1.0 + 4.0 / std::sqrt(2.0 * kRounds)));
}

TEST(WallSupport, TheSupportIsDescribed) {
  // A wall with a window from top to bottom, in the middle third.
  const WallSampling sampling;
  std::mt19937 random(3);
  std::vector<WallPoint> points;
  addWall(kFrom, kFrom + 4.0 * kAlong, sampling, random, points);
  addWall(kFrom + 8.0 * kAlong, kFrom + kLength * kAlong, sampling, random, points);
  WallLine line = guessOf(sampling, random);
  const std::vector<int> support = fitToSupport(points, allOf(points), scaleOf(sampling), {}, line);
  EXPECT_TRUE(std::is_sorted(support.begin(), support.end()));
  EXPECT_EQ(line.support, support.size());
  // Cells half full at the ends may be left out; all else of the wall is support.
  EXPECT_GE(static_cast<double>(support.size()), 0.85 * static_cast<double>(points.size()));
  const double cell = supportCellSize(scaleOf(sampling));
  const double start = line.along(kFrom);
  EXPECT_NEAR(line.s_min, start, 1.5 * cell);
  EXPECT_NEAR(line.s_max, start + kLength, 1.5 * cell);
  EXPECT_NEAR(line.z_min, sampling.z_min, 1.5 * cell);
  EXPECT_NEAR(line.z_max, sampling.z_max, 1.5 * cell);
  ASSERT_EQ(line.runs.size(), 2U);
  EXPECT_NEAR(line.runs[0].first, start, 1.5 * cell);
  EXPECT_NEAR(line.runs[0].second, start + 4.0, 1.5 * cell);
  EXPECT_NEAR(line.runs[1].first, start + 8.0, 1.5 * cell);
  EXPECT_NEAR(line.runs[1].second, start + kLength, 1.5 * cell);
  // Two thirds of the wall, a cell more or less around each part.
  const double border = 2.0 * 2.0 * (4.0 + 4.0) * cell;
  EXPECT_NEAR(line.support_area, 2.0 * 4.0 * 4.0, border);
  EXPECT_GT(line.support_area, 0.5 * 2.0 * 4.0 * 4.0);
}

// Wall after wall along the line, of equal length, the second one `step` deviations set back.
struct Setback {
  WallSampling sampling;
  double step;
  Eigen::Vector2d second;  // start of the second wall
  std::vector<WallPoint> points;
  std::size_t first_size = 0;

  Setback(double deviations, unsigned seed)
      : step(deviations), second(kFrom + kLength * kAlong - step * sampling.noise * kOut) {
    std::mt19937 random(seed);
    addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
    first_size = points.size();
    addWall(second, second + kLength * kAlong, sampling, random, points);
  }

  // From the line of the first wall (0) to the one through the middles of both (1).
  WallLine guess(double lean) const {
    const Eigen::Vector2d middle = kFrom + 0.5 * kLength * kAlong;
    const Eigen::Vector2d t = (kLength * kAlong - lean * step * sampling.noise * kOut).normalized();
    return lineOf({t.y(), -t.x()}, middle);
  }

  // Nearly all of the support is of one wall, and the line is that wall's to a deviation: the
  // stretch may be short, and hold points of the other wall where they meet.
  void expectOneWall(const std::vector<int>& support, const WallLine& line) const {
    const auto of_first =
        static_cast<std::size_t>(std::count_if(support.begin(), support.end(), [&](int i) {
          return static_cast<std::size_t>(i) < first_size;
        }));
    const bool first = 2 * of_first > support.size();
    EXPECT_GE(first ? of_first : support.size() - of_first, support.size() * 9 / 10);
    const Eigen::Vector2d middle = (first ? kFrom : second) + 0.5 * kLength * kAlong;
    EXPECT_LE(std::abs(line.across(middle)), sampling.noise);
    EXPECT_LE(std::abs(angleError(line, kOut)), sampling.noise / kLength);
  }
};

TEST(WallSupport, NoLineLeansOverTwoParallelWalls) {
  for (const double step : {4.0, 6.0}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Setback walls(step, seed);
      for (const double lean : {0.0, 0.1, 0.3, 0.6, 1.0}) {
        SCOPED_TRACE(::testing::Message() << step << " " << seed << " " << lean);
        WallLine line = walls.guess(lean);
        const auto support =
            fitToSupport(walls.points, allOf(walls.points), scaleOf(walls.sampling), {}, line);
        if (!support.empty()) walls.expectOneWall(support, line);
        // From a guess along the wall itself it is found.
        EXPECT_TRUE(lean > 0.1 || !support.empty());
      }
    }
  }
}

TEST(WallSupport, ALockedLineOverTwoParallelWallsTakesTheLargerOne) {
  // A storey of 2 over one of 4, set back by four deviations.
  WallSampling lower;
  WallSampling upper = lower;
  upper.z_min = lower.z_max;
  upper.z_max = lower.z_max + 2.0;
  const double bound = 5.0 * deviationOf(kLength, lower).offset;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    std::vector<WallPoint> points;
    addWall(kFrom, kFrom + kLength * kAlong, lower, random, points);
    const Eigen::Vector2d setback = -4.0 * lower.noise * kOut;
    addWall(kFrom + setback, kFrom + kLength * kAlong + setback, upper, random, points);
    WallLine line = lineOf(kOut, kFrom + 0.3 * setback);
    const auto support = fitToSupport(points, allOf(points), scaleOf(lower), {false}, line);
    ASSERT_FALSE(support.empty());
    EXPECT_LE(std::abs(line.across(kFrom)), bound) << seed;
  }
}

TEST(WallSupport, SparseOutliersAreNoSupport) {
  // 2 % of a wall's density, evenly across the gate of the fit.
  const WallSampling sampling;
  std::uniform_real_distribution<double> s(0.0, kLength);
  std::uniform_real_distribution<double> z(sampling.z_min, sampling.z_max);
  std::uniform_real_distribution<double> across(-4.0 * sampling.noise, 4.0 * sampling.noise);
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<WallPoint> points;
    const int count = static_cast<int>(0.02 * sampling.density * kLength * 4.0);
    for (int i = 0; i < count; ++i) {
      points.push_back({kFrom + s(random) * kAlong + across(random) * kOut, z(random), kOut});
    }
    WallLine line = lineOf(kOut, kFrom);
    EXPECT_TRUE(fitToSupport(points, allOf(points), scaleOf(sampling), {}, line).empty());
    line = lineOf(kOut, kFrom);
    EXPECT_TRUE(fitToSupport(points, allOf(points), scaleOf(sampling), {false}, line).empty());
  }
}

TEST(WallSupport, OutliersAroundAWallDoNotMoveIt) {
  // A fifth as many outliers as points, on one side only, from 3 to 12 deviations off.
  const WallSampling sampling;
  const LineDeviation expected = deviationOf(kLength, sampling);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> s(0.0, kLength);
  std::uniform_real_distribution<double> z(sampling.z_min, sampling.z_max);
  std::uniform_real_distribution<double> across(3.0 * sampling.noise, 12.0 * sampling.noise);
  for (int round = 0; round < 20; ++round) {
    std::vector<WallPoint> points;
    addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
    const std::size_t count = points.size() / 5;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back({kFrom + s(random) * kAlong + across(random) * kOut, z(random), kOut});
    }
    WallLine line = guessOf(sampling, random);
    ASSERT_FALSE(fitToSupport(points, allOf(points), scaleOf(sampling), {}, line).empty());
    // Of the outliers a ninth, 2 % of the points, lies within 4 deviations. There the weight of
    // Tukey's function is below 0.2, so that the mean shifts by less than 0.02 x 0.2 x 3.5 noise.
    const double shift = 0.02 * 0.2 * 3.5 * sampling.noise;
    EXPECT_LE(std::abs(line.across(kFrom + 0.5 * kLength * kAlong)), shift + 5.0 * expected.offset);
    EXPECT_LE(std::abs(angleError(line, kOut)), 5.0 * expected.angle);
  }
}

// A crown: points in a ball about `center`, normals anywhere within the gate of the votes.
void addCrown(const Eigen::Vector2d& center, double z, double radius, std::size_t count,
              std::mt19937& random, std::vector<WallPoint>& points) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::size_t added = 0; added < count;) {
    const Eigen::Vector3d p(unit(random), unit(random), unit(random));
    if (p.norm() > 1.0) continue;
    points.push_back({center + radius * p.head<2>(), z + radius * p.z(),
                      Eigen::Rotation2Dd(0.78 * unit(random)) * kOut});
    ++added;
  }
}

TEST(WallSupport, ATreeIsNoWallHoweverDense) {
  // As dense as a wall where a line crosses it: 40 points per unit of area within two deviations of
  // it to either side, and as many in any layer beside.
  const WallSampling sampling;
  const double radius = 2.0;
  const double volume = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
  const auto count = static_cast<std::size_t>(sampling.density / (4.0 * sampling.noise) * volume);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    std::vector<WallPoint> points;
    addCrown(kFrom, 4.0, radius, count, random, points);
    for (const bool fit_direction : {true, false}) {
      WallLine line = lineOf(kOut, kFrom);
      const auto support =
          fitToSupport(points, allOf(points), scaleOf(sampling), {fit_direction}, line);
      EXPECT_TRUE(support.empty()) << seed;
    }
  }
}

TEST(WallSupport, ATreeThatTouchesAWallDoesNotHideIt) {
  // A crown in front of the wall, as many points as a tenth of it, that just reaches it: of a ball
  // the share 3 h^2 / 4 r^2 is nearer than h to its end, at 6 deviations and a radius of 1.5 less
  // than 0.03. With 0.003 of the points at the most 6 deviations off the line moves by 0.018.
  const WallSampling sampling;
  const LineDeviation expected = deviationOf(kLength, sampling);
  const double radius = 1.5;
  const Eigen::Vector2d middle = kFrom + 0.5 * kLength * kAlong;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<WallPoint> points;
    addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
    addCrown(middle + radius * kOut, 2.0, radius, points.size() / 10, random, points);
    WallLine line = guessOf(sampling, random);
    ASSERT_FALSE(fitToSupport(points, allOf(points), scaleOf(sampling), {}, line).empty()) << seed;
    EXPECT_LE(std::abs(line.across(middle)), 0.018 * sampling.noise + 5.0 * expected.offset);
    EXPECT_LE(std::abs(angleError(line, kOut)), 5.0 * expected.angle);
  }
}

TEST(WallSupport, OnlyCandidatesSupport) {
  const WallSampling sampling;
  std::mt19937 random(7);
  std::vector<WallPoint> points;
  addWall(kFrom, kFrom + kLength * kAlong, sampling, random, points);
  std::vector<int> every_other;
  for (int i : allOf(points)) {
    if (i % 2 == 0) every_other.push_back(i);
  }
  WallLine line = guessOf(sampling, random);
  const auto support = fitToSupport(points, every_other, scaleOf(sampling), {}, line);
  ASSERT_FALSE(support.empty());
  for (const int i : support) EXPECT_EQ(i % 2, 0);
  line = guessOf(sampling, random);
  EXPECT_TRUE(fitToSupport(points, {}, scaleOf(sampling), {}, line).empty());
}

}  // namespace
