// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "named_layers.h"
#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

// Every corner moved by as much as the lines of slices scatter.
std::vector<FloorplanLayer> disturbed(std::vector<FloorplanLayer> layers, double by,
                                      std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-by, by);
  for (FloorplanLayer& l : layers) {
    for (Eigen::Vector2d& v : l.plan.components[0].outer.vertices) {
      v += Eigen::Vector2d(shift(random), shift(random));
    }
  }
  return layers;
}

// Distance of the fitted line from the middle of the true edge, outwards.
double errorAtMiddle(const WallFit& fit, const FloorplanRing& truth, std::size_t edge) {
  const Eigen::Vector2d middle =
      0.5 * (truth.vertices[edge] + truth.vertices[(edge + 1) % truth.size()]);
  return fit.offset - fit.normal.dot(middle);
}

TEST(FitWalls, IsAsAccurateAsTheNumberOfPointsAllows) {
  // Each line within 4 sigma / sqrt(n), n its points; over 40 draws of 6 walls the mean square of
  // the error in units of sigma / sqrt(n) is 1 up to 4 sqrt(2 / 240), and to what Tukey's weights
  // (98 % efficient) and the 3 rounds cost: 10 %.
  double squares = 0.0;
  double residuals = 0.0;
  int count = 0;
  for (unsigned draw = 0; draw < 40; ++draw) {
    WallSampler sampler(kSigma, draw);
    FitPoints points;
    sampler.addLayers(lShape(), 5.0, points);
    auto layers = disturbed(lShape(), kSigma, sampler.random());
    FitOptions separate = options();
    separate.share_directions = false;
    const auto fits = fitWalls(layers, points, separate);
    ASSERT_EQ(fits.size(), 6U);
    for (const auto& [wall, fit] : fits) {
      ASSERT_GT(fit.support, 100U);
      const double error =
          errorAtMiddle(fit, lShape()[0].plan.components[0].outer, static_cast<std::size_t>(wall)) *
          std::sqrt(static_cast<double>(fit.support)) / kSigma;
      EXPECT_LT(std::abs(error), 4.5) << "draw " << draw << " wall " << wall;
      squares += error * error;
      ++count;
      EXPECT_NEAR(fit.residual, kSigma,
                  4.5 * kSigma / std::sqrt(2.0 * static_cast<double>(fit.support)));
      residuals += fit.residual / kSigma;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      // Two lines, each off by up to 4 sigma / sqrt(n) at its end (twice that of its middle).
      const double corner = (layers[0].plan.components[0].outer.vertices[i] -
                             lShape()[0].plan.components[0].outer.vertices[i])
                                .norm();
      EXPECT_LT(corner, 16.0 * kSigma / std::sqrt(300.0));
    }
  }
  EXPECT_LT(squares / count, 1.1 * (1.0 + 4.0 * std::sqrt(2.0 / count)));
  EXPECT_GT(squares / count, 1.0 - 4.0 * std::sqrt(2.0 / count));
  // The points beyond the gate of 4 sigma lack: 0.1 % of the variance; two parameters of 200
  // points.
  EXPECT_NEAR(residuals / count, 1.0, 0.01);
}

// Normals N(0, 15 degrees) about the true ones, in plan; or none.
void disturbNormals(bool known, std::mt19937& random, FitPoints& points) {
  std::normal_distribution<double> turn(0.0, M_PI / 12.0);
  for (Eigen::Vector3f& n : points.normals) {
    if (!known) {
      n.setZero();
      continue;
    }
    n.head<2>() = Eigen::Rotation2Df(static_cast<float>(turn(random))) * n.head<2>().eval();
  }
}

TEST(FitWalls, CornersWhereTwoWallsMixMoveNoWall) {
  // Of all n = 5 L H points of a wall those near its ends take no part, and what is taken there of
  // the neighbour moves it. That may cost 4 % of sigma^2 / n, Tukey's weights 2 %; the
  // mean, over 6 x 100 errors, may be off by a fifth of a deviation.
  for (const bool known : {true, false}) {
    double squares = 0.0;
    double sum = 0.0;
    constexpr int kDraws = 100;
    for (unsigned draw = 0; draw < kDraws; ++draw) {
      WallSampler sampler(kSigma, 3000 + draw);
      FitPoints points;
      sampler.addLayers(lShape(), 5.0, points);
      disturbNormals(known, sampler.random(), points);
      auto layers = lShape();
      const auto fits = fitWalls(layers, points, options());
      const FloorplanRing& outer = lShape()[0].plan.components[0].outer;
      for (const auto& [wall, fit] : fits) {
        const auto i = static_cast<std::size_t>(wall);
        const double length = (outer.vertices[(i + 1) % 6] - outer.vertices[i]).norm();
        const double error = errorAtMiddle(fit, outer, i) * std::sqrt(5.0 * 10.0 * length) / kSigma;
        squares += error * error / (6 * kDraws);
        sum += error / (6 * kDraws);
      }
    }
    EXPECT_LT(squares, 1.06 * (1.0 + 3.0 * std::sqrt(2.0 / (6 * kDraws))));
    EXPECT_LT(std::abs(sum), 0.2);
  }
}

TEST(FitWalls, TheStatedDeviationsAreTrue) {
  // 2 x 6 errors of each of 100 clouds: of the offset at the centre of the points, and of the wall
  // at its first corner. 95.45 % lie within two deviations; those of shared directions are
  // alike, so that 1200 errors count as 800 or more: give or take 0.75 %.
  int within = 0;
  constexpr int kDraws = 100;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    WallSampler sampler(kSigma, 4000 + draw);
    FitPoints points;
    sampler.addLayers(lShape(), 5.0, points);
    disturbNormals(true, sampler.random(), points);
    auto layers = disturbed(lShape(), kSigma, sampler.random());
    const auto fits = fitWalls(layers, points, options());
    const FloorplanRing& outer = lShape()[0].plan.components[0].outer;
    for (const auto& [wall, fit] : fits) {
      const Eigen::Vector2d corner = outer.vertices[static_cast<std::size_t>(wall)];
      const Eigen::Vector2d next = outer.vertices[(static_cast<std::size_t>(wall) + 1) % 6];
      const Eigen::Vector2d along = (next - corner).normalized();
      const Eigen::Vector2d normal(along.y(), -along.x());
      const Eigen::Vector2d tangent(-fit.normal.y(), fit.normal.x());
      const double place = tangent.dot(corner - fit.centre);
      EXPECT_NEAR(fit.normal.dot(fit.centre), fit.offset, 1e-9);
      within += std::abs(normal.dot(fit.centre - corner)) < 2.0 * fit.offset_deviation;
      within += std::abs(fit.offset - fit.normal.dot(corner)) <
                2.0 * std::hypot(fit.offset_deviation, place * fit.angle_deviation);
    }
  }
  EXPECT_NEAR(within / (12.0 * kDraws), 0.9545, 3.0 * 0.0075);
}

TEST(FitWalls, ParallelWallsShareOneDirection) {
  double shared_squares = 0.0;
  double separate_squares = 0.0;
  for (unsigned draw = 0; draw < 20; ++draw) {
    WallSampler sampler(kSigma, 100 + draw);
    FitPoints points;
    sampler.addLayers(lShape(), 2.0, points);
    for (const bool share : {true, false}) {
      auto layers = disturbed(lShape(), kSigma, sampler.random());
      FitOptions chosen = options();
      chosen.share_directions = share;
      const auto fits = fitWalls(layers, points, chosen);
      for (const auto& [wall, fit] : fits) {
        const auto& outer = lShape()[0].plan.components[0].outer;
        const auto i = static_cast<std::size_t>(wall);
        const Eigen::Vector2d along = outer.vertices[(i + 1) % 6] - outer.vertices[i];
        const double turn = fit.normal.dot(along.normalized());
        (share ? shared_squares : separate_squares) += turn * turn;
      }
      if (share) {
        // Walls 0, 2 and 4 run along x, 1, 3 and 5 along y: each three agree to the last digits.
        for (const auto& [a, b] : {std::pair{0, 2}, {0, 4}, {1, 3}, {1, 5}}) {
          EXPECT_LT(std::abs(fits.at(a).normal.dot(
                        Eigen::Vector2d(-fits.at(b).normal.y(), fits.at(b).normal.x()))),
                    1e-12);
        }
      }
    }
  }
  // Of three walls the shortest gain most; on the whole the square falls to less than half.
  EXPECT_LT(shared_squares, 0.5 * separate_squares);
}

TEST(FitWalls, AShortWallFoundAslantTurnsToItsPoints) {
  // The sides of a bay, 15 deviations long, 12 degrees off: 15 of the deviations of their
  // directions, sqrt(12) 0.1 / (1.5 sqrt 150) = 0.019.
  const auto truth = named({layer(
      0, 10, {ring({{0, 0}, {6, 0}, {6, -1.5}, {9, -1.5}, {9, 0}, {20, 0}, {20, 10}, {0, 10}})})});
  WallSampler sampler(kSigma, 17);
  FitPoints points;
  sampler.addLayers(truth, 10.0, points);
  auto layers = truth;
  auto& corners = layers[0].plan.components[0].outer.vertices;
  const double off = 0.75 * std::tan(12.0 * M_PI / 180.0);
  corners[1].x() -= off;
  corners[2].x() += off;
  corners[3].x() -= off;
  corners[4].x() += off;
  fitWalls(layers, points, options());
  for (std::size_t i = 1; i < 5; ++i) {
    // At its end a wall is good to 2 sigma / sqrt(150); four times that.
    EXPECT_LT((corners[i] - truth[0].plan.components[0].outer.vertices[i]).norm(),
              4.0 * 2.0 * kSigma / std::sqrt(150.0));
  }
}

TEST(FitWalls, WallsOfDifferentDirectionsDoNotShare) {
  // 3 degrees between the lower and the upper wall: 0.05 rad against a deviation of
  // sqrt(12) 0.1 / (20 sqrt 1000) = 0.0005.
  const double rise = 20.0 * std::tan(3.0 * M_PI / 180.0);
  const auto truth = named({layer(0, 10, {ring({{0, 0}, {20, 0}, {20, 10}, {0, 10 + rise}})})});
  WallSampler sampler(kSigma, 7);
  FitPoints points;
  sampler.addLayers(truth, 5.0, points);
  auto layers = disturbed(truth, kSigma, sampler.random());
  const auto fits = fitWalls(layers, points, options());
  const double turn = std::acos(-fits.at(0).normal.dot(fits.at(2).normal));
  EXPECT_NEAR(turn, 3.0 * M_PI / 180.0, 0.003);
}

TEST(FitWalls, OutliersDoNotMoveWalls) {
  WallSampler sampler(kSigma, 8);
  FitPoints points;
  sampler.addLayers(lShape(), 5.0, points);
  std::uniform_real_distribution<double> x(-5.0, 25.0);
  std::uniform_real_distribution<double> z(0.0, 10.0);
  const std::size_t outliers = points.positions.size() / 4;  // 20 % of all
  for (std::size_t i = 0; i < outliers; ++i) {
    points.positions.emplace_back(static_cast<float>(x(sampler.random())),
                                  static_cast<float>(x(sampler.random())),
                                  static_cast<float>(z(sampler.random())));
    points.normals.emplace_back(0.0F, 0.0F, 0.0F);  // unknown: they fit every wall
  }
  auto layers = disturbed(lShape(), kSigma, sampler.random());
  const auto fits = fitWalls(layers, points, options());
  for (const auto& [wall, fit] : fits) {
    EXPECT_LT(std::abs(errorAtMiddle(fit, lShape()[0].plan.components[0].outer,
                                     static_cast<std::size_t>(wall))),
              4.0 * kSigma / std::sqrt(static_cast<double>(fit.support)));
  }
}

TEST(FitWalls, ParallelWallsTenDeviationsApartAreNotMixed) {
  const auto truth = named({layer(
      0, 10, {ring({{0, 0}, {10, 0}, {10, 10 * kSigma}, {20, 10 * kSigma}, {20, 12}, {0, 12}})})});
  WallSampler sampler(kSigma, 9);
  FitPoints points;
  sampler.addLayers(truth, 5.0, points);
  auto layers = disturbed(truth, kSigma, sampler.random());
  const auto fits = fitWalls(layers, points, options());
  for (const int wall : {0, 2}) {
    EXPECT_LT(std::abs(errorAtMiddle(fits.at(wall), truth[0].plan.components[0].outer,
                                     static_cast<std::size_t>(wall))),
              4.0 * kSigma / std::sqrt(static_cast<double>(fits.at(wall).support)));
  }
}

TEST(FitWalls, FacesOfAThinWallAreToldApartByTheirNormals) {
  // A wall 3 sigma thick: outer face at 0, that of a courtyard at 3 sigma.
  auto truth = std::vector<FloorplanLayer>{layer(0, 10, {rectangle(0, 0, 20, 20)})};
  truth[0].plan.components[0].holes.push_back(
      reversed(rectangle(3 * kSigma, 3 * kSigma, 20 - 3 * kSigma, 20 - 3 * kSigma)));
  truth = named(truth);
  WallSampler sampler(kSigma, 10);
  FitPoints points;
  sampler.addLayers(truth, 5.0, points);
  auto layers = truth;
  const auto fits = fitWalls(layers, points, options());
  const FloorplanComponent& component = truth[0].plan.components[0];
  for (int wall = 0; wall < 8; ++wall) {
    const FloorplanRing& r = wall < 4 ? component.outer : component.holes[0];
    EXPECT_LT(std::abs(errorAtMiddle(fits.at(wall), r, static_cast<std::size_t>(wall % 4))),
              4.0 * kSigma / std::sqrt(static_cast<double>(fits.at(wall).support)));
  }
}

TEST(FitWalls, AWallIsFittedToThePointsOfAllItsLayers) {
  auto truth =
      named({layer(0, 6, {rectangle(0, 0, 20, 10)}), layer(6, 9, {rectangle(0, 0, 8, 10)})});
  for (const std::size_t shared : {0U, 2U, 3U}) {  // bottom, top and left go on
    truth[1].plan.components[0].outer.edges[shared].wall =
        truth[0].plan.components[0].outer.edges[shared].wall;
  }
  WallSampler sampler(kSigma, 11);
  FitPoints below;
  sampler.addLayers({truth[0]}, 5.0, below);
  FitPoints both = below;
  sampler.addLayers({truth[1]}, 5.0, both);
  auto layers = truth;
  const std::size_t support_below = fitWalls(layers, below, options()).at(3).support;
  layers = truth;
  const auto fits = fitWalls(layers, both, options());
  EXPECT_EQ(fits.size(), 5U);
  EXPECT_GT(fits.at(3).support, support_below + 100);
  EXPECT_EQ(layers[0].plan.components[0].outer.vertices[0],
            layers[1].plan.components[0].outer.vertices[0]);
}

}  // namespace
