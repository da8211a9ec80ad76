// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "evaluated_box.h"
#include "io/model_io.h"
#include "synth/accuracy_limit.h"
#include "synth/buildings.h"
#include "synth/column_overlap.h"
#include "synth/evaluation.h"
#include "synth/polygon_mesh.h"
#include "synth/sampling.h"
#include "synth/triangle_tree.h"

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using storey::io::PolygonSoup;
using storey::synth::evaluateModel;
using storey::synth::Evaluation;
using storey::synth::TriangleMesh;
using namespace storey::test;

TEST(Evaluation, ABoxAgainstItself) {
  const Evaluation e = evaluateModel(box(kLow, kHigh), box(kLow, kHigh));
  EXPECT_LT(e.vertex_to_truth.maximum, 1e-12);
  EXPECT_LT(e.truth_to_model.maximum, 1e-12);
  EXPECT_LT(e.corner_to_vertex.maximum, 1e-12);
  EXPECT_LT(e.surface.maximum, 1e-12);
  EXPECT_DOUBLE_EQ(e.overlap.iou(), 1.0);
  EXPECT_EQ(e.overlap.open_columns, 0u);
  EXPECT_EQ(e.model.polygons, 6u);
  EXPECT_EQ(e.model.corners, 8u);
  EXPECT_EQ(e.model.open_edges, 0u);
  EXPECT_EQ(e.model.broken_polygons, 0u);
  EXPECT_NEAR(e.model.volume, 20.0 * 14.0 * 24.0, 1e-9);
}

/// Moved by d along x: the four vertices that stay above the true box's faces have the distance 0,
/// the others d; every corner is off by d; the IoU is (20 - d) / (20 + d). Points on the two faces
/// across x are d away (both ways), those of the other faces on a strip of d: on average d / 2
/// over d / 20 of the face.
TEST(Evaluation, AShiftedBox) {
  const double d = 0.5;
  const Vector3d shift(d, 0.0, 0.0);
  const Evaluation e = evaluateModel(box(kLow + shift, kHigh + shift), box(kLow, kHigh));
  EXPECT_NEAR(e.vertex_to_truth.mean, 0.5 * d, 1e-12);
  EXPECT_NEAR(e.vertex_to_truth.deviation, 0.5 * d, 1e-12);
  EXPECT_NEAR(e.vertex_to_truth.maximum, d, 1e-12);
  EXPECT_NEAR(e.truth_to_model.mean, 0.5 * d, 1e-12);
  EXPECT_NEAR(e.corner_to_vertex.mean, d, 1e-12);
  EXPECT_NEAR(e.corner_to_vertex.deviation, 0.0, 1e-12);
  // 2 x 1024 cells across x are cut at random places: 20.5 / 1024 / sqrt(12 x 1024) = 2e-4 of 20.
  EXPECT_NEAR(e.overlap.iou(), (20.0 - d) / (20.0 + d), 1e-4);
  const double across = 14.0 * 24.0;
  const double other = 20.0 * 14.0 + 20.0 * 24.0;
  const double inside = across * d - (14.0 + 24.0) * d * d + 4.0 / 3.0 * d * d * d;
  const double outside = across * d;
  const double mean =
      (0.5 * (inside + outside) + other * (d / 20.0) * (d / 2.0)) / (across + other);
  EXPECT_NEAR(e.surface.mean, mean, 0.01 * mean);
  EXPECT_NEAR(e.surface.percentile_95, d, 1e-9);
  EXPECT_NEAR(e.surface.maximum, d, 1e-9);
}

/// A box smaller by d on all sides: its vertices are d inside, the true ones sqrt(3) d away.
TEST(Evaluation, ASmallerBoxSeesTheTwoDirectionsDiffer) {
  const Vector3d d = Vector3d::Constant(0.25);
  const Evaluation e = evaluateModel(box(kLow + d, kHigh - d), box(kLow, kHigh));
  EXPECT_NEAR(e.vertex_to_truth.mean, 0.25, 1e-12);
  EXPECT_NEAR(e.truth_to_model.mean, 0.25 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(e.overlap.iou(), 19.5 * 13.5 * 23.5 / (20.0 * 14.0 * 24.0), 1e-4);
}

TEST(Evaluation, IsTheSameFarAway) {
  const Vector3d shift(0.5, 0.0, 0.0);
  const Vector3d far(489000.0, 2134000.0, 2200.0);
  const Evaluation e =
      evaluateModel(box(kLow + shift + far, kHigh + shift + far), box(kLow + far, kHigh + far));
  EXPECT_NEAR(e.vertex_to_truth.mean, 0.25, 1e-8);
  EXPECT_NEAR(e.overlap.iou(), 19.5 / 20.5, 1e-4);
}

TEST(Evaluation, AnOpenMeshIsNoticed) {
  PolygonSoup open = box(kLow, kHigh);
  open.polygons.erase(open.polygons.begin() + 1);  // the roof
  const Evaluation e = evaluateModel(open, box(kLow, kHigh));
  EXPECT_EQ(e.model.open_edges, 4u);
  EXPECT_GT(e.overlap.open_columns, 0u);
  EXPECT_EQ(e.truth.open_edges, 0u);
}

TEST(Evaluation, NothingAgainstABox) {
  const Evaluation e = evaluateModel(PolygonSoup(), box(kLow, kHigh));
  EXPECT_EQ(e.vertex_to_truth.count, 0u);
  EXPECT_TRUE(std::isinf(e.truth_to_model.mean));
  EXPECT_EQ(e.overlap.iou(), 0.0);
  EXPECT_EQ(e.model.polygons, 0u);
}

TEST(PolygonMesh, PiecesOfAFaceAreOnePolygon) {
  PolygonSoup soup = box(kLow, kHigh);
  PolygonSoup triangles;
  triangles.vertices = soup.vertices;
  for (const auto& polygon : soup.polygons) {
    for (const std::array<std::size_t, 3>& cut : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      PolygonSoup::Polygon triangle = polygon;
      triangle.corners.clear();
      for (const std::size_t i : cut) {
        triangle.corners.push_back(polygon.corners[i]);
      }
      triangles.polygons.push_back(triangle);
    }
  }
  EXPECT_EQ(storey::synth::measurable(triangles).num_polygons, 6u);
  for (auto& polygon : triangles.polygons) {
    polygon.label = 0;  // as in a mesh from elsewhere
  }
  EXPECT_EQ(storey::synth::measurable(triangles).num_polygons, 6u);
}

/// The true models of named buildings, cut to hole-free pieces, are merged back to their faces.
TEST(PolygonMesh, CutModelsHaveTheirPolygonsBack) {
  for (const auto& [name, polygons] :
       {std::pair("syn1", 28u), {"syn2", 42u}, {"syn3", 22u}, {"courtyard", 10u}}) {
    const auto model = storey::extrudeFloorplans(storey::synth::makeBuilding(name).layers);
    const auto mesh = storey::synth::measurable(storey::io::toPolygons(model));
    EXPECT_EQ(mesh.num_polygons, polygons) << name;
    EXPECT_EQ(mesh.num_broken, 0u) << name;
    EXPECT_EQ(mesh.corners.size(), model.vertices.size()) << name;
  }
}

/// A layer's volume is its floorplan's area times its height.
TEST(Evaluation, VolumesOfColumnsAreThoseOfTheFloorplans) {
  for (const char* name : {"syn1", "syn2", "courtyard", "random:3"}) {
    const auto layers = storey::synth::makeBuilding(name).layers;
    double volume = 0.0;
    for (const auto& layer : layers) {
      volume += area(layer.plan) * (layer.z_max - layer.z_min);
    }
    const PolygonSoup soup = storey::io::toPolygons(storey::extrudeFloorplans(layers));
    const Evaluation e = evaluateModel(soup, soup);
    EXPECT_NEAR(e.truth.volume, volume, 1e-5 * volume) << name;
    EXPECT_NEAR(e.overlap.first, volume, 3e-4 * volume) << name;
    EXPECT_EQ(e.overlap.open_columns, 0u) << name;
    EXPECT_DOUBLE_EQ(e.overlap.iou(), 1.0) << name;
  }
}

/// What the library makes passes its own checks after a trip through pieces of polygons, upright
/// or turned and far away; with a vertex moved, a face left out or turned over it does not.
TEST(Evaluation, ChecksTheModel) {
  for (const char* name : {"syn1", "syn2", "courtyard", "shifted", "random:3"}) {
    const auto model = storey::extrudeFloorplans(storey::synth::makeBuilding(name).layers);
    PolygonSoup soup = storey::io::toPolygons(model);
    EXPECT_TRUE(evaluateModel(soup, soup, 10, 8).check.ok()) << name;
    EXPECT_EQ(evaluateModel(soup, soup, 10, 8).check.faces, model.faces.size()) << name;
    PolygonSoup broken = soup;
    broken.polygons.pop_back();
    EXPECT_GT(evaluateModel(broken, soup, 10, 8).check.open_edges, 0u) << name;
    broken = soup;
    std::reverse(broken.polygons[0].corners.begin(), broken.polygons[0].corners.end());
    EXPECT_FALSE(evaluateModel(broken, soup, 10, 8).check.ok()) << name;
    broken = soup;
    broken.vertices[0].z() += 0.01;
    EXPECT_FALSE(evaluateModel(broken, soup, 10, 8).check.ok()) << name;
    for (Vector3d& vertex : soup.vertices) {
      vertex = Eigen::AngleAxisd(0.4, Vector3d::UnitX()) * vertex + Vector3d(1e5, 2e6, -300.0);
    }
    const auto check = evaluateModel(soup, soup, 10, 8).check;
    EXPECT_TRUE(check.ok()) << name << ": " << (check.ok() ? "" : check.problems[0]);
  }
}

TEST(ColumnOverlap, KnowsTiltedSolids) {
  PolygonSoup soup = box(kLow, kHigh);
  for (Vector3d& vertex : soup.vertices) {
    vertex = Eigen::AngleAxisd(0.3, Vector3d(1.0, 2.0, 0.5).normalized()) * vertex;
  }
  const TriangleMesh mesh = storey::synth::measurable(soup).triangles;
  const auto overlap = storey::synth::overlapOfSolids(mesh, mesh);
  EXPECT_NEAR(overlap.first, 6720.0, 2.0);
  EXPECT_EQ(overlap.open_columns, 0u);
}

/// Against the smallest distance to a fine raster of points on the triangle: never above it, and
/// below it by no more than half the raster's diagonal.
TEST(TriangleDistance, AgreesWithARaster) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const auto vector = [&] {
    const double x = draw(engine);
    const double y = draw(engine);
    return Vector3d(x, y, draw(engine));
  };
  constexpr int kRaster = 120;
  for (int round = 0; round < 60; ++round) {
    const Vector3d a = vector(), b = vector(), c = vector(), p = 1.5 * vector();
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kRaster; ++i) {
      for (int j = 0; i + j <= kRaster; ++j) {
        const Vector3d q = a + (i * (b - a) + j * (c - a)) / kRaster;
        least = std::min(least, (p - q).norm());
      }
    }
    const double step = ((b - a).norm() + (c - a).norm()) / kRaster;
    const double distance = storey::synth::distanceToTriangle(p, a, b, c);
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - step);
  }
}

TEST(TriangleDistance, TreeAgreesWithBruteForce) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> draw(-10.0, 10.0);
  TriangleMesh mesh;
  for (int t = 0; t < 300; ++t) {
    const Vector3d center(draw(engine), draw(engine), draw(engine));
    for (int i = 0; i < 3; ++i) {
      mesh.vertices.push_back(center + 0.1 * Vector3d(draw(engine), draw(engine), draw(engine)));
    }
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  mesh.triangles.push_back({0, 0, 1});  // no area: its edge counts
  const storey::synth::TriangleTree tree(mesh);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p(1.2 * draw(engine), 1.2 * draw(engine), 1.2 * draw(engine));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      least = std::min(least, storey::synth::distanceToTriangle(
                                  p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
    }
    EXPECT_EQ(tree.distance(p), least);
    EXPECT_EQ(tree.distance(p, 1.01 * least), least);
    EXPECT_TRUE(std::isinf(tree.distance(p, 0.99 * least)));
  }
  EXPECT_TRUE(std::isinf(storey::synth::TriangleTree(TriangleMesh()).distance(kLow)));
}

/// The box's corners are convex with right angles and all alike, so the measure is the mean over
/// three independent errors, of the two walls at their ends (2 s / sqrt(n)) and the height: outside
/// the root of the squares of the positive ones, inside the smallest.
TEST(AccuracyLimit, OfABoxIsTheMeanOverThreeGaussians) {
  const double sigma = 0.1;
  const double points = 200000.0;
  const double density = points / (2.0 * (20.0 + 14.0) * 24.0);
  const Vector3d deviations(2.0 * sigma / std::sqrt(density * 14.0 * 24.0),
                            2.0 * sigma / std::sqrt(density * 20.0 * 24.0),
                            std::sqrt(sigma / (0.9032 * density * 68.0)));
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  double shifts = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const Vector3d draw(normal(engine), normal(engine), normal(engine));
    const Vector3d e = draw.cwiseProduct(deviations);
    const bool outside = e.maxCoeff() > 0.0;
    sum += outside ? e.cwiseMax(0.0).norm() : e.cwiseAbs().minCoeff();
    shifts += e.norm();
  }
  const auto limit =
      storey::synth::cramerRaoLimit(storey::synth::makeBuilding("box").layers, 200000, sigma);
  // 400 draws of 8 vertices with 10 errors among them: deviation about 3 % of the mean.
  EXPECT_NEAR(limit.vertex_to_facet, sum / kDraws, 0.1 * sum / kDraws);
  EXPECT_NEAR(limit.corner_displacement, shifts / kDraws, 0.1 * shifts / kDraws);
}

/// The number in the docstring: integral of phi^2 / Phi by the trapezoidal rule.
TEST(AccuracyLimit, InformationOfABlurredStep) {
  double sum = 0.0;
  constexpr double kStep = 1e-3;
  for (double x = -30.0; x < 30.0; x += kStep) {
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI);
    sum += kStep * density * density / (0.5 * std::erfc(-x / std::sqrt(2.0)));
  }
  EXPECT_NEAR(sum, 0.9032, 5e-5);
}

/// Least squares through the points of one wall of the box, 300 clouds: the error at the wall's
/// end has the deviation that the limit is built on. It is known to 1 / sqrt(600) = 4 %.
TEST(AccuracyLimit, LinesThroughSampledWallsAreAsGoodAsItSays) {
  const auto layers = storey::synth::makeBuilding("box").layers;
  storey::synth::SamplingOptions options;
  options.points = 2000;
  options.normal_noise = 0.0;
  double squares = 0.0;
  constexpr int kClouds = 300;
  for (int seed = 0; seed < kClouds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const auto cloud = sampleBuilding(layers, options);
    Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
    Vector2d right_side = Vector2d::Zero();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.normals[i].x() > 0.5) {
        const Vector2d row(1.0, cloud.positions[i].y());
        normal_matrix += row * row.transpose();
        right_side += row * (cloud.positions[i].x() - 10.0);
      }
    }
    const Vector2d line = normal_matrix.ldlt().solve(right_side);
    squares += std::pow(line[0] + 7.0 * line[1], 2);
  }
  const double wall_points = 2000.0 * 14.0 / 68.0;
  const double expected = 2.0 * 0.1 / std::sqrt(wall_points);
  EXPECT_NEAR(std::sqrt(squares / kClouds), expected, 4.0 * 0.04 * expected);
}

TEST(AccuracyLimit, SampledRoofsFixTheHeights) {
  const auto layers = storey::synth::makeBuilding("syn1").layers;
  const auto walls = storey::synth::cramerRaoLimit(layers, 933455, 0.1);
  const auto all =
      storey::synth::cramerRaoLimit(layers, 933455, 0.1, storey::synth::SampledFaces::All);
  EXPECT_GT(walls.vertex_to_facet, all.vertex_to_facet);
  EXPECT_EQ(storey::synth::cramerRaoLimit({}, 100, 0.1).vertex_to_facet, 0.0);
  EXPECT_EQ(storey::synth::cramerRaoLimit(layers, 0, 0.1).vertex_to_facet, 0.0);
  EXPECT_EQ(storey::synth::cramerRaoLimit(layers, 100, 0.0).vertex_to_facet, 0.0);
}

}  // namespace
