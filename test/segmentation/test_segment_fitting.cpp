// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/segment_linking.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace storey;
using detail::LineSegment;

TEST(FitSegment, IsExactOnALine) {
  for (const double yaw : {0.0, 0.3, 1.57, 2.8, -1.0}) {
    for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1e6, -3e6)}) {
      const Eigen::Rotation2Dd turn(yaw);
      std::vector<Eigen::Vector2d> points;
      for (int i = 0; i <= 20; ++i) points.push_back(turn * Eigen::Vector2d(0.5 * i, 2.0) + shift);
      const Eigen::Vector2d outward = turn * Eigen::Vector2d(0.1, -1.0).normalized();
      const LineSegment s = detail::fitSegment(points, outward, 0.02);
      EXPECT_LT((s.normal - turn * Eigen::Vector2d(0, -1)).norm(), 1e-7);
      // The building is on the left: it runs in the sense of +x turned.
      EXPECT_LT((s.start - points.front()).norm(), 1e-7);
      EXPECT_LT((s.end - points.back()).norm(), 1e-7);
      EXPECT_NEAR(s.residual, 0.0, 1e-7);
      EXPECT_EQ(s.support, 21U);
      EXPECT_NEAR(s.length(), 10.0, 1e-7);
    }
  }
}

TEST(FitSegment, IsAsAccurateAsLeastSquaresCanBe) {
  // n points over a length L: deviation of the angle sqrt(12) sigma / (L sqrt n), of the place of
  // the middle sigma / sqrt n. 4 deviations, 50 draws: a failure once in 300 runs were the seed
  // not fixed.
  constexpr int kPoints = 400;
  constexpr double kSigma = 0.1;
  constexpr double kLength = 8.0;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, kSigma);
  std::uniform_real_distribution<double> along(0.0, kLength);
  double squares = 0.0;
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < kPoints; ++i) points.emplace_back(along(random), noise(random));
    const LineSegment s = detail::fitSegment(points, {0.0, -1.0}, 0.02);
    const double angle = std::atan2(s.tangent().y(), s.tangent().x());
    const double middle = s.normal.dot(Eigen::Vector2d(0.5 * kLength, 0.0) - s.start);
    EXPECT_LT(std::abs(angle), 4.0 * std::sqrt(12.0 / kPoints) * kSigma / kLength);
    EXPECT_LT(std::abs(middle), 4.0 * kSigma / std::sqrt(kPoints));
    squares += s.residual * s.residual;
  }
  // Variance of an estimated variance: 2 sigma^4 / n.
  EXPECT_NEAR(
      squares / 50.0, kSigma * kSigma,
      4.0 * kSigma * kSigma * std::sqrt(2.0 / (50.0 * kPoints)) + 2.0 * kSigma * kSigma / kPoints);
}

TEST(FitSegment, TakesTheGivenDirectionWhereThePointsTellNone) {
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::uniform_real_distribution<double> along(0.0, 0.5);
  std::vector<Eigen::Vector2d> points;  // angle known to sqrt(12) 0.1 / (0.5 sqrt 40) = 0.11 rad
  for (int i = 0; i < 40; ++i) points.emplace_back(along(random), noise(random));
  const Eigen::Vector2d outward(0.0, -1.0);
  const LineSegment s = detail::fitSegment(points, outward, 0.02);
  EXPECT_EQ(s.normal, outward);
}

TEST(FitSegment, DoesNotTurnFarFromTheGivenDirection) {
  // A line at 45 degrees to what its points' normals say.
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.5 * i, 0.5 * i);
  const LineSegment s = detail::fitSegment(points, {0.0, -1.0}, 0.02);
  EXPECT_EQ(s.normal, Eigen::Vector2d(0.0, -1.0));
  EXPECT_GT(s.residual, 1.0);  // so that the caller sees that it is no fit
}

TEST(FitSegment, OfCopiesOfOnePointIsFinite) {
  const LineSegment s =
      detail::fitSegment(std::vector<Eigen::Vector2d>(1000, {3.0, 4.0}), {1.0, 0.0}, 0.02);
  EXPECT_LT(s.length(), 1e-12);
  EXPECT_LT((s.start - Eigen::Vector2d(3, 4)).norm(), 1e-9);
  EXPECT_TRUE(s.normal.allFinite());
}

TEST(FitTrimmedSegment, IsExactDespiteTheEndOfTheNextWall) {
  for (const double noise : {0.0, 1e-6}) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= 200; ++i) points.emplace_back(0.05 * i, 2.0);
    for (int i = 1; i <= 10; ++i) points.emplace_back(10.0, 2.0 + 0.05 * i);
    const LineSegment s = detail::fitTrimmedSegment(points, {0.0, -1.0}, 0.02, noise);
    EXPECT_LT((s.start - Eigen::Vector2d(0, 2)).norm(), 1e-9);
    EXPECT_LT((s.end - Eigen::Vector2d(10, 2)).norm(), 1e-9);
    EXPECT_EQ(s.support, 201U);
    EXPECT_NEAR(s.residual, 0.0, 1e-9);
  }
}

TEST(FitTrimmedSegment, OfNothingAndOfOnePointIsDefined) {
  EXPECT_EQ(detail::fitTrimmedSegment({}, {1.0, 0.0}, 0.02, 0.1).support, 0U);
  EXPECT_EQ(detail::fitTrimmedSegment({{1, 2}}, {1.0, 0.0}, 0.02, 0.1).length(), 0.0);
}

}  // namespace
