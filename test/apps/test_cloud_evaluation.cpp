// SPDX-License-Identifier: BSD-3-Clause
// Models measured against clouds whose truth is not known.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "evaluated_box.h"
#include "synth/buildings.h"
#include "synth/cloud_evaluation.h"
#include "synth/polygon_mesh.h"
#include "synth/sampling.h"

namespace {

using Eigen::Vector3d;
using storey::io::PolygonSoup;
using namespace storey::test;

std::vector<storey::synth::OrientedPosition> boxPoints(double missing_walls) {
  storey::synth::SamplingOptions options;
  options.points = 100000;
  options.faces = storey::synth::SampledFaces::All;
  options.defects.missing_walls = missing_walls;
  const auto cloud = sampleBuilding(storey::synth::makeBuilding("box").layers, options);
  std::vector<storey::synth::OrientedPosition> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    points.push_back({cloud.positions[i], cloud.normals[i]});
  }
  return points;
}

/// A Gaussian stays within 3 deviations with 0.9973; cells with 6 points on average are empty in
/// 0.25 % of the cases, those cut by the ends of a wall more often.
TEST(CloudEvaluation, AGoodModelExplainsTheCloudAndIsSupported) {
  const double density = 100000.0 / (2.0 * (20.0 * 14.0 + 20.0 * 24.0 + 14.0 * 24.0));
  const auto e = storey::synth::evaluateAgainstCloud(box(kLow, kHigh), boxPoints(0.0),
                                                     Vector3d::UnitZ(), 0.1, density);
  EXPECT_NEAR(e.explainedShare(), 0.9973, 0.001);
  EXPECT_GT(e.supportedShare(), 0.98);
  EXPECT_NEAR(e.wall_area, 68.0 * 24.0, 1e-9);
  EXPECT_NEAR(e.cell_size, std::sqrt(6.0 / density), 1e-12);  // larger than 3 sigma
}

TEST(CloudEvaluation, MissingWallsAreNotSupported) {
  const double density = 100000.0 / (2.0 * (20.0 * 14.0 + 20.0 * 24.0 + 14.0 * 24.0));
  const auto e = storey::synth::evaluateAgainstCloud(box(kLow, kHigh), boxPoints(0.25),
                                                     Vector3d::UnitZ(), 0.1, density);
  // One of four walls: 14 or 20 of 68. Its ends are touched by points of its neighbours.
  const double left = 1.0 - e.supportedShare();
  EXPECT_TRUE(std::abs(left - 14.0 / 68.0) < 0.03 || std::abs(left - 20.0 / 68.0) < 0.03) << left;
  EXPECT_GT(e.explainedShare(), 0.99);
}

TEST(CloudEvaluation, WallsMarkedAsGuessedAreLeftOutOfTheShareOfTheOthers) {
  const double density = 100000.0 / (2.0 * (20.0 * 14.0 + 20.0 * 24.0 + 14.0 * 24.0));
  const auto points = boxPoints(0.25);
  PolygonSoup model = box(kLow, kHigh);
  double best = 0.0;  // where it is the wall without points that is marked
  for (PolygonSoup::Polygon& polygon : model.polygons) {
    polygon.hypothetical = true;
    const auto e =
        storey::synth::evaluateAgainstCloud(model, points, Vector3d::UnitZ(), 0.1, density);
    best = std::max(best, e.supportedShownShare());
    polygon.hypothetical = false;
  }
  EXPECT_GT(best, 0.98);
  for (PolygonSoup::Polygon& polygon : model.polygons) polygon.hypothetical = true;
  const auto e =
      storey::synth::evaluateAgainstCloud(model, points, Vector3d::UnitZ(), 0.1, density);
  EXPECT_EQ(e.shown_area, 0.0);
  EXPECT_EQ(e.supportedShownShare(), 0.0);
  EXPECT_GT(e.supportedShare(), 0.5);
}

TEST(CloudEvaluation, AWrongModelExplainsLittle) {
  const Vector3d shift(2.0, 2.0, 0.0);
  const double density = 100000.0 / (2.0 * (20.0 * 14.0 + 20.0 * 24.0 + 14.0 * 24.0));
  const auto e = storey::synth::evaluateAgainstCloud(
      box(kLow + shift, kHigh + shift), boxPoints(0.0), Vector3d::UnitZ(), 0.1, density);
  EXPECT_LT(e.explainedShare(), 0.1);
  EXPECT_LT(e.supportedShare(), 0.1);
}

TEST(CloudEvaluation, TakesTheVerticalFromTheRoof) {
  PolygonSoup soup = box(kLow, kHigh);
  const Eigen::AngleAxisd turn(1.1, Vector3d(1.0, -1.0, 0.3).normalized());
  for (Vector3d& vertex : soup.vertices) {
    vertex = turn * vertex;
  }
  EXPECT_LT((storey::synth::upOfModel(soup) - turn * Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(storey::synth::upOfModel(PolygonSoup()), Vector3d::UnitZ());
}

}  // namespace
