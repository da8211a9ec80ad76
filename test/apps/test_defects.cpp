// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "synth/buildings.h"
#include "synth/sampling.h"

namespace {

using Eigen::Vector3d;
using storey::synth::Defects;
using storey::synth::PointSource;
using storey::synth::SamplingOptions;
using storey::synth::SyntheticCloud;

constexpr std::size_t kPoints = 40000;

/// The box of 20 x 14 x 24 centred on the z axis, without noise unless asked for.
SyntheticCloud sampleBox(const Defects& defects, double noise = 0.0) {
  SamplingOptions options;
  options.points = kPoints;
  options.noise = options.normal_noise = noise;
  options.defects = defects;
  return sampleBuilding(storey::synth::makeBuilding("box").layers, options);
}

using Key = std::tuple<double, double, double>;

std::set<Key> positionsOf(const SyntheticCloud& cloud) {
  std::set<Key> keys;
  for (const Vector3d& p : cloud.positions) {
    keys.insert({p.x(), p.y(), p.z()});
  }
  return keys;
}

double share(const SyntheticCloud& cloud, const std::function<bool(std::size_t)>& test) {
  double count = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    count += test(i) ? 1.0 : 0.0;
  }
  return count / static_cast<double>(cloud.size());
}

/// 4.5 standard deviations of a share among the points.
double tolerance(double expected) {
  return 4.5 * std::sqrt(expected * (1.0 - expected) / static_cast<double>(kPoints));
}

int wallOf(const Vector3d& normal) {
  return normal.x() > 0.5 ? 0 : normal.x() < -0.5 ? 1 : normal.y() > 0.5 ? 2 : 3;
}

TEST(Defects, WhatIsMissingLeavesTheRestAsItWas) {
  const std::set<Key> complete = positionsOf(sampleBox({}));
  Defects defects;
  defects.missing_patches = 0.2;
  defects.missing_side = 0.5;
  defects.density_falloff = 4.0;
  const std::set<Key> rest = positionsOf(sampleBox(defects));
  EXPECT_LT(rest.size(), complete.size());
  EXPECT_TRUE(std::includes(complete.begin(), complete.end(), rest.begin(), rest.end()));
}

/// The balls stop when 20,000 probes have their share: known to 0.0035, plus the last ball's
/// disc of pi 1.5^2 / 1632 = 0.0043, plus the scatter of the count.
TEST(Defects, PatchesHideTheirShare) {
  for (const double hidden : {0.1, 0.3, 0.6}) {
    Defects defects;
    defects.missing_patches = hidden;
    const double left = static_cast<double>(sampleBox(defects).size()) / kPoints;
    EXPECT_NEAR(left, 1.0 - hidden, 3.0 * 0.0035 + 0.0043 + tolerance(hidden));
  }
}

TEST(Defects, MissingWallsHaveNoPointsAndOthersAll) {
  Defects defects;
  for (const auto& [wanted, missing] : {std::pair(0.01, 1u), {0.25, 1u}, {0.5, 2u}, {0.75, 3u}}) {
    defects.missing_walls = wanted;
    const SyntheticCloud cloud = sampleBox(defects);
    std::set<int> walls;
    for (const Vector3d& normal : cloud.normals) {
      walls.insert(wallOf(normal));
    }
    EXPECT_EQ(4u - walls.size(), missing) << wanted;
  }
}

TEST(Defects, ASideGoesAsAWholeOrInPart) {
  Defects defects;
  defects.missing_side = 1.0;
  std::set<int> walls;
  for (const Vector3d& normal : sampleBox(defects).normals) {
    walls.insert(wallOf(normal));
  }
  EXPECT_EQ(walls.size(), 3u);
  const int side = 6 - [&] {
    int sum = 0;
    for (const int w : walls) sum += w;
    return sum;
  }();

  defects.missing_side = 0.5;
  const SyntheticCloud half = sampleBox(defects);
  const SyntheticCloud complete = sampleBox({});
  const auto on_side = [&](const SyntheticCloud& cloud) {
    return std::count_if(cloud.normals.begin(), cloud.normals.end(),
                         [&](const Vector3d& normal) { return wallOf(normal) == side; });
  };
  const auto all = static_cast<double>(on_side(complete));
  EXPECT_NEAR(static_cast<double>(on_side(half)), 0.5 * all, 4.5 * 0.5 * std::sqrt(all));
  EXPECT_EQ(complete.size() - half.size(),
            static_cast<std::size_t>(on_side(complete) - on_side(half)));
}

TEST(Defects, TheFootIsEmpty) {
  Defects defects;
  defects.missing_foot = 0.25;
  const SyntheticCloud cloud = sampleBox(defects);
  for (const Vector3d& position : cloud.positions) {
    ASSERT_GE(position.z(), 0.25 * 24.0);
  }
  EXPECT_NEAR(static_cast<double>(cloud.size()) / kPoints, 0.75, tolerance(0.25));
}

/// With density 9^(-z/h), the lower half holds (1 - 1/3) / (1 - 1/9) = 3/4 of what is left, which
/// is (1 - 1/9) / ln 9 = 0.4045 of all.
TEST(Defects, DensityFallsWithHeight) {
  Defects defects;
  defects.density_falloff = 9.0;
  const SyntheticCloud cloud = sampleBox(defects);
  const double left = (1.0 - 1.0 / 9.0) / std::log(9.0);
  EXPECT_NEAR(static_cast<double>(cloud.size()) / kPoints, left, tolerance(left));
  const double low = share(cloud, [&](std::size_t i) { return cloud.positions[i].z() < 12.0; });
  EXPECT_NEAR(low, 0.75, tolerance(0.75) / std::sqrt(left));
}

TEST(Defects, WindowsAreRecessedByTheirDepthOverTheirShare) {
  Defects defects;
  defects.windows = 0.2;
  defects.window_depth = 0.3;
  defects.window_pitch = 2.0;  // divides 20, 14 and 24: the share is exact
  const SyntheticCloud cloud = sampleBox(defects);
  const auto depth = [&](std::size_t i) {
    const Vector3d half(10.0, 7.0, 0.0);
    const Vector3d normal = cloud.normals[i];
    return half.dot(normal.cwiseAbs()) - normal.dot(cloud.positions[i]);
  };
  const double recessed =
      share(cloud, [&](std::size_t i) { return std::abs(depth(i) - 0.3) < 1e-9; });
  const double flush = share(cloud, [&](std::size_t i) { return std::abs(depth(i)) < 1e-9; });
  EXPECT_NEAR(recessed, 0.2, tolerance(0.2));
  EXPECT_DOUBLE_EQ(recessed + flush, 1.0);
}

TEST(Defects, NormalsAreFlippedByTheirShare) {
  Defects defects;
  defects.flipped_normals = 0.3;
  const SyntheticCloud cloud = sampleBox(defects);
  const double inwards = share(cloud, [&](std::size_t i) {
    return cloud.normals[i].dot(cloud.positions[i] - Vector3d(0.0, 0.0, 12.0)) < 0.0;
  });
  EXPECT_NEAR(inwards, 0.3, tolerance(0.3));
}

/// A share t of the noise k times as large gives the variance s^2 (1 - t + t k^2). The variance of
/// a squared deviation is below 3 s^4 k^4 t + 3 s^4.
TEST(Defects, HeavyTailsWidenTheNoise) {
  Defects defects;
  const SyntheticCloud exact = sampleBox(defects);
  defects.heavy_tails = 0.05;
  const SyntheticCloud noisy = sampleBox(defects, 0.1);
  ASSERT_EQ(exact.size(), noisy.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    squares += (noisy.positions[i] - exact.positions[i]).squaredNorm() / 3.0;
  }
  const double expected = 0.01 * (0.95 + 0.05 * 25.0);
  const double deviation = 0.01 * std::sqrt((3.0 * 625.0 * 0.05 + 3.0) / kPoints);
  EXPECT_NEAR(squares / kPoints, expected, 4.5 * deviation);
}

std::size_t countSource(const SyntheticCloud& cloud, PointSource source) {
  return static_cast<std::size_t>(std::count(cloud.sources.begin(), cloud.sources.end(), source));
}

TEST(Defects, ClutterComesOnTopAndStaysOutside) {
  Defects defects;
  defects.outliers = 0.2;
  defects.ground = 0.5;
  defects.trees = 0.1;
  defects.ground_relief = 0.4;
  const SyntheticCloud cloud = sampleBox(defects);
  EXPECT_EQ(countSource(cloud, PointSource::Building), kPoints);
  EXPECT_EQ(countSource(cloud, PointSource::Outlier), kPoints / 5);
  EXPECT_EQ(countSource(cloud, PointSource::Ground), kPoints / 2);
  EXPECT_EQ(countSource(cloud, PointSource::Tree), kPoints / 10);
  const Eigen::AlignedBox3d box(Vector3d(-10, -7, 0), Vector3d(10, 7, 24));
  const Eigen::AlignedBox3d around(box.min() - 0.1 * box.sizes(), box.max() + 0.1 * box.sizes());
  std::size_t clutter_in_last_half = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d& p = cloud.positions[i];
    const bool above_plan = box.contains(Vector3d(p.x(), p.y(), 12.0));
    switch (cloud.sources[i]) {
      case PointSource::Outlier:
        ASSERT_TRUE(around.contains(p));
        break;
      case PointSource::Ground:
        ASSERT_FALSE(above_plan);
        ASSERT_LE(std::abs(p.z()), 0.4);
        ASSERT_GT(cloud.normals[i].z(), 0.9);
        break;
      case PointSource::Tree:
        ASSERT_FALSE(above_plan);
        break;
      case PointSource::Building:
        continue;
    }
    clutter_in_last_half += 2 * i > cloud.size() ? 1 : 0;
  }
  // The order is random: half the clutter, within 4.5 deviations of a binomial count.
  const double clutter = 0.8 * kPoints;
  EXPECT_NEAR(static_cast<double>(clutter_in_last_half), 0.5 * clutter,
              4.5 * 0.5 * std::sqrt(clutter));
}

/// 3^3 of the box's volumes: (1.2^3 - 1) / 1.2^3 of the outliers are outside the building.
TEST(Defects, OutliersAreUniform) {
  Defects defects;
  defects.outliers = 1.0;
  const SyntheticCloud cloud = sampleBox(defects);
  const Eigen::AlignedBox3d box(Vector3d(-10, -7, 0), Vector3d(10, 7, 24));
  double outside = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool outlier = cloud.sources[i] == PointSource::Outlier;
    outside += outlier && !box.contains(cloud.positions[i]) ? 1.0 : 0.0;
  }
  const double expected = 1.0 - 1.0 / std::pow(1.2, 3);
  EXPECT_NEAR(outside / kPoints, expected, tolerance(expected));
}

}  // namespace
