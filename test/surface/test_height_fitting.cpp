// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.1;
constexpr int kDraws = 100;
// Fisher's information of a step blurred by N(0, sigma), per point of the wall and sigma:
// integral of phi^2 / Phi = 0.9032, phi and Phi of the standard normal distribution.
constexpr double kInformation = 0.9032;

// A wide storey under a narrow one: walls start at the foot, end and start at 12, end at the top.
const std::vector<FloorplanLayer>& twoStoreys() {
  static const std::vector<FloorplanLayer> layers = [] {
    std::vector<FloorplanLayer> result = {layer(0, 12, {rectangle(0, 0, 20, 20)}),
                                          layer(12, 24, {rectangle(5, 5, 15, 15)})};
    int next = 0;
    for (FloorplanLayer& l : result) {
      for (FloorplanEdge& edge : l.plan.components[0].outer.edges) edge.wall = next++;
    }
    return result;
  }();
  return layers;
}

FitOptions options() {
  FitOptions result;
  result.noise = kSigma;
  result.max_shift = 1.5;
  return result;
}

struct Errors {
  std::array<double, 3> mean{};
  std::array<double, 3> deviation{};
  int within_two = 0;  // of the deviations that the fit states, of all levels
};

// The errors of the three levels over many clouds, from guesses 0.3 off.
template <typename Extra>
Errors measure(double density, Extra addExtraPoints) {
  Errors result;
  std::array<double, 3> sums{};
  std::array<double, 3> squares{};
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    WallSampler sampler(kSigma, 1000 + draw);
    FitPoints points;
    sampler.addLayers(twoStoreys(), density, points);
    addExtraPoints(sampler.random(), points);
    auto layers = twoStoreys();
    std::uniform_real_distribution<double> off(-0.3, 0.3);
    layers[0].z_min += off(sampler.random());
    layers[0].z_max = layers[1].z_min = 12.0 + off(sampler.random());
    layers[1].z_max += off(sampler.random());
    const std::vector<HeightFit> fits = fitHeights(layers, points, options());
    EXPECT_EQ(layers.size(), 2U);
    EXPECT_EQ(fits.size(), 3U);
    EXPECT_EQ(layers[0].z_max, layers[1].z_min);
    const std::array<double, 3> errors = {layers[0].z_min, layers[0].z_max - 12.0,
                                          layers[1].z_max - 24.0};
    for (std::size_t k = 0; k < 3; ++k) {
      sums[k] += errors[k];
      squares[k] += errors[k] * errors[k];
      result.within_two += std::abs(errors[k]) < 2.0 * fits[k].deviation;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    result.mean[k] = sums[k] / kDraws;
    result.deviation[k] = std::sqrt(squares[k] / kDraws - result.mean[k] * result.mean[k]);
  }
  return result;
}

// Points per unit of height of the walls that tell each level.
std::array<double, 3> pointsPerHeight(double density) {
  return {80.0 * density, 120.0 * density, 40.0 * density};
}

// 300 errors are within two deviations in 95.45 % of the cases, give or take 1.2 %.
void expectCalibrated(const Errors& errors) {
  EXPECT_GT(errors.within_two, 300 * (0.9545 - 4 * 0.012));
  EXPECT_LT(errors.within_two, 300 * (0.9545 + 3.2 * 0.012));  // 99.3 %
}

TEST(FitHeights, ReachesTheBoundWithoutBias) {
  // The bound sqrt(sigma / (0.9032 lambda)); a deviation over 100 draws is known to 1 / sqrt(200),
  // a mean to deviation / 10. Likelihood's own bias, inwards, is 0.365 / lambda, far below.
  for (const double density : {5.0, 20.0}) {
    const Errors errors = measure(density, [](std::mt19937&, FitPoints&) {});
    const std::array<double, 3> lambda = pointsPerHeight(density);
    for (std::size_t k = 0; k < 3; ++k) {
      const double bound = std::sqrt(kSigma / (kInformation * lambda[k]));
      EXPECT_NEAR(errors.deviation[k], bound, 4.0 * bound / std::sqrt(2.0 * kDraws))
          << "level " << k;
      EXPECT_LT(std::abs(errors.mean[k]), 4.0 * bound / std::sqrt(kDraws) + 0.365 / lambda[k])
          << "level " << k;
    }
    expectCalibrated(errors);
  }
}

// A level face of the building with normals N(0, 15 degrees) about the vertical, as the paper's.
void addCap(double low, double high, double z, double up, double density, std::mt19937& random,
            FitPoints& points) {
  std::normal_distribution<double> noise(0.0, kSigma);
  std::normal_distribution<double> tilt(0.0, M_PI / 12.0);
  std::uniform_real_distribution<double> place(low, high);
  std::uniform_real_distribution<double> azimuth(0.0, 2.0 * M_PI);
  const int count = static_cast<int>(density * (high - low) * (high - low));
  for (int i = 0; i < count; ++i) {
    const double a = azimuth(random);
    const double t = tilt(random);
    const Eigen::Vector3d p(place(random) + noise(random), place(random) + noise(random),
                            z + noise(random));
    const Eigen::Vector3d n(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), up * std::cos(t));
    points.positions.push_back(p.cast<float>());
    points.normals.push_back(n.cast<float>());
  }
}

TEST(FitHeights, LevelFacesJoinIn) {
  // n points of a level face add n / sigma^2 to the information of the walls.
  constexpr double kDensity = 5.0;
  constexpr double kCapDensity = 0.4;
  const Errors errors = measure(kDensity, [](std::mt19937& random, FitPoints& points) {
    addCap(0, 20, 0.0, -1.0, kCapDensity, random, points);
    addCap(5, 15, 24.0, 1.0, kCapDensity, random, points);
  });
  const std::array<double, 3> lambda = pointsPerHeight(kDensity);
  const std::array<double, 3> caps = {400.0 * kCapDensity, 0.0, 100.0 * kCapDensity};
  for (std::size_t k = 0; k < 3; ++k) {
    const double bound =
        1.0 / std::sqrt(kInformation * lambda[k] / kSigma + caps[k] / (kSigma * kSigma));
    EXPECT_NEAR(errors.deviation[k], bound, 4.0 * bound / std::sqrt(2.0 * kDraws)) << "level " << k;
    EXPECT_LT(std::abs(errors.mean[k]), 4.0 * bound / std::sqrt(kDraws) + 0.365 / lambda[k])
        << "level " << k;
  }
  expectCalibrated(errors);
}

TEST(FitHeights, FacesThatLookTheOtherWayDoNot) {
  // A floor under the roof, seen from inside, and a ceiling over the ground: both are 0.5 inside.
  constexpr double kDensity = 20.0;
  const Errors errors = measure(kDensity, [](std::mt19937& random, FitPoints& points) {
    addCap(0, 20, 0.5, 1.0, kDensity, random, points);
    addCap(5, 15, 23.5, -1.0, kDensity, random, points);
  });
  const std::array<double, 3> lambda = pointsPerHeight(kDensity);
  for (const std::size_t k : {0U, 2U}) {
    // Three of a thousand lean by more than 45 degrees and pass for points of walls.
    const double bound = std::sqrt(kSigma / (kInformation * lambda[k]));
    EXPECT_LT(std::abs(errors.mean[k]), 4.0 * bound / std::sqrt(kDraws) + 0.02 * kSigma)
        << "level " << k;
  }
}

TEST(FitHeights, ASlantedRoofIsNoLevel) {
  WallSampler sampler(kSigma, 7);
  FitPoints points;
  sampler.addLayers(twoStoreys(), 20.0, points);
  auto without = twoStoreys();
  fitHeights(without, points, options());
  for (int i = 0; i < 4000; ++i) {  // from 1.5 below the eaves to 1.5 above, slope 0.3
    const float s = static_cast<float>(i) / 4000.0F;
    points.positions.emplace_back(5.0F + 10.0F * s, 5.0F + std::fmod(1480.0F * s, 10.0F),
                                  22.5F + 3.0F * s);
    points.normals.push_back(Eigen::Vector3f(-0.3F, 0.0F, 1.0F).normalized());
  }
  auto with = twoStoreys();
  fitHeights(with, points, options());
  EXPECT_EQ(with[1].z_max, without[1].z_max);
}

TEST(FitHeights, StraysOfACloseWallThatGoesOnDoNotMoveTheLevel) {
  // A tenth of the density goes on beyond the end, as from a wall 2.5 sigma behind.
  std::vector<FloorplanLayer> strays = {layer(12, 36, {rectangle(0, 0, 20, 20)})};
  const Errors errors = measure(20.0, [&](std::mt19937& random, FitPoints& points) {
    WallSampler sampler(kSigma, static_cast<unsigned>(random()));
    sampler.addLayers(strays, 2.0, points);
  });
  const double bound = std::sqrt(kSigma / (kInformation * pointsPerHeight(20.0)[1]));
  EXPECT_LT(std::abs(errors.mean[1]), bound);
  EXPECT_LT(errors.deviation[1], 1.6 * bound);
}

TEST(FitHeights, OutliersMoveALevelByLessThanAFifthOfTheNoise) {
  constexpr double kDensity = 20.0;
  const Errors errors = measure(kDensity, [](std::mt19937& random, FitPoints& points) {
    const std::size_t count = points.positions.size() / 20;
    std::uniform_real_distribution<double> x(-5.0, 25.0);
    std::uniform_real_distribution<double> z(-5.0, 29.0);
    for (std::size_t i = 0; i < count; ++i) {
      points.positions.emplace_back(static_cast<float>(x(random)), static_cast<float>(x(random)),
                                    static_cast<float>(z(random)));
      points.normals.emplace_back(0.0F, 0.0F, 0.0F);
    }
  });
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(std::abs(errors.mean[k]), 0.2 * kSigma);
}

TEST(FitHeights, ABoundaryThatNoWallEndsAtStays) {
  std::vector<FloorplanLayer> layers = {layer(0, 12, {rectangle(0, 0, 20, 20)}),
                                        layer(12, 24, {rectangle(0, 0, 20, 20)})};
  for (FloorplanLayer& l : layers) {
    for (std::size_t i = 0; i < 4; ++i) {
      l.plan.components[0].outer.edges[i].wall = static_cast<int>(i);
    }
  }
  WallSampler sampler(kSigma, 1);
  FitPoints points;
  sampler.addLayers(layers, 5.0, points);
  layers[0].z_max = layers[1].z_min = 11.3;
  const std::vector<HeightFit> fits = fitHeights(layers, points, options());
  ASSERT_EQ(layers.size(), 2U);
  ASSERT_EQ(fits.size(), 3U);
  EXPECT_TRUE(std::isfinite(fits[0].deviation));
  EXPECT_TRUE(std::isinf(fits[1].deviation));
  EXPECT_EQ(layers[0].z_max, 11.3);
  EXPECT_EQ(layers[1].z_min, 11.3);
}

TEST(FitHeights, ALevelThatEvenlySpreadPointsEndAtStays) {
  // The walls are said to end at 24, and go on to 40.
  std::vector<FloorplanLayer> higher = {twoStoreys()[0], twoStoreys()[1]};
  higher[1].z_max = 40.0;
  WallSampler sampler(kSigma, 8);
  FitPoints points;
  sampler.addLayers(higher, 20.0, points);
  auto layers = twoStoreys();
  const std::vector<HeightFit> fits = fitHeights(layers, points, options());
  ASSERT_EQ(fits.size(), 3U);
  EXPECT_EQ(layers[1].z_max, 24.0);
  EXPECT_TRUE(std::isinf(fits[2].deviation));
}

TEST(FitHeights, WithoutPointsNothingMoves) {
  auto layers = twoStoreys();
  fitHeights(layers, {}, options());
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].z_min, 0.0);
  EXPECT_EQ(layers[0].z_max, 12.0);
  EXPECT_EQ(layers[1].z_max, 24.0);
}

TEST(FitHeights, NoLevelMovesFurtherThanAllowed) {
  WallSampler sampler(kSigma, 2);
  FitPoints points;
  sampler.addLayers(twoStoreys(), 5.0, points);
  auto layers = twoStoreys();
  layers[1].z_max = 26.0;  // 2 too high
  FitOptions tight = options();
  tight.max_shift = 0.5;
  fitHeights(layers, points, tight);
  EXPECT_NEAR(layers[1].z_max, 25.5, 0.01);
}

TEST(FitHeights, ALayerThinnerThanThreeDeviationsGoes) {
  // A slice that straddles the change became a layer of its own: both its boundaries come to 12.
  WallSampler sampler(kSigma, 3);
  FitPoints points;
  sampler.addLayers(twoStoreys(), 20.0, points);
  std::vector<FloorplanLayer> layers = {
      twoStoreys()[0], layer(11.9, 12.1, {rectangle(2, 2, 17, 17)}), twoStoreys()[1]};
  layers[0].z_max = 11.9;
  layers[2].z_min = 12.1;
  fitHeights(layers, points, options());
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].z_max, layers[1].z_min);
  EXPECT_NEAR(layers[0].z_max, 12.0, 1.5 * kSigma);
  EXPECT_EQ(layers[1].plan.components[0].outer.vertices,
            twoStoreys()[1].plan.components[0].outer.vertices);
}

TEST(FitHeights, AWallThatGoesOnTellsNothing) {
  // Wall 3 goes on through the step at 12 and has a hole in its points above 12: the level must
  // come from the walls that end, which reach up to 12.4.
  auto layers = twoStoreys();
  layers[1].plan = layers[0].plan;
  layers[1].plan.components[0].outer = rectangle(0, 0, 10, 20);
  layers[1].plan.components[0].outer.edges[0].wall = 0;  // bottom, its left half
  layers[1].plan.components[0].outer.edges[1].wall = 9;
  layers[1].plan.components[0].outer.edges[2].wall = 2;
  layers[1].plan.components[0].outer.edges[3].wall = 3;
  auto truth = layers;
  truth[0].z_max = truth[1].z_min = 12.4;
  WallSampler sampler(kSigma, 4);
  FitPoints points;
  sampler.addLayers(truth, 20.0, points);
  FitPoints seen;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3f& p = points.positions[i];
    if (p.x() < 1.0F && p.z() > 12.0F && p.z() < 14.0F) continue;
    seen.positions.push_back(p);
    seen.normals.push_back(points.normals[i]);
  }
  fitHeights(layers, seen, options());
  // Ending: right, and the right halves of bottom and top; starting: the wall at x = 10.
  const double lambda = 20.0 * (20.0 + 10.0 + 10.0 + 20.0 - 8 * 3 * kSigma);
  EXPECT_NEAR(layers[0].z_max, 12.4, 4.0 * std::sqrt(kSigma / (kInformation * lambda)));
}

TEST(FitHeights, TurnsAndMovesWithTheCloud) {
  WallSampler sampler(kSigma, 5);
  FitPoints points;
  sampler.addLayers(twoStoreys(), 5.0, points);
  auto here = twoStoreys();
  fitHeights(here, points, options());
  const double yaw = 0.8;
  const Eigen::Rotation2Dd turn(yaw);
  auto there = twoStoreys();
  move(there, 1.0, yaw, {50, 60});
  FitPoints moved = points;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector2d p =
        turn * points.positions[i].head<2>().cast<double>().eval() + Eigen::Vector2d(50, 60);
    const Eigen::Vector2d n = turn * points.normals[i].head<2>().cast<double>().eval();
    moved.positions[i].head<2>() = p.cast<float>();
    moved.normals[i].head<2>() = n.cast<float>();
    moved.positions[i].z() += 100.0F;
  }
  for (FloorplanLayer& l : there) {
    l.z_min += 100.0;
    l.z_max += 100.0;
  }
  fitHeights(there, moved, options());
  EXPECT_NEAR(there[0].z_min, here[0].z_min + 100.0, 1e-3);
  EXPECT_NEAR(there[0].z_max, here[0].z_max + 100.0, 1e-3);
  EXPECT_NEAR(there[1].z_max, here[1].z_max + 100.0, 1e-3);
}

TEST(FitHeights, BadOptionsChangeNothing) {
  WallSampler sampler(kSigma, 6);
  FitPoints points;
  sampler.addLayers(twoStoreys(), 1.0, points);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    for (const bool noise : {true, false}) {
      FitOptions wrong = options();
      (noise ? wrong.noise : wrong.max_shift) = bad;
      auto layers = twoStoreys();
      layers[1].z_max = 24.2;
      fitHeights(layers, points, wrong);
      ASSERT_EQ(layers.size(), 2U);
      EXPECT_EQ(layers[1].z_max, 24.2);
    }
  }
  std::vector<FloorplanLayer> none;
  fitHeights(none, points, options());
  EXPECT_TRUE(none.empty());
}

}  // namespace
