// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <storey/filters/cloud_scale.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "../point_types.h"

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kBoxArea = 2 * 20 * 15 + 2 * 12 * 15 + 20 * 12;

// n points on the walls and lid of a box of 20 x 12 x 15, uniform by area, with isotropic noise.
// The box is turned by 30 degrees, so that no axis is special.
Cloud makeBox(std::size_t n, double noise, double scale = 1.0, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, noise);
  std::discrete_distribution<int> face({20 * 15, 20 * 15, 12 * 15, 12 * 15, 20 * 12});
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d p(20 * uniform(random), 12 * uniform(random), 15 * uniform(random));
    const int f = face(random);
    const int axis = f < 2 ? 1 : f < 4 ? 0 : 2;
    p(axis) = f == 4 ? 15.0 : f % 2 == 0 ? 0.0 : axis == 1 ? 12.0 : 20.0;
    p = Eigen::AngleAxisd(M_PI / 6, Eigen::Vector3d::UnitZ()) * p;
    p += Eigen::Vector3d(normal(random), normal(random), normal(random));
    cloud.emplace_back();
    cloud.back().getVector3fMap() = (p * scale).cast<float>();
  }
  return cloud;
}

struct Case {
  std::size_t points;
  double noise;
  double scale;
};

class ScaleOfABox : public testing::TestWithParam<Case> {};

// A pooled variance of n points has the relative deviation sqrt(2 / n), its root 1 / sqrt(2 n): 3
// of them and 2 % for neighbourhoods that touch a corner. The density lacks what lies beyond the
// free lower edges: up to 5 %.
TEST_P(ScaleOfABox, FindsNoiseAndDensity) {
  const auto [n, noise, scale] = GetParam();
  const storey::CloudScale found = storey::estimateCloudScale(makeBox(n, noise, scale));
  const double count = static_cast<double>(n);
  EXPECT_NEAR(found.noise / (noise * scale), 1.0, 0.02 + 3.0 / std::sqrt(2.0 * count));
  EXPECT_NEAR(found.density * kBoxArea * scale * scale / count, 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(NoiseSizeAndUnit, ScaleOfABox,
                         testing::Values(Case{200000, 0.1, 1}, Case{200000, 0.03, 1},
                                         Case{200000, 0.2, 1}, Case{50000, 0.1, 1},
                                         Case{20000, 0.1, 1}, Case{5000, 0.1, 1},
                                         Case{1000000, 0.2, 1},  // 200 points span 1.3 deviations
                                         Case{200000, 0.1, 1000}, Case{200000, 0.1, 0.001}));

// A square lattice of step 1: the nearest other point is at 1, the density is 1, and the 1 % and
// 99 % quantiles of 0..199 are 2 and 197 along both axes.
// The scatter from draw to draw is the deviation that each draw tells of itself. Of 30 draws the
// scatter is known to 13 %, so a factor of 2 is far out.
TEST(CloudScale, TellsItsOwnError) {
  for (const std::size_t n : {4000, 100000}) {
    constexpr unsigned kDraws = 30;
    double sum = 0.0;
    double squares = 0.0;
    double deviations = 0.0;
    for (unsigned draw = 0; draw < kDraws; ++draw) {
      const storey::CloudScale found = storey::estimateCloudScale(makeBox(n, 0.05, 1.0, draw));
      sum += found.noise;
      squares += found.noise * found.noise;
      deviations += found.noise_deviation / kDraws;
      EXPECT_GT(found.noise_share, 0.25);
      EXPECT_LE(found.noise_share, 1.0);
    }
    const double scatter = std::sqrt((squares - sum * sum / kDraws) / (kDraws - 1));
    EXPECT_GT(scatter / deviations, 0.5) << n;
    EXPECT_LT(scatter / deviations, 2.0) << n;
  }
}

TEST(CloudScale, MeasuresALattice) {
  Cloud cloud;
  for (int x = 0; x < 200; ++x) {
    for (int y = 0; y < 200; ++y) {
      cloud.push_back(pcl::PointXYZ(static_cast<float>(x), static_cast<float>(y), 3.0f));
    }
  }
  const storey::CloudScale scale = storey::estimateCloudScale(cloud);
  EXPECT_EQ(scale.noise, 0.0);
  EXPECT_EQ(scale.spacing, 1.0);
  EXPECT_NEAR(scale.density, 1.0, 0.05);  // rings of 8 equally far points among 200
  EXPECT_NEAR(scale.extent, std::hypot(195.0, 195.0), 2.0);
}

TEST(CloudScale, IsZeroWhereNothingCanBeTold) {
  const auto expectZero = [](const Cloud& cloud) {
    const storey::CloudScale scale = storey::estimateCloudScale(cloud);
    EXPECT_EQ(scale.noise, 0.0);
    EXPECT_EQ(scale.density, 0.0);
    EXPECT_EQ(scale.spacing, 0.0);
    EXPECT_EQ(scale.extent, 0.0);
  };
  expectZero(Cloud());
  expectZero(Cloud(1, 1, pcl::PointXYZ(1, 2, 3)));
  expectZero(Cloud(1000000, 1, pcl::PointXYZ(1, 2, 3)));
  expectZero(Cloud(100, 1, pcl::PointXYZ(kNaN, 0, 0)));
  expectZero(Cloud(100, 1, pcl::PointXYZ(0, std::numeric_limits<float>::infinity(), 0)));
}

TEST(CloudScale, OfTwoToSixPointsIsFinite) {
  Cloud cloud;
  for (int i = 0; i < 6; ++i) {
    const auto x = static_cast<float>(i);
    cloud.push_back(pcl::PointXYZ(x, x * x, -x));
    const storey::CloudScale scale = storey::estimateCloudScale(cloud);
    EXPECT_TRUE(std::isfinite(scale.noise + scale.density + scale.spacing + scale.extent));
    EXPECT_EQ(scale.spacing > 0.0, i >= 1);
  }
}

TEST(CloudScale, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Eigen::Vector3f> positions = storey::detail::positionsOf(makeBox(100000, 0.1));
  const auto measure = [&](unsigned int threads) {
    return storey::detail::estimateCloudScale(positions, storey::kDefaultScaleSeed, threads);
  };
  const storey::CloudScale expected = measure(1);
  for (const unsigned int threads : {2u, 3u}) {
    const storey::CloudScale scale = measure(threads);
    EXPECT_EQ(scale.noise, expected.noise);
    EXPECT_EQ(scale.density, expected.density);
    EXPECT_EQ(scale.spacing, expected.spacing);
    EXPECT_EQ(scale.extent, expected.extent);
  }
}

TEST(CloudScale, StandsNaNDuplicatesOutliersAndOrder) {
  const Cloud clean = makeBox(30000, 0.1);
  const storey::CloudScale expected = storey::estimateCloudScale(clean);

  Cloud shuffled = clean;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  shuffled.push_back(pcl::PointXYZ(kNaN, kNaN, kNaN));
  const storey::CloudScale of_shuffled = storey::estimateCloudScale(shuffled);
  EXPECT_EQ(of_shuffled.noise, expected.noise);
  EXPECT_EQ(of_shuffled.density, expected.density);
  EXPECT_EQ(of_shuffled.spacing, expected.spacing);
  EXPECT_EQ(of_shuffled.extent, expected.extent);

  Cloud doubled = clean;
  doubled += clean;
  const storey::CloudScale of_doubled = storey::estimateCloudScale(doubled);
  EXPECT_EQ(of_doubled.noise, expected.noise);
  EXPECT_EQ(of_doubled.spacing, expected.spacing);
  // (2 k - 4/3) / (k - 4/3) for k = 200 positions, each twice, is 2.007.
  EXPECT_NEAR(of_doubled.density / expected.density, 2.0, 0.02);

  Cloud with_outliers = clean;
  for (int i = 0; i < 30; ++i) {
    with_outliers.push_back(pcl::PointXYZ(1e7f + static_cast<float>(i * i), 1e7f, 1e7f));
  }
  const storey::CloudScale of_outliers = storey::estimateCloudScale(with_outliers);
  EXPECT_NEAR(of_outliers.noise / expected.noise, 1.0, 0.02);
  EXPECT_NEAR(of_outliers.extent / expected.extent, 1.0, 0.02);
}

// Points of the walls of a box of 20 x 12 x 15 as a scanner sees them: each errs five times as much
// with a probability of `tails`, and square panes, four per unit of area, are set back by
// two deviations over a share `panes` of it.
Cloud makeFacades(std::size_t n, double noise, double tails, double panes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, noise);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const double along = 64.0 * uniform(random);  // around: 20, 12, 20, 12
    const double z = 15.0 * uniform(random);
    const double side = 0.5 * std::sqrt(panes);  // one window every half unit, either way
    const bool pane = std::fmod(along, 0.5) < side && std::fmod(z, 0.5) < side;
    const double depth = pane ? 2.0 * noise : 0.0;
    const double s = along < 32.0 ? along : along - 32.0;
    Eigen::Vector3d p =
        s < 20.0 ? Eigen::Vector3d(s, depth, z) : Eigen::Vector3d(20.0 - depth, s - 20.0, z);
    if (along >= 32.0) p = Eigen::Vector3d(20.0 - p.x(), 12.0 - p.y(), z);
    const double factor = uniform(random) < tails ? 5.0 : 1.0;
    p += factor * Eigen::Vector3d(normal(random), normal(random), normal(random));
    cloud.emplace_back();
    cloud.back().getVector3fMap() = p.cast<float>();
  }
  return cloud;
}

constexpr std::size_t kFacadePoints = 200000;
constexpr double kFacadeNoise = 0.1;

double noiseOfFacades(double tails, double panes) {
  const Cloud cloud = makeFacades(kFacadePoints, kFacadeNoise, tails, panes);
  return storey::estimateCloudScale(cloud).noise / kFacadeNoise;
}

// Of a twentieth that errs five times as much, 40 % lie within 2.5 deviations all the same: 2 % of
// the points, each with at most 6.25 variances where 0.91 are expected. The variance rises by less
// than 12 %, the noise by less than 6 %; the deviation of all points is sqrt(0.95 + 0.05 25)
// = 1.48.
TEST(CloudScale, HeavyTailsAreNoNoise) {
  const double found = noiseOfFacades(0.05, 0.0);
  EXPECT_GT(found, 0.98);
  EXPECT_LT(found, 1.06);
}

// Nothing tells points two deviations behind a wall from its noise, so they may count, with the
// 0.2 0.8 2^2 variances that they add about the mean plane, but no more.
TEST(CloudScale, PanesCountWithTheirOwnDepthAtMost) {
  const double found = noiseOfFacades(0.0, 0.2);
  EXPECT_GT(found, 0.98);
  EXPECT_LT(found, std::sqrt(1.0 + 0.2 * 0.8 * 4.0) + 0.02);
}

TEST(CloudScale, HeavyTailsAndPanesTogetherAddNoMoreThanEachAlone) {
  const double found = noiseOfFacades(0.05, 0.2);
  EXPECT_GT(found, 0.98);
  EXPECT_LT(found, 1.06 * (std::sqrt(1.0 + 0.2 * 0.8 * 4.0) + 0.02));
}

template <typename PointT>
class CloudScaleOf : public testing::Test {};
TYPED_TEST_SUITE(CloudScaleOf, OrientedPointTypes);

TYPED_TEST(CloudScaleOf, AnyPointTypeIsTheSame) {
  const Cloud box = makeBox(5000, 0.1);
  pcl::PointCloud<TypeParam> cloud;
  for (const pcl::PointXYZ& p : box) {
    cloud.emplace_back();
    cloud.back().getVector3fMap() = p.getVector3fMap();
  }
  EXPECT_EQ(storey::estimateCloudScale(cloud).noise, storey::estimateCloudScale(box).noise);
}

}  // namespace
