// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/line_refit.h>

#include <cmath>

#include "plans.h"
#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::CellBlock;
using detail::refitUsedLines;
using detail::WallEvidence;

constexpr double kBin = 0.5;

// Five deviations, and a tenth for Tukey's weights and the cut at four deviations.
double boundOf(double length, const WallSampling& sampling) {
  return 5.5 * deviationOf(length, sampling).offset;
}

// The heights of a block of whole walls, and its cells: those within the box.
CellBlock blockOf(const LineArrangement& plan, double x0, double x1, double y0, double y1,
                  std::size_t first_bin, std::size_t last_bin) {
  CellBlock block;
  block.first_bin = first_bin;
  block.last_bin = last_bin;
  for (const PlanCell& cell : plan.cells) {
    const Eigen::Vector2d p = middleOf(cell);
    block.inside.push_back(p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1 ? 1 : 0);
  }
  return block;
}

WallEvidence heightsOf(std::size_t num_bins) {
  WallEvidence evidence;
  evidence.bin = kBin;
  evidence.num_bins = num_bins;
  return evidence;
}

LineArrangement arranged(const PlanLines& lines) {
  return arrangeLines(lines, {-6, -6}, {18, 14}, 1e-9);
}

// The box of 12 x 8 with every line off by this much, outwards or inwards by turns.
PlanLines boxLines(double off) { return gridLines({0 + off, 12 + off}, {0 - off, 8 + off}); }

TEST(LineRefit, LinesThatWereFoundBesideTheirPointsMoveOntoThem) {
  const WallSampling sampling;
  const std::size_t bins = 8;
  for (const double off : {-1.5, 0.5, 1.5}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const LineArrangement plan = arranged(boxLines(off * sampling.noise));
      const auto lines =
          refitUsedLines(plan, heightsOf(bins), {blockOf(plan, 0, 12, 0, 8, 0, bins)},
                         wallsOf(box(0, 0, 12, 8), sampling, seed), sampling.noise);
      ASSERT_EQ(lines.size(), 4U);
      for (std::size_t l = 0; l < 4; ++l) {
        EXPECT_EQ(lines[l].normal, plan.lines[l].normal);
        const double truth = std::vector<double>{0, 12, 0, 8}[l];
        EXPECT_NEAR(lines[l].offset, truth, boundOf(l < 2 ? 8.0 : 12.0, sampling)) << seed;
      }
    }
  }
}

TEST(LineRefit, AWallSeenFromTheOtherSideOfItsLineIsFittedAlike) {
  const WallSampling sampling;
  const std::size_t bins = 8;
  PlanLines lines = boxLines(sampling.noise);
  for (PlanLine& line : lines) line = {-line.normal, -line.offset};
  const LineArrangement plan = arranged(lines);
  const auto refitted = refitUsedLines(plan, heightsOf(bins), {blockOf(plan, 0, 12, 0, 8, 0, bins)},
                                       wallsOf(box(0, 0, 12, 8), sampling, 1), sampling.noise);
  ASSERT_EQ(refitted.size(), 4U);
  for (std::size_t l = 0; l < 4; ++l) {
    const double truth = std::vector<double>{0, -12, 0, -8}[l];
    EXPECT_NEAR(refitted[l].offset, truth, boundOf(l < 2 ? 8.0 : 12.0, sampling));
  }
}

// A second wall near the line y = 0 of the box, two deviations behind it, and what becomes of the
// line. The heights go on above the block.
double offsetBeside(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z_min,
                    double z_max) {
  const WallSampling sampling;
  const std::size_t bins = 8;
  const LineArrangement plan = arranged(boxLines(0.0));
  std::vector<WallPoint> points = wallsOf(box(0, 0, 12, 8), sampling, 1);
  WallSampling other = sampling;
  other.z_min = z_min;
  other.z_max = z_max;
  std::mt19937 random(2);
  const Eigen::Vector2d shift(0.0, 2.0 * sampling.noise);
  addWall(from + shift, to + shift, other, random, points);
  return refitUsedLines(plan, heightsOf(3 * bins), {blockOf(plan, 0, 12, 0, 8, 0, bins)}, points,
                        sampling.noise)[2]
      .offset;
}

TEST(LineRefit, WallsThatDoNotBoundTheInsideThereDoNotPull) {
  const double bound = boundOf(12.0, WallSampling());
  EXPECT_NEAR(offsetBeside({12.5, 0}, {17, 0}, 0.0, 4.0), 0.0, bound);  // further on
  EXPECT_NEAR(offsetBeside({-5, 0}, {-0.5, 0}, 0.0, 4.0), 0.0, bound);
  EXPECT_NEAR(offsetBeside({0, 0}, {12, 0}, 4.5, 9.0), 0.0, bound);  // above the block
  EXPECT_NEAR(offsetBeside({12, 0}, {0, 0}, 0.0, 4.0), 0.0, bound);  // facing the other way
  // Where they do, they pull: half of the points lie two deviations off, all of them one.
  EXPECT_GT(offsetBeside({0, 0}, {12, 0}, 0.0, 4.0), 0.5 * WallSampling().noise);
}

TEST(LineRefit, OfTwoLinesTheOneThatBoundsTheBlockTakesItsPoints) {
  // A storey set back by five deviations: its wall and the one below have lines of their own.
  const WallSampling lower;
  WallSampling upper = lower;
  upper.z_min = lower.z_max;
  upper.z_max = lower.z_max + 4.0;
  const double setback = 5.0 * lower.noise;
  PlanLines lines = boxLines(0.0);
  lines[2].offset += lower.noise;  // found with points of both
  lines.push_back({{0.0, 1.0}, setback - lower.noise});
  const LineArrangement plan = arranged(lines);
  std::vector<WallPoint> points = wallsOf(box(0, 0, 12, 8), lower, 3);
  for (const WallPoint& p : wallsOf(box(0, setback, 12, 8), upper, 4)) points.push_back(p);
  const CellBlock below = blockOf(plan, 0, 12, 0, 8, 0, 8);
  const CellBlock above = blockOf(plan, 0, 12, lines[4].offset, 8, 8, 16);
  const auto refitted = refitUsedLines(plan, heightsOf(16), {below, above}, points, lower.noise);
  ASSERT_EQ(refitted.size(), 5U);
  EXPECT_NEAR(refitted[2].offset, 0.0, boundOf(12.0, lower));
  EXPECT_NEAR(refitted[4].offset, setback, boundOf(12.0, lower));
}

TEST(LineRefit, LinesThatBoundNothingGoAndThoseWithoutPointsStay) {
  const WallSampling sampling;
  const std::size_t bins = 8;
  PlanLines lines = boxLines(0.0);
  lines.insert(lines.begin() + 1, PlanLine{{1.0, 0.0}, 6.0});  // through the inside
  const LineArrangement plan = arranged(lines);
  std::mt19937 random(5);
  std::vector<WallPoint> points;
  addWall({0, 0}, {12, 0}, sampling, random, points);
  const auto refitted = refitUsedLines(plan, heightsOf(bins), {blockOf(plan, 0, 12, 0, 8, 0, bins)},
                                       points, sampling.noise);
  ASSERT_EQ(refitted.size(), 4U);
  EXPECT_EQ(refitted[0].offset, 0.0);
  EXPECT_EQ(refitted[1].offset, 12.0);
  EXPECT_NEAR(refitted[2].offset, 0.0, boundOf(12.0, sampling));
  EXPECT_EQ(refitted[3].offset, 8.0);
  EXPECT_TRUE(refitUsedLines(plan, heightsOf(bins), {}, points, sampling.noise).empty());
}

}  // namespace
