// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_fitting.h>

#include <cmath>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.1;
constexpr double kDensity = 20.0;

// An L-shape, whose walls are 0 to 5 in the order of its corners.
std::vector<FloorplanLayer> lShape() {
  std::vector<FloorplanLayer> layers = {
      layer(0, 10, {ring({{0, 0}, {20, 0}, {20, 9}, {10, 9}, {10, 18}, {0, 18}})})};
  int next = 0;
  for (FloorplanEdge& edge : layers[0].plan.components[0].outer.edges) edge.wall = next++;
  return layers;
}

FitPoints pointsWithout(std::size_t unseen, unsigned seed) {
  WallSampler sampler(kSigma, seed);
  FitPoints points;
  const FloorplanRing ring = lShape()[0].plan.components[0].outer;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (i == unseen) continue;
    const Eigen::Vector2d& a = ring.vertices[i];
    const Eigen::Vector2d& b = ring.vertices[(i + 1) % ring.size()];
    std::poisson_distribution<std::size_t> count(kDensity * 10.0 * (b - a).norm());
    sampler.addWall(a, b, 0, 10, count(sampler.random()), points);
  }
  return points;
}

FitOptions options() {
  FitOptions result;
  result.noise = kSigma;
  return result;
}

// The layers with one wall moved outwards.
std::vector<FloorplanLayer> shifted(std::size_t wall, double by) {
  std::vector<FloorplanLayer> layers = lShape();
  FloorplanRing& ring = layers[0].plan.components[0].outer;
  Eigen::Vector2d& a = ring.vertices[wall];
  Eigen::Vector2d& b = ring.vertices[(wall + 1) % ring.size()];
  const Eigen::Vector2d along = (b - a).normalized();
  const Eigen::Vector2d outwards(along.y(), -along.x());
  a += by * outwards;
  b += by * outwards;
  return layers;
}

TEST(FitUnseenWalls, AWallLiesWhereItsNeighborsEnd) {
  // Convex corners, reflex ones, and one of each; found up to 8 deviations off. Two ends of density
  // 200 a unit tell the wall to sqrt(sigma / (0.9 x 400)) = 0.017 or somewhat more; the mean square
  // of the 8 draws of each in stated deviations is 1 but for 3.5 sqrt(2 / 48).
  double squares = 0.0;
  int count = 0;
  for (const std::size_t wall : {1U, 2U, 4U}) {
    for (const double shift : {-0.8, 0.5}) {
      for (unsigned draw = 0; draw < 8; ++draw) {
        const FitPoints points = pointsWithout(wall, 40 + draw);
        std::vector<FloorplanLayer> layers = shifted(wall, shift);
        std::map<int, WallFit> fits = fitWalls(layers, points, options());
        const std::map<int, WallFit> before = fits;
        fitUnseenWalls(layers, points, kSigma, fits);
        const WallFit& fit = fits.at(static_cast<int>(wall));
        const FloorplanRing truth = lShape()[0].plan.components[0].outer;
        const FloorplanRing& found = layers[0].plan.components[0].outer;
        const double error = fit.normal.dot(fit.centre - truth.vertices[wall]);
        EXPECT_LT(fit.offset_deviation, 0.025);
        EXPECT_LT(std::abs(error), 4.0 * fit.offset_deviation) << wall << ' ' << shift;
        squares += error * error / (fit.offset_deviation * fit.offset_deviation);
        ++count;
        for (std::size_t i = 0; i < 6; ++i) {
          EXPECT_LT((found.vertices[i] - truth.vertices[i]).norm(), 0.1);
          if (i == wall) continue;
          EXPECT_EQ(fits.at(static_cast<int>(i)).offset, before.at(static_cast<int>(i)).offset);
        }
      }
    }
  }
  EXPECT_NEAR(squares / count, 1.0, 3.5 * std::sqrt(2.0 / count));
}

TEST(FitUnseenWalls, AWallThatIsSeenStays) {
  const FitPoints points = pointsWithout(6, 60);  // all are there
  std::vector<FloorplanLayer> layers = lShape();
  std::map<int, WallFit> fits = fitWalls(layers, points, options());
  const std::vector<FloorplanLayer> before = layers;
  fitUnseenWalls(layers, points, kSigma, fits);
  EXPECT_EQ(layers[0].plan.components[0].outer.vertices,
            before[0].plan.components[0].outer.vertices);
}

TEST(FitUnseenWalls, AWallWhoseNeighborsAreNotSeenStays) {
  FitPoints points = pointsWithout(1, 61);
  FitPoints rest;  // without wall 0, 1 and 2: x < 10 but for the walls below
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    if (points.positions[i].x() > 11.0F || points.positions[i].y() < 1.0F) continue;
    rest.positions.push_back(points.positions[i]);
    rest.normals.push_back(points.normals[i]);
  }
  std::vector<FloorplanLayer> layers = shifted(1, 0.5);
  std::map<int, WallFit> fits = fitWalls(layers, rest, options());
  const double before = fits.at(1).offset;
  fitUnseenWalls(layers, rest, kSigma, fits);
  EXPECT_EQ(fits.at(1).offset, before);
}

}  // namespace
