// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/layerwise_floorplan_extraction.h>

#include <algorithm>
#include <limits>
#include <random>

#include "../point_types.h"
#include "wall_clouds.h"

namespace {

using namespace storey;
using namespace storey::test;

const Corners kL = {{0, 0}, {16, 0}, {16, 6}, {7, 6}, {7, 12}, {0, 12}};
const Corners kTower = box(0, 0, 7, 12);
constexpr double kNoise = 0.05;
// The shortest wall, 6 long, has 180 points in a slice of 1. A line is good to sigma / sqrt(180) at
// its middle, to twice that at its ends; two of them meet in a corner; 4 deviations.
const double kCornerTolerance = 4.0 * std::sqrt(2.0) * 2.0 * kNoise / std::sqrt(180.0);

// An L of height 4 under a tower up to 8, in a frame of its own.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr building(double yaw = 0.0, unsigned seed = 1) {
  WallCloudOptions options;
  options.density = 30.0;
  options.noise = kNoise;
  options.normal_noise = 5.0 * M_PI / 180.0;
  options.seed = seed;
  options.z_max = 4.0;
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  addWalls(moved(kL, yaw, {3, 5}), options, *cloud);
  options.z_min = 4.0;
  options.z_max = 8.0;
  addWalls(moved(kTower, yaw, {3, 5}), options, *cloud);
  cloud->header.frame_id = "building";
  return cloud;
}

// Bottom to top with disjoint ranges, every floorplan valid.
void expectGoodLayers(const std::vector<FloorplanLayer>& layers) {
  ASSERT_GE(layers.size(), 4U);
  bool any = false;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_LT(layers[i].z_min, layers[i].z_max);
    EXPECT_TRUE(i == 0 || layers[i].z_min >= layers[i - 1].z_max - 1e-9);
    expectValid(layers[i].plan);
    any = any || !layers[i].plan.empty();
  }
  EXPECT_TRUE(any);
}

// Every slice wholly within a storey has its outline.
void expectStoreys(const std::vector<FloorplanLayer>& layers, double yaw = 0.0) {
  int found = 0;
  int whole = 0;
  for (const FloorplanLayer& layer : layers) {
    // Points of the other storey lie within 4 noise deviations of the step.
    const bool below = layer.z_max < 4.0 - 4.0 * kNoise && layer.z_min > 0.0;
    const bool above = layer.z_min > 4.0 + 4.0 * kNoise && layer.z_max < 8.0;
    if (!below && !above) continue;
    ++whole;
    const Corners truth = moved(below ? kL : kTower, yaw, {3, 5});
    if (layer.plan.components.size() == 1 &&
        sameCorners(layer.plan.components[0].outer, truth, kCornerTolerance)) {
      ++found;
    }
  }
  EXPECT_GE(whole, 3);
  EXPECT_EQ(found, whole);
}

bool sameLayers(const std::vector<FloorplanLayer>& a, const std::vector<FloorplanLayer>& b) {
  const auto sameRing = [](const FloorplanRing& x, const FloorplanRing& y) {
    return x.vertices == y.vertices &&
           std::equal(x.edges.begin(), x.edges.end(), y.edges.begin(), y.edges.end(),
                      [](const FloorplanEdge& e, const FloorplanEdge& f) {
                        return e.wall == f.wall && e.hypothetical == f.hypothetical;
                      });
  };
  const auto sameComponent = [&](const FloorplanComponent& x, const FloorplanComponent& y) {
    return sameRing(x.outer, y.outer) &&
           std::equal(x.holes.begin(), x.holes.end(), y.holes.begin(), y.holes.end(), sameRing);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const FloorplanLayer& x, const FloorplanLayer& y) {
                      return x.z_min == y.z_min && x.z_max == y.z_max &&
                             std::equal(x.plan.components.begin(), x.plan.components.end(),
                                        y.plan.components.begin(), y.plan.components.end(),
                                        sameComponent);
                    });
}

template <typename PointT>
class LayerwiseFloorplans : public ::testing::Test {};
TYPED_TEST_SUITE(LayerwiseFloorplans, OrientedPointTypes);

TYPED_TEST(LayerwiseFloorplans, TwoStoreysTurnedAndNot) {
  for (const double yaw : {0.0, 0.5}) {
    LayerwiseFloorplanExtraction<TypeParam> extraction;
    extraction.setInputCloud(building<TypeParam>(yaw));
    extraction.setSliceThickness(1.0);
    std::vector<FloorplanLayer> layers;
    ASSERT_TRUE(extraction.extract(layers));
    expectGoodLayers(layers);
    EXPECT_EQ(extraction.getDirections().size(), 4U);
    EXPECT_EQ(extraction.getSliceThickness(), 1.0);
    ASSERT_EQ(extraction.getStages().size(), layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
      EXPECT_EQ(extraction.getStages()[i].failure.empty(), !layers[i].plan.empty());
    }
  }
}

TYPED_TEST(LayerwiseFloorplans, SlicesHaveTheOutlineOfTheirStorey) {
  for (const double yaw : {0.0, 0.5}) {
    LayerwiseFloorplanExtraction<TypeParam> extraction;
    extraction.setInputCloud(building<TypeParam>(yaw));
    extraction.setSliceThickness(1.0);
    std::vector<FloorplanLayer> layers;
    ASSERT_TRUE(extraction.extract(layers));
    expectStoreys(layers, yaw);
  }
}

TYPED_TEST(LayerwiseFloorplans, OneThreadAndFourGiveTheSameBytes) {
  const auto cloud = building<TypeParam>();
  std::vector<std::vector<FloorplanLayer>> results;
  for (const unsigned threads : {1U, 4U, 4U}) {
    LayerwiseFloorplanExtraction<TypeParam> extraction;
    extraction.setInputCloud(cloud);
    extraction.setNumberOfThreads(threads);
    results.emplace_back();
    ASSERT_TRUE(extraction.extract(results.back()));
  }
  EXPECT_FALSE(results[0].empty());
  EXPECT_TRUE(sameLayers(results[0], results[1]));
  EXPECT_TRUE(sameLayers(results[1], results[2]));
}

TYPED_TEST(LayerwiseFloorplans, ASecondCloudGetsDirectionsOfItsOwn) {
  LayerwiseFloorplanExtraction<TypeParam> extraction;
  extraction.setSliceThickness(1.0);
  std::vector<FloorplanLayer> layers;
  extraction.setInputCloud(building<TypeParam>(0.0));
  ASSERT_TRUE(extraction.extract(layers));
  extraction.setInputCloud(building<TypeParam>(0.5, 2));
  ASSERT_TRUE(extraction.extract(layers));
  expectGoodLayers(layers);
  LayerwiseFloorplanExtraction<TypeParam> fresh;
  fresh.setSliceThickness(1.0);
  fresh.setInputCloud(building<TypeParam>(0.5, 2));
  std::vector<FloorplanLayer> expected;
  ASSERT_TRUE(fresh.extract(expected));
  EXPECT_TRUE(sameLayers(layers, expected));
}

TYPED_TEST(LayerwiseFloorplans, OnlyIndexedPointsCount) {
  auto cloud = building<TypeParam>();
  const auto alone = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  WallCloudOptions other;
  other.z_max = 8.0;
  addWalls(box(40, 0, 60, 20), other, *cloud);
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < alone->size(); ++i) {
    indices->push_back(static_cast<pcl::index_t>(i));
  }
  std::vector<FloorplanLayer> part;
  std::vector<FloorplanLayer> whole;
  LayerwiseFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(indices);
  ASSERT_TRUE(extraction.extract(part));
  LayerwiseFloorplanExtraction<TypeParam> fresh;
  fresh.setInputCloud(alone);
  ASSERT_TRUE(fresh.extract(whole));
  EXPECT_TRUE(sameLayers(part, whole));
}

TYPED_TEST(LayerwiseFloorplans, PointsThatAreNoneAreIgnoredAndTheInputStays) {
  auto cloud = building<TypeParam>();
  addUnusable(*cloud);
  const pcl::PointCloud<TypeParam> copy = *cloud;
  LayerwiseFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSliceThickness(1.0);
  std::vector<FloorplanLayer> layers;
  ASSERT_TRUE(extraction.extract(layers));
  expectGoodLayers(layers);
  EXPECT_TRUE(sameBytes(*cloud, copy));
}

TYPED_TEST(LayerwiseFloorplans, StagesAreParallelToTheirPoints) {
  LayerwiseFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(building<TypeParam>());
  extraction.setKeepStages(true);
  std::vector<FloorplanLayer> layers;
  ASSERT_TRUE(extraction.extract(layers));
  for (const SliceStages<TypeParam>& stages : extraction.getStages()) {
    const std::size_t size = stages.indices.size();
    EXPECT_EQ(stages.projected.size(), size);
    EXPECT_EQ(stages.smoothed.size(), size);
    EXPECT_EQ(stages.labels.size(), size);
    EXPECT_EQ(stages.refined.size(), size);
    EXPECT_EQ(stages.regions.size(), stages.region_labels.size());
    for (std::size_t r = 0; r < stages.regions.size(); ++r) {
      for (const pcl::index_t i : stages.regions[r].indices) {
        ASSERT_LT(static_cast<std::size_t>(i), size);
        EXPECT_EQ(stages.labels[static_cast<std::size_t>(i)], stages.region_labels[r]);
      }
    }
  }
}

TYPED_TEST(LayerwiseFloorplans, NoInputAndBadParametersGiveNothing) {
  using Tested = LayerwiseFloorplanExtraction<TypeParam>;
  const auto cloud = building<TypeParam>();
  const auto expectRefused = [&](const auto& spoil) {
    Tested extraction;
    extraction.setInputCloud(cloud);
    spoil(extraction);
    std::vector<FloorplanLayer> layers(1);
    EXPECT_FALSE(extraction.extract(layers));
    EXPECT_TRUE(layers.empty());
    EXPECT_TRUE(extraction.getStages().empty());
  };
  expectRefused([](Tested& e) { e.setInputCloud(nullptr); });
  expectRefused([](Tested& e) { e.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>()); });
  expectRefused([](Tested& e) { e.setKSearch(2); });
  expectRefused([&](Tested& e) {
    e.setIndices(
        pcl::make_shared<pcl::Indices>(pcl::Indices{0, static_cast<pcl::index_t>(cloud->size())}));
  });
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expectRefused([&](Tested& e) { e.setNoise(bad); });
    expectRefused([&](Tested& e) { e.setSliceThickness(bad); });
  }
}

TYPED_TEST(LayerwiseFloorplans, GettersReturnWhatWasSet) {
  struct Named : LayerwiseFloorplanExtraction<TypeParam> {
    std::string name() const { return this->getClassName(); }
  };
  Named extraction;
  EXPECT_EQ(extraction.name(), "LayerwiseFloorplanExtraction");
  extraction.setNoise(0.1);
  extraction.setSliceThickness(0.5);
  extraction.setKSearch(12);
  extraction.setNumberOfThreads(3);
  extraction.setKeepStages(true);
  extraction.setLinkingMethod(detail::LinkingMethod::Greedy);
  extraction.setDirections({{1, 0, 0}});
  EXPECT_EQ(extraction.getNoise(), 0.1);
  EXPECT_EQ(extraction.getSliceThickness(), 0.5);
  EXPECT_EQ(extraction.getKSearch(), 12);
  EXPECT_EQ(extraction.getNumberOfThreads(), 3U);
  EXPECT_TRUE(extraction.getKeepStages());
  EXPECT_EQ(extraction.getLinkingMethod(), detail::LinkingMethod::Greedy);
  EXPECT_EQ(extraction.getDirections().size(), 1U);
}

}  // namespace
