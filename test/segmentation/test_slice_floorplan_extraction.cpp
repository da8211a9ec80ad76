// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/slice_floorplan_extraction.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>

#include "../point_types.h"
#include "wall_clouds.h"

namespace {

using namespace storey;
using namespace storey::test;

const Corners kL = {{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 15}, {0, 15}};
// Exact points in floats below 100 are good to 4e-6, lines through them to less.
constexpr double kExact = 1e-4;

template <typename PointT>
class SliceFloorplan : public ::testing::Test {
 protected:
  static Floorplan planOf(const typename pcl::PointCloud<PointT>::ConstPtr& cloud) {
    SliceFloorplanExtraction<PointT> extraction;
    extraction.setInputCloud(cloud);
    Floorplan plan;
    EXPECT_TRUE(extraction.extract(plan)) << extraction.getFailure();
    EXPECT_TRUE(extraction.getFailure().empty());
    expectValid(plan);
    return plan;
  }

  static void expectL(const Floorplan& plan, double tolerance, double yaw = 0.0,
                      const Eigen::Vector2d& shift = {0, 0}) {
    ASSERT_EQ(plan.components.size(), 1U);
    EXPECT_TRUE(plan.components[0].holes.empty());
    EXPECT_TRUE(sameCorners(plan.components[0].outer, moved(kL, yaw, shift), tolerance));
  }
};
TYPED_TEST_SUITE(SliceFloorplan, OrientedPointTypes);

TYPED_TEST(SliceFloorplan, AnLIsExact) {
  const Floorplan plan = TestFixture::planOf(wallCloud<TypeParam>({kL}));
  TestFixture::expectL(plan, kExact);
  EXPECT_NEAR(area(plan), 20.0 * 8.0 + 9.0 * 7.0, 1e-3);
  EXPECT_EQ(countHypothetical(plan.components.at(0).outer), 0U);
}

TYPED_TEST(SliceFloorplan, AnLTurnedAndShiftedIsTheSame) {
  for (const double yaw : {0.3, 1.2, -2.5}) {
    for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1000, -1000)}) {
      const Floorplan plan = TestFixture::planOf(wallCloud<TypeParam>({moved(kL, yaw, shift)}));
      // Floats at 1000 are good to 6e-5.
      TestFixture::expectL(plan, shift.norm() > 0.0 ? 5e-3 : kExact, yaw, shift);
    }
  }
}

TYPED_TEST(SliceFloorplan, ComponentsAndCourtyardsAreKeptApart) {
  const Corners outer = box(0, 0, 20, 16);
  const Corners courtyard = clockwise(box(6, 5, 14, 11));
  const Corners tower = box(26, 2, 34, 10);
  const Floorplan plan = TestFixture::planOf(wallCloud<TypeParam>({outer, courtyard, tower}));
  ASSERT_EQ(plan.components.size(), 2U);  // largest first
  EXPECT_TRUE(sameCorners(plan.components[0].outer, outer, kExact));
  ASSERT_EQ(plan.components[0].holes.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].holes[0], courtyard, kExact));
  EXPECT_TRUE(sameCorners(plan.components[1].outer, tower, kExact));
}

TYPED_TEST(SliceFloorplan, AMissingWallIsCompletedAlongADirectionAndMarked) {
  // The wall from (20, 0) to (20, 8) was not seen.
  const auto whole = wallCloud<TypeParam>({kL});
  auto cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  for (const TypeParam& p : *whole) {
    if (p.x < 19.99f) cloud->push_back(p);
  }
  const Floorplan plan = TestFixture::planOf(cloud);
  ASSERT_EQ(plan.components.size(), 1U);
  const FloorplanRing& outer = plan.components[0].outer;
  // The walls beside it end up to their point spacing, 1 / 40, and what 19.99 cut off, before it.
  EXPECT_TRUE(sameCorners(outer, kL, 0.3));
  ASSERT_EQ(outer.size(), 6U);
  EXPECT_EQ(countHypothetical(outer), 1U);
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (!outer.edges[i].hypothetical) continue;
    const Eigen::Vector2d along = outer.vertices[(i + 1) % 6] - outer.vertices[i];
    EXPECT_GT(along.y(), 7.9);
    EXPECT_NEAR(along.x(), 0.0, 0.01);  // along the dominant direction
  }
}

TYPED_TEST(SliceFloorplan, AWindowLeavesNoTrace) {
  const auto whole = wallCloud<TypeParam>({kL});
  auto cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  for (const TypeParam& p : *whole) {
    if (p.y > 0.001f || p.x < 7.0f || p.x > 11.0f) cloud->push_back(p);
  }
  const Floorplan plan = TestFixture::planOf(cloud);
  TestFixture::expectL(plan, kExact);
  EXPECT_EQ(countHypothetical(plan.components.at(0).outer), 0U);
}

TYPED_TEST(SliceFloorplan, NothingSeenIsReported) {
  SliceFloorplanExtraction<TypeParam> extraction;
  Floorplan plan;
  plan.components.push_back({ringOf(kL), {}});
  EXPECT_FALSE(extraction.extract(plan));  // no input
  EXPECT_TRUE(plan.empty());
  EXPECT_FALSE(extraction.getFailure().empty());

  extraction.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  EXPECT_FALSE(extraction.extract(plan));
  EXPECT_TRUE(plan.empty());
  EXPECT_FALSE(extraction.getFailure().empty());

  auto cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  addUnusable(*cloud);
  extraction.setInputCloud(cloud);
  EXPECT_FALSE(extraction.extract(plan));
  EXPECT_FALSE(extraction.getFailure().empty());

  auto copies = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  for (int i = 0; i < 20000; ++i) addPoint({1, 2, 3}, {1, 0, 0}, *copies);
  extraction.setInputCloud(copies);
  EXPECT_FALSE(extraction.extract(plan));
  EXPECT_TRUE(plan.empty());

  extraction.setInputCloud(wallCloud<TypeParam>({{{0, 0}, {20, 0}}}));  // a wall's two faces
  EXPECT_FALSE(extraction.extract(plan));
  EXPECT_TRUE(plan.empty());
  EXPECT_FALSE(extraction.getFailure().empty());
}

TYPED_TEST(SliceFloorplan, OnlyIndexedPointsCountInAnyOrder) {
  const auto cloud = wallCloud<TypeParam>({kL, box(30, 0, 60, 30)});
  pcl::Indices indices;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if ((*cloud)[i].x < 25.0f) indices.push_back(static_cast<pcl::index_t>(i));
  }
  std::shuffle(indices.begin(), indices.end(), std::mt19937(3));
  SliceFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(pcl::make_shared<pcl::Indices>(indices));
  Floorplan plan;
  ASSERT_TRUE(extraction.extract(plan));
  const Floorplan alone = TestFixture::planOf(
      pcl::make_shared<pcl::PointCloud<TypeParam>>(pcl::PointCloud<TypeParam>(*cloud, indices)));
  ASSERT_EQ(plan.components.size(), 1U);
  ASSERT_EQ(alone.components.size(), 1U);
  EXPECT_TRUE(sameCorners(plan.components[0].outer, alone.components[0].outer.vertices, 1e-6));
  TestFixture::expectL(plan, kExact);
}

TYPED_TEST(SliceFloorplan, PointsThatAreNoneChangeNothing) {
  const auto cloud = wallCloud<TypeParam>({kL});
  const Floorplan plan = TestFixture::planOf(cloud);
  auto spoilt = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  addUnusable(*spoilt);
  const Floorplan again = TestFixture::planOf(spoilt);
  ASSERT_EQ(again.components.size(), 1U);
  EXPECT_TRUE(sameCorners(again.components[0].outer, plan.components.at(0).outer.vertices, kExact));
}

TYPED_TEST(SliceFloorplan, ASecondCloudIsAsGoodAsTheFirst) {
  SliceFloorplanExtraction<TypeParam> extraction;
  Floorplan plan;
  extraction.setInputCloud(wallCloud<TypeParam>({box(0, 0, 30, 30), box(40, 0, 50, 9)}));
  ASSERT_TRUE(extraction.extract(plan));
  EXPECT_EQ(plan.components.size(), 2U);
  const double yaw = 0.6;  // other directions, too
  extraction.setInputCloud(wallCloud<TypeParam>({moved(kL, yaw, {0, 0})}));
  ASSERT_TRUE(extraction.extract(plan));
  TestFixture::expectL(plan, kExact, yaw);
  EXPECT_TRUE(extraction.getDirections().empty());  // none were set
}

TYPED_TEST(SliceFloorplan, TheInputStaysAsItIs) {
  const auto cloud = wallCloud<TypeParam>({kL});
  const pcl::PointCloud<TypeParam> copy = *cloud;
  TestFixture::planOf(cloud);
  EXPECT_TRUE(sameBytes(*cloud, copy));
}

TYPED_TEST(SliceFloorplan, GivenRegionsAndDirectionsAreUsed) {
  const auto cloud = wallCloud<TypeParam>({kL});
  const std::vector<Eigen::Vector3d> directions = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  const std::vector<int> label_of_edge = {0, 1, 2, 1, 2, 3};
  // One region an edge, from the truth.
  std::vector<pcl::PointIndices> regions(6);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const Eigen::Vector2d p =
        (*cloud)[i].getVector3fMap().template head<2>().template cast<double>();
    for (std::size_t e = 0; e < 6; ++e) {
      const Eigen::Vector2d along = kL[(e + 1) % 6] - kL[e];
      const double t = (p - kL[e]).dot(along) / along.squaredNorm();
      if (t >= 0 && t <= 1 && std::abs(crossOf(along.normalized(), p - kL[e])) < 1e-4) {
        regions[e].indices.push_back(static_cast<pcl::index_t>(i));
        break;
      }
    }
  }
  for (const bool labelled : {true, false}) {
    for (const bool directed : {true, false}) {
      SliceFloorplanExtraction<TypeParam> extraction;
      extraction.setInputCloud(cloud);
      extraction.setRegions(regions, labelled ? label_of_edge : std::vector<int>(6, -1));
      if (directed) extraction.setDirections(directions);
      Floorplan plan;
      ASSERT_TRUE(extraction.extract(plan));
      TestFixture::expectL(plan, kExact);
      EXPECT_EQ(extraction.getSegments().size(), 6U);
    }
  }
  SliceFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  extraction.setDirections(directions);
  Floorplan plan;
  ASSERT_TRUE(extraction.extract(plan));
  TestFixture::expectL(plan, kExact);
  EXPECT_EQ(extraction.getDirections(), directions);
}

TYPED_TEST(SliceFloorplan, BadParametersGiveNothing) {
  const auto cloud = wallCloud<TypeParam>({kL});
  using Extraction = SliceFloorplanExtraction<TypeParam>;
  const auto expectRefused = [&](const auto& spoil) {
    Extraction extraction;
    extraction.setInputCloud(cloud);
    spoil(extraction);
    Floorplan plan;
    plan.components.push_back({ringOf(kL), {}});
    EXPECT_FALSE(extraction.extract(plan));
    EXPECT_TRUE(plan.empty());
    EXPECT_FALSE(extraction.getFailure().empty());
  };
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expectRefused([&](Extraction& e) { e.setNoise(bad); });
    expectRefused([&](Extraction& e) { e.setTolerance(bad); });
    expectRefused([&](Extraction& e) { e.setMaxGap(bad); });
    expectRefused([&](Extraction& e) { e.setMinArea(bad); });
  }
  pcl::PointIndices outside;
  outside.indices = {0, static_cast<pcl::index_t>(cloud->size())};
  expectRefused([&](Extraction& e) { e.setRegions({outside}, {0}); });
  expectRefused([&](Extraction& e) { e.setRegions({outside, outside}, {0}); });
  expectRefused(
      [&](Extraction& e) { e.setIndices(pcl::make_shared<pcl::Indices>(outside.indices)); });
  expectRefused(
      [&](Extraction& e) { e.setInputNormals(pcl::make_shared<pcl::PointCloud<TypeParam>>()); });
}

TYPED_TEST(SliceFloorplan, GettersReturnWhatWasSet) {
  SliceFloorplanExtraction<TypeParam> extraction;
  extraction.setNoise(0.1);
  extraction.setTolerance(0.2);
  extraction.setMaxGap(3.0);
  extraction.setMinArea(4.0);
  extraction.setLinkingMethod(detail::LinkingMethod::Greedy);
  const auto normals = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  extraction.setInputNormals(normals);
  EXPECT_EQ(extraction.getNoise(), 0.1);
  EXPECT_EQ(extraction.getTolerance(), 0.2);
  EXPECT_EQ(extraction.getMaxGap(), 3.0);
  EXPECT_EQ(extraction.getMinArea(), 4.0);
  EXPECT_EQ(extraction.getLinkingMethod(), detail::LinkingMethod::Greedy);
  EXPECT_EQ(extraction.getInputNormals(), normals);
}

TYPED_TEST(SliceFloorplan, IsAPclClass) {
  struct Named : SliceFloorplanExtraction<TypeParam> {
    std::string name() const { return this->getClassName(); }
  };
  EXPECT_EQ(Named().name(), "SliceFloorplanExtraction");
  typename SliceFloorplanExtraction<TypeParam>::Ptr pointer(
      new SliceFloorplanExtraction<TypeParam>);
  typename SliceFloorplanExtraction<TypeParam>::ConstPtr constant = pointer;
  EXPECT_EQ(constant->getNoise(), 0.0);
  std::shared_ptr<pcl::PCLBase<TypeParam>> base = pointer;
  base->setInputCloud(wallCloud<TypeParam>({kL}));
  Floorplan plan;
  EXPECT_TRUE(pointer->extract(plan));
}

TYPED_TEST(SliceFloorplan, NormalsMayComeInACloudOfTheirOwn) {
  const auto cloud = wallCloud<TypeParam>({kL});
  auto bare = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  for (TypeParam& p : *bare) p.getNormalVector3fMap().setZero();
  SliceFloorplanExtraction<TypeParam> extraction;
  extraction.setInputCloud(bare);
  Floorplan plan;
  EXPECT_FALSE(extraction.extract(plan));
  extraction.setInputNormals(cloud);
  ASSERT_TRUE(extraction.extract(plan));
  TestFixture::expectL(plan, kExact);
}

TEST(SliceFloorplanUnderNoise, CornersAreAsGoodAsTheirLines) {
  // 0.1 on positions, 5 degrees on normals, 20 seeds. The shortest wall, 7 long, has 280 points: a
  // line is good to sigma / sqrt(280) at its middle, to twice that at its ends; two of them meet in
  // a corner; 4 deviations.
  const double tolerance = 4.0 * std::sqrt(2.0) * 2.0 * 0.1 / std::sqrt(280.0);
  int good = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    WallCloudOptions options;
    options.noise = 0.1;
    options.normal_noise = 5.0 * M_PI / 180.0;
    options.seed = seed;
    const auto cloud = wallCloud<pcl::PointNormal>({kL}, options);
    for (const float thickness : {1.0f, 0.0f}) {  // as it is, and projected onto its plane
      for (pcl::PointNormal& p : *cloud) p.z *= thickness;
      SliceFloorplanExtraction<pcl::PointNormal> extraction;
      extraction.setInputCloud(cloud);
      Floorplan plan;
      if (!extraction.extract(plan)) continue;
      expectValid(plan);
      if (plan.components.size() != 1) continue;
      if (sameCorners(plan.components[0].outer, kL, tolerance)) ++good;
    }
  }
  EXPECT_EQ(good, 40);
}

}  // namespace
