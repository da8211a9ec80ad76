// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/model_refinement.h>

#include <cmath>

#include "stacks.h"
#include "wall_points.h"

namespace {

using namespace storey;
using namespace storey::test;

constexpr double kSigma = 0.1;
constexpr std::size_t kThinning = 10;  // points for each of the sample

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

LayerwiseModelOptions modelOptions() {
  LayerwiseModelOptions options;
  options.noise = 1.05 * kSigma;
  options.slice_thickness = 6.0 * kSigma;
  return options;
}

// A fifth of the points is set back where there are panes.
FitPoints sample(unsigned seed, bool panes) {
  WallSampler sampler(kSigma, seed);
  FitPoints points;
  sampler.addLayers(blocks(), 60.0, points);
  for (std::size_t i = 0; panes && i < points.positions.size(); i += 5) {
    points.positions[i] -= 0.3F * points.normals[i];
  }
  return points;
}

// Points begin, begin + step, ...
FitPoints every(const FitPoints& points, std::size_t begin, std::size_t step) {
  FitPoints part;
  for (std::size_t i = begin; i < points.positions.size(); i += step) {
    part.positions.push_back(points.positions[i]);
    part.normals.push_back(points.normals[i]);
  }
  return part;
}

LayerwiseModel refined(const LayerwiseModel& of_sample, const FitPoints& some, const FitPoints& all,
                       std::size_t parts) {
  LayerwiseModel model = of_sample;
  ModelRefinement refinement(some, modelOptions(), model);
  for (std::size_t k = 0; k < parts; ++k) refinement.add(every(all, k, parts));
  refinement.finish();
  return model;
}

// Mean squares of how far walls and heights are from those of all points, in deviations of these.
struct Distances {
  double walls = 0.0;
  double levels = 0.0;
};

void add(const LayerwiseModel& model, const LayerwiseModel& of_all, double weight,
         Distances& distances) {
  for (const auto& [id, wall] : of_all.walls) {
    const WallFit& other = model.walls.at(id);
    const double off = other.normal.dot(wall.centre) - other.offset;
    distances.walls += weight * std::pow(off / wall.offset_deviation, 2) /
                       static_cast<double>(of_all.walls.size());
  }
  for (std::size_t k = 0; k < of_all.levels.size(); ++k) {
    const double off = model.levels[k].z - of_all.levels[k].z;
    distances.levels += weight * std::pow(off / of_all.levels[k].deviation, 2) /
                        static_cast<double>(of_all.levels.size());
  }
}

class ModelRefinements : public testing::TestWithParam<bool> {};

// A model of a tenth of the points is off by three deviations of what all points tell.
TEST_P(ModelRefinements, LeadToTheModelOfAllPoints) {
  constexpr int kDraws = 20;
  Distances before;
  Distances after;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    const FitPoints all = sample(100 + draw, GetParam());
    const FitPoints some = every(all, 3, kThinning);
    const LayerwiseModel of_all = buildModelOfBlocks(blocks(), all, modelOptions());
    const LayerwiseModel of_some = buildModelOfBlocks(blocks(), some, modelOptions());
    const LayerwiseModel model = refined(of_some, some, all, 7);
    EXPECT_TRUE(model.check.ok());
    EXPECT_EQ(model.model.faces.size(), of_all.model.faces.size());
    add(of_some, of_all, 1.0 / kDraws, before);
    add(model, of_all, 1.0 / kDraws, after);
    for (const auto& [id, wall] : model.walls) {
      EXPECT_NEAR(wall.offset_deviation / of_all.walls.at(id).offset_deviation, 1.0, 0.1);
      const auto support = static_cast<double>(of_all.walls.at(id).support);
      EXPECT_NEAR(static_cast<double>(wall.support), support, 0.02 * support);
    }
  }
  EXPECT_GT(before.walls, 4.0);
  EXPECT_GT(before.levels, 2.0);
  EXPECT_LT(after.walls, 0.2);
  EXPECT_LT(after.levels, 0.2);
}

INSTANTIATE_TEST_SUITE_P(PlainAndWithPanes, ModelRefinements, testing::Bool());

TEST(ModelRefinement, DoesNotDependOnTheParts) {
  const FitPoints all = sample(5, false);
  const FitPoints some = every(all, 3, kThinning);
  const LayerwiseModel of_some = buildModelOfBlocks(blocks(), some, modelOptions());
  const LayerwiseModel one = refined(of_some, some, all, 1);
  const LayerwiseModel many = refined(of_some, some, all, 50);
  ASSERT_EQ(one.model.vertices.size(), many.model.vertices.size());
  for (std::size_t i = 0; i < one.model.vertices.size(); ++i) {
    EXPECT_LT((one.model.vertices[i] - many.model.vertices[i]).norm(), 2.0 * one.model.grid);
  }
}

TEST(ModelRefinement, WithoutPointsNothingChanges) {
  const FitPoints some = every(sample(5, false), 3, kThinning);
  const LayerwiseModel model = buildModelOfBlocks(blocks(), some, modelOptions());
  EXPECT_EQ(refined(model, some, {}, 0).model.vertices, model.model.vertices);
  EXPECT_EQ(refined(model, some, {}, 3).model.vertices, model.model.vertices);
}

// The points of one of the walls are missing in all parts: it stays.
TEST(ModelRefinement, AWallWithoutPointsStays) {
  const FitPoints all = sample(5, false);
  const FitPoints some = every(all, 3, kThinning);
  const LayerwiseModel of_some = buildModelOfBlocks(blocks(), some, modelOptions());
  FitPoints others;
  for (std::size_t i = 0; i < all.positions.size(); ++i) {
    if (all.positions[i].x() > 19.0F && all.normals[i].x() > 0.9F) continue;
    others.positions.push_back(all.positions[i]);
    others.normals.push_back(all.normals[i]);
  }
  const LayerwiseModel model = refined(of_some, some, others, 2);
  EXPECT_TRUE(model.check.ok());
  EXPECT_EQ(model.walls.at(1).offset, of_some.walls.at(1).offset);  // from (20, 0) to (20, 8)
  EXPECT_NE(model.walls.at(0).offset, of_some.walls.at(0).offset);
}

}  // namespace
