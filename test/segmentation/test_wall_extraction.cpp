// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/wall_extraction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "../point_types.h"
#include "noisy_tower.h"

namespace storey {
namespace {

constexpr std::size_t kPoints = 40000;

Tower hexagon() {
  Tower tower;
  tower.angles = regularAngles(6, 11.0);
  return tower;
}

template <typename PointT>
class WallExtractionOf : public ::testing::Test {};
TYPED_TEST_SUITE(WallExtractionOf, OrientedPointTypes);

// A wall of n points is known to sigma / sqrt(n) at its middle and, over its length L, to
// sigma sqrt(12 / n) / L in direction; four deviations.
TYPED_TEST(WallExtractionOf, FindsTheWallsOfAHexagonAndTheirPoints) {
  const auto cloud = hexagon().sample<TypeParam>(kPoints, 3);
  cloud->header.frame_id = "site";
  WallExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> walls;
  extraction.extract(walls);
  ASSERT_EQ(walls.size(), 6u);
  ASSERT_EQ(extraction.getLines().size(), 6u);
  const double n = kPoints / 6.0;
  const double length = 2.0 * 10.0 * std::tan(M_PI / 6.0);
  std::vector<Eigen::Vector3d> normals;
  std::vector<char> taken(cloud->size(), 0);
  std::size_t assigned = 0;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const detail::WallLine& line = extraction.getLines()[w];
    normals.emplace_back(line.normal.x(), line.normal.y(), 0.0);
    EXPECT_NEAR(line.offset, 10.0, 4.0 * 0.1 / std::sqrt(n));
    EXPECT_EQ(walls[w].header.frame_id, "site");
    EXPECT_TRUE(std::is_sorted(walls[w].indices.begin(), walls[w].indices.end()));
    if (w > 0) {
      EXPECT_LE(walls[w].indices.size(), walls[w - 1].indices.size());
    }
    for (const pcl::index_t i : walls[w].indices) {
      EXPECT_EQ(taken[static_cast<std::size_t>(i)]++, 0);
    }
    assigned += walls[w].indices.size();
  }
  expectDirections(normals, hexagon().angles, 4.0 * 0.1 * std::sqrt(12.0 / n) / length / kDegree);
  // 0.27 % lie beyond three deviations; normals of 15 degrees hardly ever turn by 60.
  EXPECT_GT(static_cast<double>(assigned), 0.99 * static_cast<double>(cloud->size()));
}

TYPED_TEST(WallExtractionOf, OnlyIndexedFinitePointsCount) {
  const auto cloud = hexagon().sample<TypeParam>(kPoints, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[0].x = nan;
  (*cloud)[2].normal_y = nan;
  (*cloud)[4].normal_x = (*cloud)[4].normal_y = (*cloud)[4].normal_z = 0.0f;
  cloud->is_dense = false;
  auto even = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); i += 2) even->push_back(static_cast<int>(i));
  WallExtraction<TypeParam> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(even);
  extraction.setNoise(0.1);
  extraction.setDensity(0.5 * kPoints / (6.0 * 2.0 * 10.0 * std::tan(M_PI / 6.0) * 10.0));
  std::vector<pcl::PointIndices> walls;
  extraction.extract(walls);
  ASSERT_EQ(walls.size(), 6u);
  for (const pcl::PointIndices& wall : walls) {
    for (const pcl::index_t i : wall.indices) {
      EXPECT_EQ(i % 2, 0);
      EXPECT_TRUE(i > 4) << "point " << i << " has no position or no normal";
    }
  }
}

TYPED_TEST(WallExtractionOf, MisuseAndEmptyCloudsGiveNoWalls) {
  WallExtraction<TypeParam> extraction;
  std::vector<pcl::PointIndices> walls(3);
  extraction.extract(walls);
  EXPECT_TRUE(walls.empty());
  extraction.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  extraction.extract(walls);
  EXPECT_TRUE(walls.empty());
  const auto cloud = hexagon().sample<TypeParam>(2000, 5);
  extraction.setInputCloud(cloud);
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    extraction.setNoise(bad);
    EXPECT_EQ(std::isnan(bad), std::isnan(extraction.getNoise()));
    extraction.extract(walls);
    EXPECT_TRUE(walls.empty());
  }
  extraction.setNoise(0.0);
  extraction.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 5000}));
  extraction.extract(walls);
  EXPECT_TRUE(walls.empty());
  auto same = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  same->resize(20000, (*cloud)[0]);
  WallExtraction<TypeParam> of_one_place;
  of_one_place.setInputCloud(same);
  of_one_place.extract(walls);
  EXPECT_TRUE(walls.empty());
}

// 50 are fewer than the hundredth of 40,000 that a few are.
TYPED_TEST(WallExtractionOf, AFewPointsFarAwayChangeNothing) {
  const auto cloud = hexagon().sample<TypeParam>(kPoints, 7);
  auto with_outliers = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  TypeParam outlier = (*cloud)[0];
  for (int i = 0; i < 50; ++i) {
    outlier.x = 1e7f * static_cast<float>(i - 25);
    outlier.y = 1e8f;
    outlier.z = -1e7f * static_cast<float>(i);
    with_outliers->push_back(outlier);
  }
  pcl::Indices found[2];
  for (int k = 0; k < 2; ++k) {
    WallExtraction<TypeParam> extraction;
    extraction.setInputCloud(k == 0 ? cloud : with_outliers);
    extraction.setNoise(0.1);
    extraction.setDensity(kPoints / (6.0 * 2.0 * 10.0 * std::tan(M_PI / 6.0) * 10.0));
    std::vector<pcl::PointIndices> walls;
    extraction.extract(walls);
    ASSERT_EQ(walls.size(), 6u);
    for (const pcl::PointIndices& wall : walls) {
      found[k].insert(found[k].end(), wall.indices.begin(), wall.indices.end());
    }
  }
  EXPECT_EQ(found[0], found[1]);
}

TYPED_TEST(WallExtractionOf, AMovedCloudHasTheSameWalls) {
  const auto cloud = hexagon().sample<TypeParam>(kPoints, 6);
  auto moved = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  for (TypeParam& p : *moved) {
    p.x += 500.0f;
    p.y -= 300.0f;
    p.z += 40.0f;
  }
  std::vector<std::size_t> sizes[2];
  for (int k = 0; k < 2; ++k) {
    WallExtraction<TypeParam> extraction;
    extraction.setInputCloud(k == 0 ? cloud : moved);
    std::vector<pcl::PointIndices> walls;
    extraction.extract(walls);
    for (const pcl::PointIndices& wall : walls) sizes[k].push_back(wall.indices.size());
  }
  ASSERT_EQ(sizes[0].size(), sizes[1].size());
  for (std::size_t w = 0; w < sizes[0].size(); ++w) {
    EXPECT_NEAR(static_cast<double>(sizes[0][w]), static_cast<double>(sizes[1][w]),
                0.005 * kPoints / 6.0);
  }
}

}  // namespace
}  // namespace storey
