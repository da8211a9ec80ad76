// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/even_draw.h>
#include <storey/filters/noise_limited_sampling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "../foreign_point.h"

namespace storey {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Sampling = NoiseLimitedSampling<pcl::PointNormal>;

constexpr double kNoise = 0.2;
constexpr double kSide = 50.0;

/// A level square of noise 0.2, and a wall of the same area and noise on one of its sides.
Cloud::Ptr makeCorner(std::size_t points, double scale = 1.0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0.0, kSide);
  std::normal_distribution<double> noise(0.0, kNoise);
  auto cloud = pcl::make_shared<Cloud>();
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::Vector3d p(along(random), along(random), 0.0);
    if (i % 2 == 0) std::swap(p.y(), p.z());
    for (int axis = 0; axis < 3; ++axis) p[axis] = scale * (p[axis] + noise(random));
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

std::size_t sizeOf(const Cloud::Ptr& cloud, const Sampling& settings = Sampling()) {
  Sampling sampling = settings;
  sampling.setInputCloud(cloud);
  pcl::Indices kept;
  sampling.filter(kept);
  return kept.size();
}

// q points on each square of the noise's side: q area / noise^2.
TEST(NoiseLimitedSampling, LeavesHalfAPointOnEachSquareOfTheNoise) {
  const Cloud::Ptr cloud = makeCorner(300000);
  const double area = 2.0 * kSide * kSide;
  for (const double q : {0.25, 0.5, 1.5}) {
    Sampling sampling;
    sampling.setLeastPoints(1000);
    sampling.setPointsPerNoiseArea(q);
    const double expected = q * area / (kNoise * kNoise);
    EXPECT_NEAR(static_cast<double>(sizeOf(cloud, sampling)), expected, 0.1 * expected) << q;
    sampling.setNoise(2.0 * kNoise);
    EXPECT_NEAR(static_cast<double>(sizeOf(cloud, sampling)), 0.25 * expected, 0.03 * expected);
  }
}

TEST(NoiseLimitedSampling, LeavesOtherCloudsAsTheyAre) {
  EXPECT_EQ(sizeOf(makeCorner(150000)), 150000U);  // few
  Sampling fine;
  fine.setNoise(1e-3);
  EXPECT_EQ(sizeOf(makeCorner(300000), fine), 300000U);  // coarser than their noise
  EXPECT_EQ(sizeOf(makeCorner(300000)), 200000U);        // never thinned to fewer
}

// Roofs of 0.02 and a noise of a thousandth: a part too small for the roofs takes them for noise.
TEST(NoiseLimitedSampling, DoesNotTakeShapeForNoise) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(0.0f, 4.0f);
  std::normal_distribution<float> noise(0.0f, 1e-4f);
  auto cloud = pcl::make_shared<Cloud>();
  for (int i = 0; i < 1500000; ++i) {
    pcl::PointNormal p;
    p.x = along(random);
    p.y = along(random);
    p.z = 0.25f * std::abs(std::remainder(p.x, 0.08f)) + noise(random);
    cloud->push_back(p);
  }
  Sampling sampling;
  sampling.setLeastPoints(1000);
  EXPECT_EQ(sizeOf(cloud, sampling), cloud->size());
}

TEST(NoiseLimitedSampling, DoesNotDependOnTheUnit) {
  Sampling sampling;
  sampling.setLeastPoints(1000);
  const std::size_t size = sizeOf(makeCorner(300000), sampling);
  EXPECT_LT(size, 200000U);
  for (const double scale : {1e-3, 1e3}) {
    EXPECT_NEAR(static_cast<double>(sizeOf(makeCorner(300000, scale), sampling)),
                static_cast<double>(size), 1e-3 * static_cast<double>(size));
  }
}

TEST(NoiseLimitedSampling, DrawsEvenlyAndKeepsTheOrder) {
  std::vector<int> entries(100003);
  std::iota(entries.begin(), entries.end(), 0);
  for (const std::size_t count : {1U, 7U, 1000U, 77777U, 100002U}) {
    const std::vector<int> drawn = detail::drawEvenly(entries, count);
    ASSERT_EQ(drawn.size(), count);
    const double stride = static_cast<double>(entries.size()) / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_GE(drawn[k], std::floor(stride * static_cast<double>(k)));
      EXPECT_LE(drawn[k], std::ceil(stride * static_cast<double>(k + 1)));
    }
    for (std::size_t k = 1; k < count; ++k) {
      EXPECT_LT(drawn[k - 1], drawn[k]);
    }
  }
  EXPECT_EQ(detail::drawEvenly(entries, 200000), entries);
}

TEST(NoiseLimitedSampling, HandlesIndicesLikeOtherFilters) {
  const Cloud::Ptr cloud = makeCorner(1000);
  (*cloud)[10].x = std::numeric_limits<float>::quiet_NaN();
  auto indices = pcl::make_shared<pcl::Indices>();
  for (int i = 998; i >= 0; i -= 2) indices->push_back(i);
  Sampling sampling(true);
  sampling.setInputCloud(cloud);
  sampling.setIndices(indices);
  sampling.setSampleSize(100);
  pcl::Indices kept;
  sampling.filter(kept);
  ASSERT_EQ(kept.size(), 100U);
  EXPECT_TRUE(std::is_sorted(kept.rbegin(), kept.rend()));
  EXPECT_EQ(sampling.getRemovedIndices()->size(), 400U);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 10), 0);
  sampling.setNegative(true);
  pcl::Indices others;
  sampling.filter(others);
  EXPECT_EQ(others.size(), 399U);  // without the point that is not finite
  for (const pcl::index_t i : others) EXPECT_EQ(std::count(kept.begin(), kept.end(), i), 0);
  Cloud output;
  sampling.setNegative(false);
  sampling.filter(output);
  EXPECT_EQ(output.size(), 100U);
  EXPECT_TRUE(output.is_dense);
}

TEST(NoiseLimitedSampling, MistakesGiveAnEmptyResult) {
  const Cloud::Ptr cloud = makeCorner(1000);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-1.0, nan, HUGE_VAL}) {
    Sampling noise;
    noise.setNoise(wrong);
    EXPECT_EQ(sizeOf(cloud, noise), 0U);
    Sampling points;
    points.setPointsPerNoiseArea(wrong);
    EXPECT_EQ(sizeOf(cloud, points), 0U);
  }
  Sampling outside;
  outside.setInputCloud(cloud);
  outside.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 1000}));
  Cloud output;
  outside.filter(output);
  EXPECT_TRUE(output.empty());
  EXPECT_EQ(sizeOf(pcl::make_shared<Cloud>()), 0U);
}

TEST(NoiseLimitedSampling, TakesPointTypesThatPclDoesNotKnow) {
  auto cloud = pcl::make_shared<pcl::PointCloud<ForeignPoint>>();
  cloud->resize(100);
  NoiseLimitedSampling<ForeignPoint> sampling;
  sampling.setInputCloud(cloud);
  sampling.setSampleSize(10);
  pcl::PointCloud<ForeignPoint> output;
  sampling.filter(output);
  EXPECT_EQ(output.size(), 10U);
}

// A million copies of one point have neither noise nor density.
TEST(NoiseLimitedSampling, LeavesCopiesOfOnePoint) {
  auto cloud = pcl::make_shared<Cloud>();
  cloud->resize(1000000);
  EXPECT_EQ(sizeOf(cloud), cloud->size());
}

}  // namespace
}  // namespace storey
