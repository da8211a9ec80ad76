// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_ends.h>
#include <storey/segmentation/detail/wall_hypotheses.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::findWallEnds;
using detail::findWallLines;
using detail::HeightDensity;
using detail::hypothesiseLines;
using detail::PlanLine;
using detail::WallEnd;
using detail::WallHypotheses;

constexpr double kMinArea = 2.0;
const Corners kBox = box(0.0, 0.0, 16.0, 10.0);
const Corners kFarBox = box(-10.0, 20.0, 30.0, 40.0);
// With a corner of 135 degrees and one of 45.
const Corners kOblique = {{0.0, 0.0}, {20.0, 0.0}, {12.0, 8.0}, {3.0, 8.0}, {0.0, 5.0}};

WallSampling sampling() {
  WallSampling s;
  s.z_max = 10.0;
  return s;
}

std::vector<WallPoint> wallsWithout(const Corners& ring, const std::vector<std::size_t>& missing,
                                    unsigned seed) {
  std::mt19937 random(seed);
  std::vector<WallPoint> points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::find(missing.begin(), missing.end(), i) != missing.end()) continue;
    addWall(ring[i], ring[(i + 1) % ring.size()], sampling(), random, points);
  }
  return points;
}

void remove(std::vector<WallPoint>& points, const std::function<bool(const WallPoint&)>& goes) {
  points.erase(std::remove_if(points.begin(), points.end(), goes), points.end());
}

WallHypotheses allFor(const std::vector<WallPoint>& points, double corner_gap = 0.0) {
  const WallScale scale = scaleOf(sampling());
  return hypothesiseLines(findWallLines(points, scale, {kMinArea}), points, scale,
                          HeightDensity(points, scale), corner_gap);
}

std::vector<PlanLine> hypothesesFor(const std::vector<WallPoint>& points, double corner_gap = 0.0) {
  return allFor(points, corner_gap).lines;
}

// An end is known to kEndReach, and where only one of two is, the line goes through that one.
void expectAlong(const PlanLine& line, const Corners& ring, std::size_t i) {
  const double reach = detail::kEndReach * sampling().noise;
  EXPECT_TRUE(line.hypothetical);
  EXPECT_LT(std::abs(line.across(ring[i])), reach);
  EXPECT_LT(std::abs(line.across(ring[(i + 1) % ring.size()])), reach);
}

TEST(WallHypotheses, ThereAreNoneWhereAllWallsMeet) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    EXPECT_TRUE(hypothesesFor(wallsWithout(kBox, {}, seed)).empty()) << seed;
    EXPECT_TRUE(hypothesesFor(wallsWithout(kOblique, {}, seed)).empty()) << seed;
  }
}

TEST(WallHypotheses, ThereAreNoneWherePointsOfCornersWereLeftOut) {
  const double gap = 10.0 * sampling().noise;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::vector<WallPoint> points = wallsWithout(kOblique, {}, seed);
    remove(points, [&](const WallPoint& p) {
      std::vector<double> distances;
      for (std::size_t i = 0; i < kOblique.size(); ++i) {
        const Eigen::Vector2d& a = kOblique[i];
        const Eigen::Vector2d ab = kOblique[(i + 1) % kOblique.size()] - a;
        const double s = std::clamp((p.position - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        distances.push_back((p.position - a - s * ab).norm());
      }
      std::sort(distances.begin(), distances.end());
      return distances[1] < gap;
    });
    EXPECT_TRUE(hypothesesFor(points, gap).empty()) << seed;
    EXPECT_FALSE(hypothesesFor(points, 0.0).empty()) << seed;
  }
}

TEST(WallHypotheses, AWallOfAKnownDirectionJoinsItsNeighbours) {
  for (std::size_t missing = 0; missing < kBox.size(); ++missing) {
    const auto lines = hypothesesFor(wallsWithout(kBox, {missing}, static_cast<unsigned>(missing)));
    ASSERT_EQ(lines.size(), 1U) << missing;
    expectAlong(lines.front(), kBox, missing);
  }
}

// Whether any of the lines passes all of the places.
bool onePasses(const std::vector<PlanLine>& lines, const Corners& places) {
  return std::any_of(lines.begin(), lines.end(), [&](const PlanLine& line) {
    return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector2d& place) {
      return std::abs(line.across(place)) < detail::kEndReach * sampling().noise;
    });
  });
}

TEST(WallHypotheses, TheEndsOfBothNeighboursAreNamed) {
  for (std::size_t missing = 0; missing < kBox.size(); ++missing) {
    const std::vector<WallEnd> ends =
        allFor(wallsWithout(kBox, {missing}, static_cast<unsigned>(missing))).ends;
    ASSERT_EQ(ends.size(), 2U) << missing;
    for (const std::size_t c : {missing, (missing + 1) % kBox.size()}) {
      const Eigen::Vector2d inwards = c == missing ? kBox[(c + 3) % 4] : kBox[(c + 1) % 4];
      const Eigen::Vector2d onward = (kBox[c] - inwards).normalized();
      EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), [&](const WallEnd& end) {
        return (end.place - kBox[c]).norm() < detail::kEndReach * sampling().noise &&
               end.onward.dot(onward) > 0.99;
      })) << missing;
    }
  }
}

TEST(WallHypotheses, AWallOfItsOwnDirectionJoinsItsNeighbours) {
  const Corners chamfered = {{0.0, 0.0}, {16.0, 0.0}, {16.0, 6.0}, {9.0, 10.0}, {0.0, 10.0}};
  EXPECT_TRUE(
      onePasses(hypothesesFor(wallsWithout(chamfered, {2}, 5)), {chamfered[2], chamfered[3]}));
}

TEST(WallHypotheses, TwoMissingWallsMayMeetOrBeCutShort) {
  // Two walls of a box are missing, and no known direction joins the two ends that are left: the
  // diagonal does, and so do lines through either that meet where the corner was.
  const auto lines = hypothesesFor(wallsWithout(kBox, {1, 2}, 6));
  EXPECT_TRUE(onePasses(lines, {kBox[1], kBox[3]}));
  EXPECT_TRUE(onePasses(lines, {kBox[1], kBox[2]}));
  EXPECT_TRUE(onePasses(lines, {kBox[2], kBox[3]}));
}

TEST(WallHypotheses, AnEndAloneGetsLinesOfTheOtherDirections) {
  // A wall by itself, above others far away that have the direction of what is missing: it has two
  // ends, but no wall joins the ends of one wall.
  std::vector<WallPoint> points;
  std::mt19937 random(8);
  WallSampling below = sampling();
  WallSampling above = sampling();
  below.z_max = 5.0;
  above.z_min = 6.0;
  above.z_max = 16.0;
  addWall({0.0, 0.0}, {12.0, 0.0}, above, random, points);
  for (std::size_t i = 0; i < kBox.size(); ++i) {
    addWall(kFarBox[i], kFarBox[(i + 1) % kBox.size()], below, random, points);
  }
  const std::vector<PlanLine> lines = hypothesesFor(points);
  ASSERT_EQ(lines.size(), 2U);
  for (const PlanLine& line : lines) EXPECT_GT(std::abs(line.normal.x()), 0.999);
  const double reach = detail::kEndReach * sampling().noise;
  const Eigen::Vector2d end(0.0, 0.0);
  EXPECT_LT(std::min(std::abs(lines[0].across(end)), std::abs(lines[1].across(end))), reach);
}

TEST(WallHypotheses, EachOfManyEndsAloneGetsALineBeforeAnyHasTwo) {
  // An octagon below, and above it walls by themselves, each at heights of its own so that none
  // joins another: 16 ends, each with three directions to go on in, more than there are lines.
  std::vector<WallPoint> points;
  std::mt19937 random(10);
  WallSampling heights = sampling();
  heights.z_max = 5.0;
  Corners octagon;
  for (int i = 0; i < 8; ++i) {
    octagon.emplace_back(20.0 * std::cos(0.25 * M_PI * (i + 0.5)),
                         20.0 * std::sin(0.25 * M_PI * (i + 0.5)));
  }
  for (std::size_t i = 0; i < octagon.size(); ++i) {
    addWall(octagon[i], octagon[(i + 1) % octagon.size()], heights, random, points);
  }
  Corners ends;
  for (int i = 0; i < 8; ++i) {
    heights.z_min = 6.0 + 6.0 * i;
    heights.z_max = heights.z_min + 5.5;
    ends.emplace_back(0.3 * i * i - 10.0, 2.1 * i - 7.0);
    ends.emplace_back(ends.back() + Eigen::Vector2d(8.0 + 0.7 * i, 0.0));
    addWall(ends[ends.size() - 2], ends.back(), heights, random, points);
  }
  const std::vector<PlanLine> lines = hypothesesFor(points);
  EXPECT_EQ(lines.size(), 30U);
  for (const Eigen::Vector2d& end : ends) {
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const PlanLine& line) {
      return std::abs(line.across(end)) < detail::kEndReach * sampling().noise;
    })) << end.transpose();
  }
}

TEST(WallHypotheses, HolesWithoutUprightOutlinesMakeNone) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::vector<WallPoint> points = wallsWithout(kBox, {}, seed);
    remove(points, [](const WallPoint& p) {
      return p.normal.y() < -0.7 && std::abs(p.position.x() - 8.0) + std::abs(p.z - 5.0) < 3.0;
    });
    EXPECT_TRUE(hypothesesFor(points).empty()) << seed;
  }
}

TEST(WallEnds, AreWhereWallsEndAndOverWhatHeight) {
  WallSampling tall = sampling();
  std::vector<WallPoint> points;
  std::mt19937 random(9);
  addWall({2.0, 0.0}, {12.0, 0.0}, tall, random, points);
  remove(points, [](const WallPoint& p) { return p.z > 6.0 && p.position.x() > 8.0; });
  const WallScale scale = scaleOf(tall);
  std::vector<WallEnd> ends = findWallEnds(findWallLines(points, scale, {kMinArea}), points, scale,
                                           HeightDensity(points, scale));
  std::sort(ends.begin(), ends.end(),
            [](const WallEnd& a, const WallEnd& b) { return a.place.x() < b.place.x(); });
  const double reach = detail::kEndReach * tall.noise;
  const double bands = 20.0 * tall.noise;  // two: one of them is at the change
  const std::vector<std::array<double, 3>> expected = {
      {2.0, 0.0, 10.0}, {8.0, 6.0, 10.0}, {12.0, 0.0, 6.0}};  // place, heights
  ASSERT_EQ(ends.size(), expected.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR(ends[i].place.x(), expected[i][0], reach);
    EXPECT_NEAR(ends[i].z_min, expected[i][1], bands);
    EXPECT_NEAR(ends[i].z_max, expected[i][2], bands);
  }
}

TEST(WallEnds, OfNothingThereAreNone) {
  const WallScale scale = scaleOf(sampling());
  EXPECT_TRUE(findWallEnds({}, {}, scale, HeightDensity({}, scale)).empty());
  EXPECT_TRUE(hypothesesFor({}).empty());
}

}  // namespace
