// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/line_arrangement.h>

#include <algorithm>
#include <random>

#include "plans.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;

const Eigen::Vector2d kLow(-3.0, 1.0);
const Eigen::Vector2d kHigh(9.0, 8.0);
constexpr double kTolerance = 1e-9;
// What corners within the tolerance of a line, of a few lines at most, may move by.
constexpr double kSlack = 10.0 * kTolerance;

double boxArea(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return (high - low).prod();
}

double distanceToBorder(const Eigen::Vector2d& p, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high) {
  return std::min((p - low).cwiseAbs().minCoeff(), (high - p).cwiseAbs().minCoeff());
}

// Convex, counter-clockwise, every side on its line or on the border; together the box.
void expectCellsTile(const LineArrangement& plan, const Eigen::Vector2d& low,
                     const Eigen::Vector2d& high, double slack) {
  ASSERT_EQ(plan.at_border.size(), plan.cells.size());
  double sum = 0.0;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const PlanCell& cell = plan.cells[c];
    const std::size_t n = cell.corners.size();
    ASSERT_GE(n, 3U);
    ASSERT_EQ(cell.sides.size(), n);
    EXPECT_GT(cell.area, 0.0);
    EXPECT_NEAR(cell.area, signedArea(ringOf(cell.corners)), slack);
    sum += cell.area;
    bool at_border = false;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector2d& a = cell.corners[i];
      const Eigen::Vector2d& b = cell.corners[(i + 1) % n];
      const Eigen::Vector2d& d = cell.corners[(i + 2) % n];
      EXPECT_GE(crossOf(b - a, d - b), -slack * ((b - a).norm() + (d - b).norm()));
      if (cell.sides[i] < 0) {
        at_border = true;
        EXPECT_LE(distanceToBorder(0.5 * (a + b), low, high), slack);
      } else {
        const PlanLine& line = plan.lines.at(static_cast<std::size_t>(cell.sides[i]));
        EXPECT_LE(std::abs(line.across(a)), slack);
        EXPECT_LE(std::abs(line.across(b)), slack);
      }
    }
    EXPECT_EQ(plan.at_border[c] != 0, at_border);
  }
  EXPECT_NEAR(sum, boxArea(low, high), slack * (high - low).norm());
}

// The edges of each line cover its stretch in the box once, without gaps, each between the cells
// that lie behind and ahead of it. Lines along the border or on another one have none.
void expectEdgesPartition(const LineArrangement& plan, const Eigen::Vector2d& low,
                          const Eigen::Vector2d& high, double slack,
                          const std::vector<std::size_t>& lines_without = {}) {
  const auto by_line_and_start = [](const PlanEdge& a, const PlanEdge& b) {
    return a.line != b.line ? a.line < b.line : a.s_min < b.s_min;
  };
  EXPECT_TRUE(std::is_sorted(plan.edges.begin(), plan.edges.end(), by_line_and_start));
  for (std::size_t l = 0; l < plan.lines.size(); ++l) {
    auto [from, to] = stretchWithin(plan.lines[l], low, high);
    if (std::count(lines_without.begin(), lines_without.end(), l) > 0) to = from;
    double reached = from;
    for (const PlanEdge& edge : plan.edges) {
      if (edge.line != static_cast<int>(l)) continue;
      EXPECT_NEAR(edge.s_min, reached, slack) << "line " << l;
      EXPECT_GT(edge.length(), 0.0);
      reached = edge.s_max;
      for (const auto& [cell, sign] : {std::pair{edge.ahead, 1.0}, std::pair{edge.behind, -1.0}}) {
        const PlanCell& beside = plan.cells.at(static_cast<std::size_t>(cell));
        EXPECT_GT(sign * plan.lines[l].across(middleOf(beside)), 0.0);
        const auto s = [&](const Eigen::Vector2d& p) { return plan.lines[l].tangent().dot(p); };
        double first = 1e300;
        double last = -1e300;
        for (std::size_t i = 0; i < beside.corners.size(); ++i) {
          if (beside.sides[i] != edge.line) continue;
          const double a = s(beside.corners[i]);
          const double b = s(beside.corners[(i + 1) % beside.corners.size()]);
          first = std::min({first, a, b});
          last = std::max({last, a, b});
        }
        EXPECT_LE(first, edge.s_min + slack);
        EXPECT_GE(last, edge.s_max - slack);
      }
    }
    EXPECT_NEAR(reached, std::max(from, to), slack) << "line " << l;
  }
}

// Lines that cross the box; no three of them, nor two and the border, come together.
PlanLines linesInGeneralPosition(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::uniform_real_distribution<double> x(kLow.x(), kHigh.x());
  std::uniform_real_distribution<double> y(kLow.y(), kHigh.y());
  constexpr double kApart = 1e-3;
  PlanLines lines;
  while (lines.size() < count) {
    const PlanLine line = lineThrough({x(random), y(random)}, angle(random));
    bool apart = true;
    std::vector<Eigen::Vector2d> corners = box(kLow.x(), kLow.y(), kHigh.x(), kHigh.y());
    for (const PlanLine& a : lines) {
      if (const auto p = crossingOf(a, line)) {
        apart = apart && distanceToBorder(*p, kLow, kHigh) > kApart;
        for (const PlanLine& b : lines) {
          if (&a != &b) apart = apart && std::abs(b.across(*p)) > kApart;
        }
      }
      for (const PlanLine& b : lines) {
        if (const auto p = crossingOf(a, b)) corners.push_back(*p);
      }
    }
    for (const Eigen::Vector2d& p : corners) apart = apart && std::abs(line.across(p)) > kApart;
    if (apart) lines.push_back(line);
  }
  return lines;
}

std::size_t countCrossings(const PlanLines& lines) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const auto p = crossingOf(lines[i], lines[j]);
      if (p && (p->array() > kLow.array()).all() && (p->array() < kHigh.array()).all()) ++count;
    }
  }
  return count;
}

TEST(LineArrangement, NoLinesLeaveTheBox) {
  const LineArrangement plan = arrangeLines({}, kLow, kHigh, kTolerance);
  ASSERT_EQ(plan.cells.size(), 1U);
  EXPECT_TRUE(plan.edges.empty());
  expectCellsTile(plan, kLow, kHigh, kSlack);
}

TEST(LineArrangement, LinesInGeneralPositionGiveTheNumberOfCellsInClosedForm) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const PlanLines lines = linesInGeneralPosition(static_cast<std::size_t>(round % 16), random);
    const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kTolerance);
    const std::size_t crossings = countCrossings(lines);
    // Each line adds one cell, and one more where it crosses an earlier one.
    EXPECT_EQ(plan.cells.size(), 1 + lines.size() + crossings);
    expectCellsTile(plan, kLow, kHigh, kSlack);
    expectEdgesPartition(plan, kLow, kHigh, kSlack);
    // Euler: V - E + F = 1 without the outer face. Two ends of each line lie on the border.
    const std::size_t vertices = 4 + 2 * lines.size() + crossings;
    std::size_t edges = plan.edges.size();
    for (const PlanCell& cell : plan.cells) {
      edges += static_cast<std::size_t>(std::count(cell.sides.begin(), cell.sides.end(), -1));
    }
    EXPECT_EQ(vertices + plan.cells.size(), edges + 1);
  }
}

TEST(LineArrangement, TheOrderOfTheLinesDoesNotChangeTheCells) {
  std::mt19937 random(2);
  PlanLines lines = linesInGeneralPosition(9, random);
  const auto areasOf = [](const LineArrangement& plan) {
    std::vector<double> areas;
    for (const PlanCell& cell : plan.cells) areas.push_back(cell.area);
    std::sort(areas.begin(), areas.end());
    return areas;
  };
  const std::vector<double> expected = areasOf(arrangeLines(lines, kLow, kHigh, kTolerance));
  for (int round = 0; round < 10; ++round) {
    std::shuffle(lines.begin(), lines.end(), random);
    const std::vector<double> areas = areasOf(arrangeLines(lines, kLow, kHigh, kTolerance));
    ASSERT_EQ(areas.size(), expected.size());
    for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], expected[i], kSlack);
  }
}

TEST(LineArrangement, ParallelLinesGiveStrips) {
  for (const double angle : {0.0, 0.3, M_PI_2, 2.0}) {
    PlanLines lines;
    for (int i = 0; i < 5; ++i) {
      // Every other one with its normal reversed: both sides of a line are alike.
      const Eigen::Vector2d p =
          0.5 * (kLow + kHigh) + 0.4 * (i - 2) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      lines.push_back(lineThrough(p, angle + (i % 2 == 0 ? 0.0 : M_PI)));
    }
    const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kTolerance);
    EXPECT_EQ(plan.cells.size(), 6U);
    EXPECT_EQ(plan.edges.size(), 5U);
    expectCellsTile(plan, kLow, kHigh, kSlack);
    expectEdgesPartition(plan, kLow, kHigh, kSlack);
  }
}

TEST(LineArrangement, AGridGivesItsRectangles) {
  const LineArrangement plan =
      arrangeLines(gridLines({-1, 0, 4}, {2, 3, 5, 7}), kLow, kHigh, kTolerance);
  EXPECT_EQ(plan.cells.size(), 4U * 5U);
  EXPECT_EQ(plan.edges.size(), 3U * 5U + 4U * 4U);
  EXPECT_EQ(std::count(plan.at_border.begin(), plan.at_border.end(), 0), 2 * 3);
  expectCellsTile(plan, kLow, kHigh, kSlack);
  expectEdgesPartition(plan, kLow, kHigh, kSlack);
}

TEST(LineArrangement, ConcurrentLinesGiveTwoSectorsEach) {
  for (const int count : {2, 3, 4, 7}) {
    PlanLines lines;
    for (int i = 0; i < count; ++i)
      lines.push_back(lineThrough({2.1, 4.7}, 0.1 + M_PI * i / count));
    const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kTolerance);
    EXPECT_EQ(plan.cells.size(), 2U * static_cast<std::size_t>(count));
    EXPECT_EQ(plan.edges.size(), 2U * static_cast<std::size_t>(count));
    expectCellsTile(plan, kLow, kHigh, kSlack);
    expectEdgesPartition(plan, kLow, kHigh, kSlack);
  }
}

TEST(LineArrangement, NearlyConcurrentLinesStillTile) {
  // A third line passes the crossing of two others at a distance around the tolerance: whether it
  // counts as through it or not, no area and no stretch of a line may get lost.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-2.0, 2.0);
  std::uniform_real_distribution<double> angle(0.3, M_PI - 0.3);
  constexpr double kCoarse = 1e-4;
  for (int round = 0; round < 200; ++round) {
    const double first = angle(random);
    const double second = first + angle(random);
    const double third = second + angle(random);
    PlanLines lines = {lineThrough({2.0, 4.0}, first), lineThrough({2.0, 4.0}, second),
                       lineThrough({2.0, 4.0}, third)};
    lines[2].offset += kCoarse * std::pow(10.0, exponent(random));
    const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kCoarse);
    const double sine =
        std::min({std::abs(std::sin(second - first)), std::abs(std::sin(third - second)),
                  std::abs(std::sin(third - first))});
    if (sine < 0.25) continue;  // two lines that nearly coincide
    // A corner within the tolerance of a line is 1 / sine times as far from where they cross.
    const double slack = 4.0 * kCoarse / sine;
    EXPECT_GE(plan.cells.size(), 6U);
    EXPECT_LE(plan.cells.size(), 7U);
    expectCellsTile(plan, kLow, kHigh, slack);
    expectEdgesPartition(plan, kLow, kHigh, slack);
  }
}

TEST(LineArrangement, LinesAlongTheBorderOrOutsideCutNothing) {
  PlanLines lines = {{{1.0, 0.0}, kLow.x()},
                     {{0.0, -1.0}, -kHigh.y()},
                     {{1.0, 0.0}, 20.0},
                     {{0.0, 1.0}, kLow.y() + 0.5 * kTolerance},
                     {{1.0, 0.0}, 2.0}};
  const LineArrangement plan = arrangeLines(lines, kLow, kHigh, kTolerance);
  EXPECT_EQ(plan.cells.size(), 2U);
  ASSERT_EQ(plan.edges.size(), 1U);
  EXPECT_EQ(plan.edges[0].line, 4);
  EXPECT_EQ(plan.lines.size(), lines.size());  // line numbers stay those of the input
  expectCellsTile(plan, kLow, kHigh, kSlack);
  expectEdgesPartition(plan, kLow, kHigh, kSlack, {0, 1, 2, 3});
}

TEST(LineArrangement, ALineThroughCornersOfTheBoxCutsItInTriangles) {
  const Eigen::Vector2d diagonal = kHigh - kLow;
  const PlanLine line = lineThrough(kLow, std::atan2(diagonal.x(), -diagonal.y()));
  const LineArrangement plan = arrangeLines({line}, kLow, kHigh, kTolerance);
  ASSERT_EQ(plan.cells.size(), 2U);
  for (const PlanCell& cell : plan.cells) {
    EXPECT_EQ(cell.corners.size(), 3U);
    EXPECT_NEAR(cell.area, 0.5 * boxArea(kLow, kHigh), kSlack);
  }
  expectEdgesPartition(plan, kLow, kHigh, kSlack);
}

TEST(LineArrangement, DuplicateLinesCutOnce) {
  std::mt19937 random(4);
  PlanLines lines = linesInGeneralPosition(6, random);
  const LineArrangement once = arrangeLines(lines, kLow, kHigh, kTolerance);
  lines.push_back(lines[2]);
  lines.push_back({-lines[4].normal, -lines[4].offset});  // the same line from its other side
  const LineArrangement twice = arrangeLines(lines, kLow, kHigh, kTolerance);
  EXPECT_EQ(twice.cells.size(), once.cells.size());
  EXPECT_EQ(twice.edges.size(), once.edges.size());
  for (const PlanEdge& edge : twice.edges) EXPECT_LT(edge.line, 6);
  expectCellsTile(twice, kLow, kHigh, kSlack);
  expectEdgesPartition(twice, kLow, kHigh, kSlack, {6, 7});
}

TEST(LineArrangement, WorksFarFromTheOrigin) {
  // Doubles at 1e6 are good to 1e-10; crossings at small angles to some times that.
  std::mt19937 random(5);
  const Eigen::Vector2d shift(1e6, -2e6);
  PlanLines lines = linesInGeneralPosition(10, random);
  const std::size_t expected = 1 + lines.size() + countCrossings(lines);
  for (PlanLine& line : lines) line.offset += line.normal.dot(shift);
  constexpr double kCoarse = 1e-6;
  const LineArrangement plan = arrangeLines(lines, kLow + shift, kHigh + shift, kCoarse);
  EXPECT_EQ(plan.cells.size(), expected);
  expectCellsTile(plan, kLow + shift, kHigh + shift, 10.0 * kCoarse);
  expectEdgesPartition(plan, kLow + shift, kHigh + shift, 10.0 * kCoarse);
}

}  // namespace
