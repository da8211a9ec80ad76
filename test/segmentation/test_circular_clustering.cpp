// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/circular_clustering.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using storey::detail::AngleCluster;
using storey::detail::AngleHistogram;

constexpr double kDegree = M_PI / 180.0;

double angleBetween(double a, double b) { return std::abs(storey::detail::wrapAngle(a - b)); }

// The procedure as the paper has it: all pairs, again and again.
std::vector<double> mergeLiterally(std::vector<AngleCluster> clusters, double merge_angle) {
  while (clusters.size() > 1) {
    std::size_t first = 0;
    std::size_t second = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      for (std::size_t j = i + 1; j < clusters.size(); ++j) {
        const double apart = angleBetween(clusters[i].center, clusters[j].center);
        if (apart < least) {
          least = apart;
          first = i;
          second = j;
        }
      }
    }
    if (least > merge_angle) {
      break;
    }
    AngleCluster& merged = clusters[first];
    const AngleCluster other = clusters[second];
    const double turn = storey::detail::wrapAngle(other.center - merged.center);
    merged.weight += other.weight;
    merged.center = storey::detail::wrapAngle(merged.center + turn * other.weight / merged.weight);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
  std::vector<double> centers;
  for (const AngleCluster& cluster : clusters) {
    centers.push_back(cluster.center);
  }
  std::sort(centers.begin(), centers.end());
  return centers;
}

TEST(MergeOnCircle, EqualsTheLiteralProcedure) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::uniform_real_distribution<double> merge_angle(1.0 * kDegree, 60.0 * kDegree);
  for (int round = 0; round < 100; ++round) {
    std::vector<AngleCluster> points(60);
    for (AngleCluster& point : points) {
      point = {angle(random), 1.0};
    }
    std::sort(points.begin(), points.end(),
              [](const AngleCluster& a, const AngleCluster& b) { return a.center < b.center; });
    const double limit = merge_angle(random);
    const std::vector<double> expected = mergeLiterally(points, limit);
    const std::vector<AngleCluster> found = storey::detail::mergeOnCircle(points, limit);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].center, expected[i], 1e-9);
    }
  }
}

TEST(MergeOnCircle, HistogramEqualsTheLiteralProcedureUpToABin) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 2.0 * kDegree);
  std::uniform_real_distribution<double> turn(-M_PI, M_PI);
  for (int round = 0; round < 20; ++round) {
    const double start = turn(random);
    AngleHistogram histogram;
    std::vector<AngleCluster> points;
    for (int i = 0; i < 250; ++i) {
      const double angle =
          storey::detail::wrapAngle(start + 72.0 * kDegree * (i % 5) + noise(random));
      histogram.add(angle);
      points.push_back({angle, 1.0});
    }
    // 5 walls of +-8 degrees, 72 apart: whole walls merge before any two of them
    const std::vector<double> expected = mergeLiterally(points, 25.0 * kDegree);
    const auto found = storey::detail::mergeOnCircle(histogram.clusters(), 25.0 * kDegree);
    ASSERT_EQ(expected.size(), 5U);
    ASSERT_EQ(found.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_LE(angleBetween(found[i].center, expected[i]), AngleHistogram::kBinWidth);
    }
  }
}

TEST(AngleHistogram, SpreadOfOneWallAmongOthers) {
  for (const double degrees : {1.0, 3.0, 8.0}) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, degrees * kDegree);
    AngleHistogram histogram;
    for (int i = 0; i < 100000; ++i) {
      histogram.add(60.0 * kDegree * (i % 6) + noise(random));
    }
    // where the curve falls to a tenth it is steep: 10 % of noise there move it by 2 %; the two
    // neighbours at 60 degrees add less than 1 %
    EXPECT_NEAR(storey::detail::modeSpread(histogram), degrees * kDegree, 0.1 * degrees * kDegree);
  }
  EXPECT_EQ(storey::detail::modeSpread(AngleHistogram()), 0.0);
}

TEST(RefineCenters, TailsOfOneSideDoNotPull) {
  // at corners averages of normals lie between two directions: here on one side of the wall only
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 2.0 * kDegree);
  std::uniform_real_distribution<double> corner(6.0 * kDegree, 60.0 * kDegree);
  AngleHistogram histogram;
  double sum = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double angle = i % 10 == 0 ? corner(random) : noise(random);
    histogram.add(angle);
    sum += angle;
  }
  EXPECT_GT(sum / 10000, 3.0 * kDegree);  // the plain mean: a tenth of 33 degrees
  const std::vector<double> refined =
      storey::detail::refineCenters(histogram.clusters(), {{sum / 10000, 10000.0}});
  ASSERT_EQ(refined.size(), 1U);
  EXPECT_NEAR(refined[0], 0.0, 0.1 * kDegree);  // 2 degrees / sqrt(9000) = 0.02, and the corners
}

}  // namespace
