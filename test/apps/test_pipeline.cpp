// SPDX-License-Identifier: BSD-3-Clause
// The whole way, file to model, against known truth.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <algorithm>
#include <random>

#include "io/failure.h"
#include "io/model_io.h"
#include "reconstruct/pipeline.h"
#include "synth/accuracy_limit.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/evaluation.h"
#include "synth/sampling.h"
#include "temporary_files.h"

namespace storey::reconstruct {
namespace {

constexpr std::size_t kPoints = 60000;
// The paper's largest mean error on its synthetic buildings, at the same noise and 15 times as many
// points.
constexpr double kPaperError = 0.0181;

synth::SamplingOptions sampling() {
  synth::SamplingOptions options;
  options.points = kPoints;
  return options;
}

struct Outcome {
  Result result;
  synth::Evaluation evaluation;
};

Outcome reconstructCloud(const synth::SyntheticCloud& cloud,
                         const std::vector<FloorplanLayer>& layers, const synth::Pose& pose,
                         Options options, bool with_normals = true) {
  const test::TemporaryDirectory directory;
  options.input = directory.file("cloud.ply");
  options.quiet = true;
  synth::writeCloudPly(options.input, cloud, synth::needsDouble(cloud), with_normals);
  Outcome outcome;
  outcome.result = reconstruct(options);
  io::PolygonSoup model = io::toPolygons(outcome.result.model.model);
  for (Eigen::Vector3d& v : model.vertices) v = outcome.result.local_to_input * v;
  io::PolygonSoup truth = io::toPolygons(extrudeFloorplans(layers));
  for (Eigen::Vector3d& v : truth.vertices) v = pose.apply(v);
  outcome.evaluation = synth::evaluateModel(model, truth, 20000, 200);
  return outcome;
}

Outcome reconstructBuilding(const std::string& name, const synth::SamplingOptions& sampled,
                            const Options& options, bool with_normals = true) {
  const std::vector<FloorplanLayer> layers = synth::makeBuilding(name).layers;
  return reconstructCloud(synth::sampleBuilding(layers, sampled), layers, sampled.pose, options,
                          with_normals);
}

class Buildings : public ::testing::TestWithParam<std::tuple<std::string, Method>> {};

TEST_P(Buildings, AreFoundWithAllTheirPolygons) {
  Options options;
  options.method = std::get<1>(GetParam());
  const Outcome outcome = reconstructBuilding(std::get<0>(GetParam()), sampling(), options);
  EXPECT_TRUE(outcome.result.model.check.ok());
  EXPECT_EQ(outcome.evaluation.model.polygons, outcome.evaluation.truth.polygons);
  EXPECT_GT(outcome.evaluation.overlap.iou(), 0.99);
  EXPECT_LT(outcome.evaluation.vertex_to_truth.mean, kPaperError);
}

INSTANTIATE_TEST_SUITE_P(Named, Buildings,
                         ::testing::Combine(::testing::Values("box", "l_shape", "courtyard",
                                                              "two_towers", "hexagon", "overhang"),
                                            ::testing::Values(Method::Building, Method::Paper)));

TEST(Pipeline, IsTheSameInEveryPose) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double offset : {0.0, 4e5}) {
      synth::SamplingOptions sampled = sampling();
      sampled.pose.yaw = 0.7;
      sampled.pose.tilt = 0.05;
      sampled.pose.scale = scale;
      sampled.pose.offset = offset * scale * Eigen::Vector3d(1.0, 13.0, 0.2);
      const Outcome outcome = reconstructBuilding("two_towers", sampled, {});
      EXPECT_TRUE(outcome.result.model.check.ok()) << scale << " " << offset;
      EXPECT_EQ(outcome.evaluation.model.polygons, outcome.evaluation.truth.polygons)
          << scale << " " << offset;
      EXPECT_GT(outcome.evaluation.overlap.iou(), 0.99) << scale << " " << offset;
      EXPECT_FALSE(outcome.result.attitude.level);
    }
  }
}

TEST(Pipeline, GivesTheSameModelForAnyNumberOfThreads) {
  for (const Method method : {Method::Building, Method::Paper}) {
    Options options;
    options.method = method;
    options.threads = 1;
    const PolyhedralModel one =
        reconstructBuilding("l_shape", sampling(), options).result.model.model;
    options.threads = 4;
    const PolyhedralModel four =
        reconstructBuilding("l_shape", sampling(), options).result.model.model;
    ASSERT_EQ(one.vertices.size(), four.vertices.size());
    for (std::size_t i = 0; i < one.vertices.size(); ++i) {
      EXPECT_EQ(one.vertices[i], four.vertices[i]);
    }
  }
}

// The structure is found in a sixth of the points, and the walls are where all of them say.
TEST(Pipeline, FitsToAllPointsWhatItFoundInASample) {
  synth::SamplingOptions sampled = sampling();
  sampled.points = 6 * kPoints;
  for (const Method method : {Method::Building, Method::Paper}) {
    Options options;
    options.method = method;
    options.structure_points = kPoints;
    const Outcome outcome = reconstructBuilding("two_towers", sampled, options);
    EXPECT_EQ(outcome.result.cloud.points->size(), kPoints);
    EXPECT_EQ(outcome.result.all.points->size(), sampled.points);
    EXPECT_EQ(outcome.evaluation.model.polygons, outcome.evaluation.truth.polygons);
    std::size_t support = 0;
    for (const auto& face : outcome.result.model.model.faces) support += face.support;
    EXPECT_GT(support, 5 * kPoints);
    const double limit = synth::cramerRaoLimit(synth::makeBuilding("two_towers").layers,
                                               sampled.points, sampled.noise)
                             .vertex_to_facet;
    EXPECT_LT(outcome.evaluation.vertex_to_truth.mean, 2.0 * limit);
  }
}

TEST(Pipeline, TakesACloudInMemoryAsItTakesAFile) {
  const test::TemporaryDirectory directory;
  Options options;
  options.input = directory.file("cloud.ply");
  synth::writeCloudPly(options.input,
                       synth::sampleBuilding(synth::makeBuilding("box").layers, sampling()), false,
                       true);
  const PolyhedralModel from_file = reconstruct(options).model.model;
  const PolyhedralModel from_memory = reconstruct(io::readCloud(options.input), {}).model.model;
  EXPECT_FALSE(from_memory.empty());
  EXPECT_EQ(from_file.vertices, from_memory.vertices);
}

TEST(Pipeline, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<FloorplanLayer> layers = synth::makeBuilding("l_shape").layers;
  synth::SyntheticCloud cloud = synth::sampleBuilding(layers, sampling());
  const Outcome before = reconstructCloud(cloud, layers, {}, {});
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::mt19937 generator(5);
  for (std::size_t i = order.size() - 1; i > 0; --i) {
    std::swap(order[i], order[generator() % (i + 1)]);
  }
  synth::SyntheticCloud shuffled = cloud;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.positions[i] = cloud.positions[order[i]];
    shuffled.normals[i] = cloud.normals[order[i]];
  }
  const Outcome after = reconstructCloud(shuffled, layers, {}, {});
  ASSERT_EQ(before.result.model.model.vertices.size(), after.result.model.model.vertices.size());
  for (std::size_t i = 0; i < before.result.model.model.vertices.size(); ++i) {
    // The reader has put the points in one order.
    EXPECT_EQ(before.result.model.model.vertices[i], after.result.model.model.vertices[i]);
  }
}

TEST(Pipeline, SurvivesWhatCloudsSufferFrom) {
  std::vector<std::pair<std::string, synth::SamplingOptions>> cases;
  const auto add = [&](const std::string& name, const auto& damage) {
    synth::SamplingOptions options = sampling();
    damage(options.defects);
    cases.emplace_back(name, options);
  };
  add("outliers", [](synth::Defects& d) { d.outliers = 0.1; });
  add("holes", [](synth::Defects& d) { d.missing_patches = 0.2; });
  add("flipped normals", [](synth::Defects& d) { d.flipped_normals = 0.1; });
  add("ground", [](synth::Defects& d) { d.ground = 0.1; });
  for (const auto& [name, options] : cases) {
    const Outcome outcome = reconstructBuilding("l_shape", options, {});
    EXPECT_TRUE(outcome.result.model.check.ok()) << name;
    EXPECT_GT(outcome.evaluation.overlap.iou(), 0.97) << name;
  }
  const Outcome unoriented = reconstructBuilding("l_shape", sampling(), {}, false);
  EXPECT_TRUE(unoriented.result.model.check.ok());
  EXPECT_GT(unoriented.evaluation.overlap.iou(), 0.97);
}

TEST(Pipeline, TakesAnEnclosedSpaceForWhatItIs) {
  const std::vector<FloorplanLayer> layers = synth::makeBuilding("l_shape").layers;
  synth::SyntheticCloud yard = synth::sampleBuilding(layers, sampling());
  for (Eigen::Vector3d& n : yard.normals) n = -n;
  const Outcome outcome = reconstructCloud(yard, layers, {}, {});
  EXPECT_TRUE(outcome.result.cloud.state.inside);
  EXPECT_TRUE(outcome.result.model.check.ok());
  EXPECT_GT(outcome.evaluation.overlap.iou(), 0.99);
}

TEST(Pipeline, RefusesACloudWithoutWalls) {
  synth::SamplingOptions options = sampling();
  const std::vector<FloorplanLayer> layers = synth::makeBuilding("box").layers;
  synth::SyntheticCloud cloud = synth::sampleBuilding(layers, options);
  std::mt19937 generator(3);
  for (std::size_t i = 0; i < cloud.size(); ++i) {  // gently rolling ground
    cloud.positions[i].z() = 0.05 * std::sin(0.4 * cloud.positions[i].x());
    cloud.positions[i].x() += static_cast<double>(generator() % 1000) * 0.02;
    cloud.normals[i] = Eigen::Vector3d::UnitZ();
  }
  try {
    reconstructCloud(cloud, layers, {}, {});
    FAIL() << "a model without walls";
  } catch (const io::Failure& failure) {
    EXPECT_EQ(failure.status(), io::BadInput);
  }
}

}  // namespace
}  // namespace storey::reconstruct
