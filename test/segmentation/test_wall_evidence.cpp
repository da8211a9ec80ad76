// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/wall_evidence.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plans.h"
#include "wall_samples.h"

namespace {

using namespace storey;
using namespace storey::test;
using detail::arrangeLines;
using detail::findLevels;
using detail::gatherEvidence;
using detail::WallEvidence;

constexpr double kNoise = 0.05;
const WallScale kScale{kNoise, 40.0};

LineArrangement gridPlan() {
  // The third line of x has its normal reversed.
  PlanLines lines = gridLines({2, 5}, {1, 4, 8});
  lines.push_back({{-1.0, 0.0}, -7.0});
  return arrangeLines(lines, {0, 0}, {10, 10}, 1e-6);
}

Eigen::Vector2d pointOn(const LineArrangement& plan, const PlanEdge& edge, double s, double off) {
  const PlanLine& line = plan.lines[static_cast<std::size_t>(edge.line)];
  return (line.offset + off) * line.normal + s * line.tangent();
}

TEST(GatherEvidence, CountsArePointByPointThoseOfTheEdgesTheyWereDrawnOn) {
  const LineArrangement plan = gridPlan();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  struct Drawn {
    std::size_t edge;
    bool ahead;
    double z;
  };
  std::vector<Drawn> drawn;
  std::vector<WallPoint> points;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t e = random() % plan.edges.size();
    const PlanEdge& edge = plan.edges[e];
    // Clear of the edge's ends, and within a deviation of the line: whatever the gate.
    const double s = edge.s_min + 10.0 * kNoise + unit(random) * (edge.length() - 20.0 * kNoise);
    const Eigen::Vector2d normal = plan.lines[static_cast<std::size_t>(edge.line)].normal;
    const bool ahead = unit(random) < 0.5;
    const double turn = 0.7 * (2.0 * unit(random) - 1.0);
    drawn.push_back({e, ahead, 3.0 + 6.0 * unit(random)});
    points.push_back({pointOn(plan, edge, s, kNoise * (2.0 * unit(random) - 1.0)), drawn.back().z,
                      Eigen::Rotation2Dd(turn) * (ahead ? normal : -normal)});
  }
  const WallEvidence evidence = gatherEvidence(plan, points, kScale);
  const std::size_t slots = plan.edges.size() * evidence.num_bins;
  ASSERT_GT(evidence.num_bins, 1U);
  ASSERT_EQ(evidence.ahead.size(), slots);
  ASSERT_EQ(evidence.behind.size(), slots);
  std::vector<float> ahead(slots, 0.0f);
  std::vector<float> behind(slots, 0.0f);
  for (const Drawn& d : drawn) {
    std::size_t bin = 0;
    while (bin + 1 < evidence.num_bins && d.z >= evidence.heightOf(bin + 1)) ++bin;
    EXPECT_GE(d.z, evidence.heightOf(bin));
    EXPECT_LE(d.z, evidence.heightOf(bin + 1));
    (d.ahead ? ahead : behind)[d.edge * evidence.num_bins + bin] += 1.0f;
  }
  EXPECT_EQ(evidence.ahead, ahead);
  EXPECT_EQ(evidence.behind, behind);
}

TEST(GatherEvidence, PointsOffAllLinesOrAcrossThemCountNowhere) {
  const LineArrangement plan = gridPlan();
  std::vector<WallPoint> points;
  for (const PlanEdge& edge : plan.edges) {
    const PlanLine& line = plan.lines[static_cast<std::size_t>(edge.line)];
    const double s = 0.5 * (edge.s_min + edge.s_max);
    points.push_back({pointOn(plan, edge, s, 8.0 * kNoise), 1.0, line.normal});
    points.push_back({pointOn(plan, edge, s, 0.0), 2.0, line.tangent()});
  }
  const WallEvidence evidence = gatherEvidence(plan, points, kScale);
  for (const float count : evidence.ahead) EXPECT_EQ(count, 0.0f);
  for (const float count : evidence.behind) EXPECT_EQ(count, 0.0f);
}

TEST(GatherEvidence, OfTwoLinesTheNearerOneTakesThePoint) {
  const LineArrangement plan =
      arrangeLines(gridLines({5.0, 5.0 + 2.0 * kNoise}, {}), {0, 0}, {10, 10}, 1e-6);
  ASSERT_EQ(plan.edges.size(), 2U);
  const std::vector<WallPoint> points = {{{5.0 + 0.9 * kNoise, 5.0}, 0.0, {1.0, 0.0}},
                                         {{5.0 + 1.1 * kNoise, 5.0}, 0.0, {1.0, 0.0}},
                                         {{5.0 + 1.2 * kNoise, 5.0}, 0.0, {-1.0, 0.0}}};
  const WallEvidence evidence = gatherEvidence(plan, points, kScale);
  ASSERT_EQ(evidence.num_bins, 1U);
  EXPECT_EQ(evidence.ahead, (std::vector<float>{1.0f, 1.0f}));
  EXPECT_EQ(evidence.behind, (std::vector<float>{0.0f, 1.0f}));
}

TEST(GatherEvidence, TheAreaSeenIsThatOfTheWallsSampled) {
  // A box; of its walls the first is whole, the second has points on its first half, the third has
  // half of the points, the fourth none. Behind the box, on the same line, one faces the other way.
  const LineArrangement plan =
      arrangeLines(gridLines({2, 14, 26}, {2, 14}), {0, 0}, {30, 16}, 1e-6);
  const WallSampling sampling;
  WallSampling thin = sampling;
  thin.density *= 0.5;
  std::mt19937 random(2);
  std::vector<WallPoint> points;
  addWall({2, 2}, {14, 2}, sampling, random, points);
  addWall({14, 2}, {14, 8}, sampling, random, points);
  addWall({14, 14}, {2, 14}, thin, random, points);
  addWall({26, 2}, {14, 2}, sampling, random, points);
  const WallEvidence evidence = gatherEvidence(plan, points, scaleOf(sampling));
  const auto shareAt = [&](const Eigen::Vector2d& p) {
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
      const PlanLine& line = plan.lines[static_cast<std::size_t>(plan.edges[e].line)];
      const double s = line.tangent().dot(p);
      if (std::abs(line.across(p)) > 1e-6 || s < plan.edges[e].s_min || s > plan.edges[e].s_max) {
        continue;
      }
      double seen = 0.0;
      const double area = plan.edges[e].length() * evidence.bin;
      for (std::size_t b = 0; b < evidence.num_bins; ++b) {
        const double here = static_cast<double>(evidence.seen[e * evidence.num_bins + b]);
        EXPECT_LE(std::abs(here), area * (1.0 + 1e-6));
        seen += here;
      }
      return seen / (plan.edges[e].length() * (sampling.z_max - sampling.z_min));
    }
    ADD_FAILURE() << "no edge at " << p.transpose();
    return 0.0;
  };
  // Lines have their normals along +x and +y, the outside of the box is ahead of two of them. Of
  // six points a tile half are enough: by Poisson 3 % is lost, of three points a tile 22 %. A tile
  // is a twelfth of a wall, the bin at the top is not full.
  EXPECT_NEAR(shareAt({8, 2}), -1.0, 0.1);
  EXPECT_NEAR(shareAt({14, 8}), 0.5, 0.1);
  EXPECT_NEAR(shareAt({8, 14}), 1.0, 0.3);
  EXPECT_NEAR(shareAt({2, 8}), 0.0, 0.02);
  EXPECT_NEAR(shareAt({20, 2}), 1.0, 0.1);
}

TEST(GatherEvidence, NothingGivesNothing) {
  EXPECT_EQ(gatherEvidence(gridPlan(), {}, kScale).num_bins, 0U);
  EXPECT_TRUE(findLevels({}).empty());
}

// --- levels -------------------------------------------------------------------------------------

WallEvidence evidenceOf(const std::vector<std::vector<double>>& means, std::mt19937& random) {
  WallEvidence evidence;
  evidence.bin = 0.2;
  evidence.num_bins = means.front().size();
  for (const std::vector<double>& edge : means) {
    for (const double mean : edge) {
      std::poisson_distribution<int> ahead(std::max(mean, 1e-9));
      std::poisson_distribution<int> behind(0.1 * std::max(mean, 1e-9));
      evidence.ahead.push_back(static_cast<float>(ahead(random)));
      evidence.behind.push_back(static_cast<float>(behind(random)));
    }
  }
  return evidence;
}

// Log-likelihood, up to a constant, of Poisson counts with a mean of their own for each edge in
// each range: sum over ranges and edges of n ln(n / length).
double likelihoodOf(const WallEvidence& evidence, const std::vector<std::size_t>& levels) {
  double sum = 0.0;
  for (std::size_t slot = 0; slot < evidence.ahead.size(); slot += evidence.num_bins) {
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      double count = 0.0;
      for (std::size_t b = levels[k]; b < levels[k + 1]; ++b) {
        count += evidence.ahead[slot + b] + evidence.behind[slot + b];
      }
      if (count > 0.0) {
        sum += count * std::log(count / static_cast<double>(levels[k + 1] - levels[k]));
      }
    }
  }
  return sum;
}

TEST(FindLevels, NoPartitionIntoAsManyRangesIsLikelier) {
  // A change costs the same wherever it is, so that the optimum is the likeliest of all partitions
  // with its number of ranges, whatever the cost is. All partitions of 9 bins: 256.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> mean(5.0, 40.0);
  constexpr std::size_t kBins = 9;
  std::vector<int> seen(kBins + 1, 0);
  for (int round = 0; round < 60; ++round) {
    std::vector<std::vector<double>> means(1 + random() % 4, std::vector<double>(kBins));
    const std::size_t step = 1 + random() % 5;
    for (auto& edge : means) {
      double current = mean(random);
      for (std::size_t b = 0; b < kBins; ++b) {
        if (b % step == 0) current = mean(random);
        edge[b] = current;
      }
    }
    const WallEvidence evidence = evidenceOf(means, random);
    const std::vector<std::size_t> found = findLevels(evidence);
    ASSERT_GE(found.size(), 2U);
    EXPECT_EQ(found.front(), 0U);
    EXPECT_EQ(found.back(), kBins);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    ++seen[found.size() - 1];
    double best = -1e300;
    for (unsigned cuts = 0; cuts < 1U << (kBins - 1); ++cuts) {
      std::vector<std::size_t> levels = {0};
      for (std::size_t b = 1; b < kBins; ++b) {
        if ((cuts >> (b - 1) & 1U) != 0) levels.push_back(b);
      }
      levels.push_back(kBins);
      if (levels.size() == found.size()) best = std::max(best, likelihoodOf(evidence, levels));
    }
    EXPECT_NEAR(likelihoodOf(evidence, found), best, 1e-9 * std::abs(best));
  }
  EXPECT_GE(std::count_if(seen.begin(), seen.end(), [](int n) { return n > 0; }), 3)
      << "partitions of one or two sizes only: the test tests little";
}

TEST(FindLevels, ChangesThatAreClearAreFoundWhereTheyAre) {
  // Six walls of 25 points a bin, 40 bins. At 12 two of them end, at 27 another one starts. A bin
  // more or less costs 25 ln 25 or so against the noise of the others: far beyond chance.
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::vector<double>> means(6, std::vector<double>(40, 25.0));
    for (std::size_t b = 0; b < 40; ++b) {
      if (b >= 12) means[0][b] = means[1][b] = 0.0;
      if (b < 27) means[2][b] = 0.0;
    }
    EXPECT_EQ(findLevels(evidenceOf(means, random)), (std::vector<std::size_t>{0, 12, 27, 40}));
  }
}

TEST(FindLevels, ConstantDensitiesHaveNoChange) {
  // The gain of a false change is half a chi-square of as many degrees of freedom as there are
  // edges, the greatest of 39 places: a threshold at the noise of all edges lets few pass.
  std::mt19937 random(4);
  int changed = 0;
  for (int round = 0; round < 50; ++round) {
    const std::vector<std::vector<double>> means(1 + random() % 20, std::vector<double>(40, 20.0));
    if (findLevels(evidenceOf(means, random)).size() > 2) ++changed;
  }
  EXPECT_LE(changed, 2);
}

TEST(FindLevels, EmptyEdgesChangeNothing) {
  std::mt19937 random(5);
  std::vector<std::vector<double>> means(3, std::vector<double>(20, 25.0));
  for (std::size_t b = 8; b < 20; ++b) means[1][b] = 0.0;
  WallEvidence evidence = evidenceOf(means, random);
  const std::vector<std::size_t> expected = findLevels(evidence);
  EXPECT_EQ(expected, (std::vector<std::size_t>{0, 8, 20}));
  evidence.ahead.resize(100 * evidence.num_bins, 0.0f);
  evidence.behind.resize(100 * evidence.num_bins, 0.0f);
  EXPECT_EQ(findLevels(evidence), expected);
}

}  // namespace
