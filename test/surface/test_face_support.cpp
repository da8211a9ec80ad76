// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/face_support.h>

#include <cmath>
#include <limits>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.02;
constexpr double kDensity = 100.0;  // cells of sqrt(6 / 100) = 0.245

PolyhedralModel box() { return extrudeFloorplans({layer(0, 6, {rectangle(0, 0, 10, 8)})}); }

// The face that looks in a direction.
PolyhedralFace& facing(PolyhedralModel& model, const Eigen::Vector3d& direction) {
  for (PolyhedralFace& face : model.faces) {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    const auto at = [&](std::size_t i) {
      return model.vertices[static_cast<std::size_t>(face.outer[i % face.outer.size()])];
    };
    for (std::size_t i = 0; i < face.outer.size(); ++i) {
      twice += (at(i) - at(0)).cross(at(i + 1) - at(0));
    }
    if (twice.normalized().dot(direction) > 0.999) return face;
  }
  throw std::runtime_error("no face looks there");
}

const Eigen::Vector3d kSouth(0, -1, 0);
const Eigen::Vector3d kEast(1, 0, 0);
const Eigen::Vector3d kUp(0, 0, 1);

TEST(FaceSupport, OfAFaceThatWasSeen) {
  PolyhedralModel model = box();
  WallSampler sampler(kSigma, 1);
  FitPoints points;
  const std::size_t count = 10 * 6 * 100;
  sampler.addWall({0, 0}, {10, 0}, 0, 6, count, points);
  measureSupport(points, kSigma, model);
  const PolyhedralFace& south = facing(model, kSouth);
  // Points within 3 sigma: 99.73 %; a strip of 0.4 sigma around the face loses the points beyond.
  const double strip = 2.0 * 0.4 * kSigma * (1.0 / 10 + 1.0 / 6);
  EXPECT_NEAR(static_cast<double>(south.support), 0.9973 * (1.0 - strip) * count,
              4.0 * std::sqrt(0.01 * count));
  // Empty cells: exp(-6) of 41 x 24, four deviations.
  EXPECT_GT(south.coverage, 1.0 - std::exp(-6.0) - 4.0 * std::sqrt(std::exp(-6.0) / (41 * 24)));
  // A normal distribution cut at 3 sigma has a variance of 1 - 6 phi(3) / 0.9973.
  const double residual = kSigma * std::sqrt(1.0 - 6.0 * 0.0044318 / 0.9973);
  EXPECT_NEAR(south.residual, residual, 4.0 * residual / std::sqrt(2.0 * count));
  EXPECT_FALSE(south.hypothetical);
  for (PolyhedralFace& face : model.faces) {
    if (&face == &south) continue;
    EXPECT_EQ(face.support, 0U);
    EXPECT_EQ(face.coverage, 0.0);
    EXPECT_EQ(face.residual, 0.0);
    EXPECT_TRUE(face.hypothetical);
  }
}

TEST(FaceSupport, TheShareOfAFaceThatWasSeen) {
  for (const double share : {0.2, 0.5, 0.8}) {
    PolyhedralModel model = box();
    WallSampler sampler(kSigma, 2);
    FitPoints points;
    sampler.addWall({10, 0}, {10, 8}, 0, 6, 8 * 6 * 100, points);  // the east, in full
    sampler.addWall({0, 0}, {10 * share, 0}, 0, 6, static_cast<std::size_t>(6000 * share), points);
    measureSupport(points, kSigma, model);
    const PolyhedralFace& south = facing(model, kSouth);
    EXPECT_NEAR(south.coverage, share, 0.245 / 10 + 0.01);  // the border runs through cells
    EXPECT_EQ(south.hypothetical, share < 1.0 / 3);
    EXPECT_GT(facing(model, kEast).coverage, 0.99);
  }
}

TEST(FaceSupport, NormalsMustAgree) {
  FitPoints outwards;
  WallSampler sampler(kSigma, 3);
  sampler.addWall({0, 0}, {10, 0}, 0, 6, 6000, outwards);
  FitPoints inwards = outwards;
  for (Eigen::Vector3f& n : inwards.normals) n = -n;
  FitPoints level = outwards;
  for (Eigen::Vector3f& n : level.normals) n = {0, 0, 1};
  FitPoints unknown = outwards;
  for (Eigen::Vector3f& n : unknown.normals) n.setZero();
  PolyhedralModel model = box();
  measureSupport(inwards, kSigma, model);
  EXPECT_EQ(facing(model, kSouth).support, 0U);
  measureSupport(level, kSigma, model);
  EXPECT_EQ(facing(model, kSouth).support, 0U);
  measureSupport(unknown, kSigma, model);
  EXPECT_GT(facing(model, kSouth).coverage, 0.99);
}

TEST(FaceSupport, LevelFacesWithHoles) {
  // A roof around a tower: points on all of it, and as many below the tower's foot, which are of
  // no face.
  const auto layers = std::vector<FloorplanLayer>{layer(0, 3, {rectangle(0, 0, 10, 10)}),
                                                  layer(3, 6, {rectangle(3, 3, 7, 7)})};
  PolyhedralModel model = extrudeFloorplans(layers);
  FitPoints points;
  std::size_t on_roof = 0;
  for (double x = 0.05; x < 10.0; x += 0.1) {
    for (double y = 0.05; y < 10.0; y += 0.1) {
      points.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 3.01F);
      points.normals.emplace_back(0.1F, 0.0F, 0.99F);
      on_roof += !(x > 3.0 && x < 7.0 && y > 3.0 && y < 7.0);
    }
  }
  measureSupport(points, kSigma, model);
  for (const PolyhedralFace& face : model.faces) {
    const bool lower = face.label == FaceLabel::Roof && !face.inner.empty();
    EXPECT_EQ(face.support, lower ? on_roof : 0U);
    EXPECT_EQ(face.coverage, lower ? 1.0 : 0.0);
    EXPECT_EQ(face.hypothetical, !lower);
    EXPECT_NEAR(face.residual, lower ? 0.01 : 0.0, 1e-5);
  }
}

TEST(FaceSupport, BadInputChangesNothing) {
  PolyhedralModel model = box();
  FitPoints points;
  WallSampler sampler(kSigma, 4);
  sampler.addWall({0, 0}, {10, 0}, 0, 6, 100, points);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    measureSupport(points, bad, model);
    EXPECT_EQ(facing(model, kSouth).support, 0U);
    EXPECT_FALSE(facing(model, kSouth).hypothetical);
  }
  measureSupport({}, kSigma, model);
  EXPECT_TRUE(facing(model, kSouth).hypothetical);
}

// The walls of a parallelogram whose sides meet at 60 degrees, of given deviations.
TEST(ModelDeviations, OfACrossingOfTwoWalls) {
  const Eigen::Vector2d slanted(0.5, std::sqrt(0.75));
  auto layers = std::vector<FloorplanLayer>{
      layer(0, 6, {ring({{0, 0}, {10, 0}, Eigen::Vector2d(10, 0) + 8 * slanted, 8 * slanted})})};
  for (std::size_t i = 0; i < 4; ++i) {
    layers[0].plan.components[0].outer.edges[i].wall = static_cast<int>(i);
  }
  std::map<int, WallFit> walls;
  for (int i = 0; i < 2; ++i) {  // the south wall and the east wall; the others were not seen
    const Eigen::Vector2d along = i == 0 ? Eigen::Vector2d(1, 0) : slanted;
    WallFit fit;
    fit.normal = {along.y(), -along.x()};
    fit.centre = Eigen::Vector2d(10, 0) + (i == 0 ? -5.0 : 4.0) * along;
    fit.offset = fit.normal.dot(fit.centre);
    fit.support = 100;
    fit.offset_deviation = i == 0 ? 0.03 : 0.01;
    fit.angle_deviation = i == 0 ? 0.008 : 0.0;
    walls[i] = fit;
  }
  walls[2].normal = {0, 1};
  walls[3].normal = {-slanted.y(), slanted.x()};
  std::vector<HeightFit> levels(2);
  levels[0].deviation = 0.02;
  levels[1].z = 6.0;
  PolyhedralModel model = extrudeFloorplans(layers);
  propagateDeviations(walls, levels, model);
  ASSERT_EQ(model.covariances.size(), model.vertices.size());
  int seen = 0;
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    const Eigen::Matrix3d& c = model.covariances[v];
    const bool low = model.vertices[v].z() < 3.0;
    if (low) {
      EXPECT_NEAR(c(2, 2), 0.02 * 0.02, 1e-12);
    } else {
      EXPECT_TRUE(std::isinf(c(2, 2)));
    }
    if ((model.vertices[v].head<2>() - Eigen::Vector2d(10, 0)).norm() > 0.1) {
      EXPECT_TRUE(std::isinf(c(0, 0)));
      EXPECT_TRUE(std::isinf(model.vertexDeviation(v)));
      continue;
    }
    ++seen;
    // y errs by e_1 = hypot(0.03, 5 x 0.008) = 0.05, and with it the corner moves along the slanted
    // wall by e_1 cot 60; the slanted wall moves it by 0.01 / sin 60 along x.
    EXPECT_NEAR(c(1, 1), 0.05 * 0.05, 1e-9);
    EXPECT_NEAR(c(0, 1), 0.05 * 0.05 / std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(c(0, 0), 0.05 * 0.05 / 3.0 + 0.01 * 0.01 / 0.75, 1e-9);
  }
  EXPECT_EQ(seen, 2);
  EXPECT_NEAR(facing(model, kSouth).deviation, 0.03, 1e-9);  // in its middle
  EXPECT_TRUE(std::isinf(facing(model, kUp).deviation));
  EXPECT_NEAR(facing(model, -kUp).deviation, 0.02, 1e-12);
}

}  // namespace
