// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/layerwise_model.h>

#include <cmath>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.1;

// An L under a tower on one of its arms, no wall of which goes on.
std::vector<FloorplanLayer> blocks() {
  std::vector<FloorplanLayer> layers = {
      layer(0, 8, {ring({{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 15}, {0, 15}})}),
      layer(8, 17, {ring({{1.5, 2}, {8, 2}, {7, 13}, {1.5, 13}})})};
  int next = 0;
  for (FloorplanLayer& l : layers) {
    for (FloorplanEdge& edge : l.plan.components[0].outer.edges) edge.wall = next++;
  }
  return layers;
}

// The error of each coordinate of each vertex against the deviation that the model states.
TEST(LayerwiseModel, ErrorsAreWithinTwoStatedDeviationsInNineteenOfTwentyCases) {
  const std::vector<FloorplanLayer> truth = blocks();
  const PolyhedralModel exact = extrudeFloorplans(truth);
  int within = 0;
  int count = 0;
  for (unsigned draw = 0; draw < 60; ++draw) {
    WallSampler sampler(kSigma, 500 + draw);
    FitPoints points;
    sampler.addLayers(truth, 10.0, points);
    std::vector<FloorplanLayer> found = truth;
    std::uniform_real_distribution<double> off(-0.2, 0.2);
    found[0].z_min += off(sampler.random());
    found[0].z_max = found[1].z_min += off(sampler.random());
    found[1].z_max += off(sampler.random());
    LayerwiseModelOptions options;
    options.noise = 1.05 * kSigma;  // as estimated before the walls are known
    options.slice_thickness = 6.0 * kSigma;
    const LayerwiseModel result = buildModelOfBlocks(found, points, options);
    ASSERT_TRUE(result.check.ok());
    ASSERT_EQ(result.model.vertices.size(), exact.vertices.size());
    ASSERT_EQ(result.model.covariances.size(), exact.vertices.size());
    for (const Eigen::Vector3d& v : exact.vertices) {
      std::size_t nearest = 0;
      for (std::size_t i = 0; i < result.model.vertices.size(); ++i) {
        if ((result.model.vertices[i] - v).norm() < (result.model.vertices[nearest] - v).norm()) {
          nearest = i;
        }
      }
      for (int axis = 0; axis < 3; ++axis) {
        const double deviation = std::sqrt(result.model.covariances[nearest](axis, axis));
        within += std::abs(result.model.vertices[nearest][axis] - v[axis]) < 2.0 * deviation;
        ++count;
      }
    }
  }
  // 20 vertices: 60 x 60 errors of 60 x (2 x 10 walls + 3 levels) = 1380 independent ones or, where
  // directions are shared, 800: 95.45 % give or take 0.75 %.
  EXPECT_EQ(count, 60 * 60);
  EXPECT_NEAR(static_cast<double>(within) / count, 0.9545, 3.0 * 0.0075);
}

TEST(LayerwiseModel, KnowsWhatWasSeen) {
  WallSampler sampler(kSigma, 1);
  FitPoints points;
  sampler.addLayers(blocks(), 10.0, points);
  FitPoints seen;  // the wall at x = 20 is missing
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    if (points.normals[i].x() > 0.9F && points.positions[i].x() > 15.0F) continue;
    seen.positions.push_back(points.positions[i]);
    seen.normals.push_back(points.normals[i]);
  }
  LayerwiseModelOptions options;
  options.noise = kSigma;
  options.slice_thickness = 6.0 * kSigma;
  const LayerwiseModel result = buildModelOfBlocks(blocks(), seen, options);
  for (const PolyhedralFace& face : result.model.faces) {
    const bool is_seen = face.label == FaceLabel::Wall && face.wall != 1;
    EXPECT_EQ(face.hypothetical, !is_seen);
    if (face.label == FaceLabel::Wall) {
      EXPECT_EQ(std::isfinite(face.deviation), is_seen);
      EXPECT_GT(face.coverage, is_seen ? 0.98 : -1.0);
    } else {
      EXPECT_LT(face.deviation, 0.2 * kSigma);  // no points of its own, but walls end there
    }
  }
  for (std::size_t v = 0; v < result.model.vertices.size(); ++v) {
    EXPECT_EQ(std::isinf(result.model.vertexDeviation(v)), result.model.vertices[v].x() > 15.0);
  }
}

}  // namespace
