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

TEST(FitWalls, AWallWithoutPointsStays) {
  WallSampler sampler(kSigma, 12);
  FitPoints points;
  auto truth = named({layer(0, 10, {rectangle(0, 0, 20, 10)})});
  const FloorplanRing outer = truth[0].plan.components[0].outer;
  for (std::size_t i = 0; i < 3; ++i) {
    sampler.addWall(outer.vertices[i], outer.vertices[i + 1], 0, 10, 500, points);
  }
  auto layers = truth;
  const auto fits = fitWalls(layers, points, options());
  EXPECT_EQ(fits.at(3).support, 0U);
  EXPECT_NEAR(fits.at(3).offset, 0.0, 1e-9);
  EXPECT_LT((fits.at(3).normal - Eigen::Vector2d(-1, 0)).norm(), 1e-9);
  EXPECT_NEAR(layers[0].plan.components[0].outer.vertices[0].x(), 0.0, 1e-9);
}

TEST(FitWalls, RoofPointsTakeNoPart) {
  WallSampler sampler(kSigma, 13);
  FitPoints points;
  const auto truth = named({layer(0, 3, {rectangle(0, 0, 20, 10)})});
  sampler.addLayers(truth, 20.0, points);
  auto layers = truth;
  const auto without = fitWalls(layers, points, options());
  // A strip of roof along the lower wall, its normals 40 degrees off the vertical.
  for (int i = 0; i < 2000; ++i) {
    points.positions.emplace_back(0.01F * static_cast<float>(i), 0.2F, 2.9F);
    points.normals.emplace_back(0.0F, -std::sin(0.7F), std::cos(0.7F));
  }
  layers = truth;
  const auto with = fitWalls(layers, points, options());
  EXPECT_EQ(with.at(0).support, without.at(0).support);
  EXPECT_EQ(with.at(0).offset, without.at(0).offset);
}

TEST(FitWalls, ARingThatWouldTurnAroundKeepsItsCornersAndLosesItsIds) {
  // The points of the left wall lie right of those of the right wall.
  auto layers = named({layer(0, 10, {rectangle(0, 0, 0.2, 10)})});
  const FloorplanRing before = layers[0].plan.components[0].outer;
  WallSampler sampler(0.01, 14);
  FitPoints points;
  sampler.addWall({0.25, 10}, {0.25, 0}, 0, 10, 1000, points);    // faces left
  sampler.addWall({-0.05, 0}, {-0.05, 10}, 0, 10, 1000, points);  // faces right
  fitWalls(layers, points, options());
  const FloorplanRing& after = layers[0].plan.components[0].outer;
  EXPECT_EQ(after.vertices, before.vertices);
  for (const FloorplanEdge& edge : after.edges) EXPECT_EQ(edge.wall, -1);
}

TEST(FitWalls, TurnsAndMovesWithTheCloud) {
  WallSampler sampler(kSigma, 15);
  FitPoints points;
  sampler.addLayers(lShape(), 5.0, points);
  auto layers = lShape();
  fitWalls(layers, points, options());
  for (const double yaw : {0.7, 1.5707, 3.1, -2.0}) {
    const Eigen::Vector2d shift(300.0, -200.0);
    const Eigen::Rotation2Dd turn(yaw);
    auto turned = lShape();
    move(turned, 1.0, yaw, shift);
    FitPoints there = points;
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
      const Eigen::Vector2d p = turn * points.positions[i].head<2>().cast<double>().eval() + shift;
      const Eigen::Vector2d n = turn * points.normals[i].head<2>().cast<double>().eval();
      there.positions[i].head<2>() = p.cast<float>();
      there.normals[i].head<2>() = n.cast<float>();
    }
    fitWalls(turned, there, options());
    for (std::size_t i = 0; i < 6; ++i) {
      // Floats at 300 are good to 3e-5; a point at a gate may fall to the other side.
      EXPECT_LT((turned[0].plan.components[0].outer.vertices[i] -
                 (turn * layers[0].plan.components[0].outer.vertices[i] + shift))
                    .norm(),
                1e-3);
    }
  }
}

TEST(FitWalls, BadOptionsAndPointsGiveNothingAndChangeNothing) {
  WallSampler sampler(kSigma, 16);
  FitPoints points;
  sampler.addLayers(lShape(), 1.0, points);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    FitOptions wrong = options();
    wrong.noise = bad;
    auto layers = lShape();
    EXPECT_TRUE(fitWalls(layers, points, wrong).empty());
    EXPECT_EQ(layers[0].plan.components[0].outer.vertices,
              lShape()[0].plan.components[0].outer.vertices);
  }
  points.normals.pop_back();
  auto layers = lShape();
  EXPECT_TRUE(fitWalls(layers, points, options()).empty());
  layers.clear();
  EXPECT_TRUE(fitWalls(layers, {}, options()).empty());
}

}  // namespace
