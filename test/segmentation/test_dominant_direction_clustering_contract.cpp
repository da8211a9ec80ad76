// SPDX-License-Identifier: BSD-3-Clause
// What every class promises, for all types of points: indices, order, threads, bad input, getters.
#include <gtest/gtest.h>
#include <pcl/search/brute_force.h>
#include <storey/segmentation/dominant_direction_clustering.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <pcl/search/impl/brute_force.hpp>
#include <pcl/search/impl/search.hpp>
#include <random>
#include <vector>

#include "../point_types.h"
#include "noisy_tower.h"

namespace {

using Clusters = std::vector<pcl::PointIndices>;

template <typename PointT>
struct Exposed : storey::DominantDirectionClustering<PointT> {
  using storey::DominantDirectionClustering<PointT>::getClassName;
};

template <typename PointT>
class DominantDirectionClusteringTest : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Clustering = storey::DominantDirectionClustering<PointT>;

  // A box of 40 points a wall without noise; the walls' points in turn.
  static typename Cloud::Ptr makeBox() {
    auto cloud = pcl::make_shared<Cloud>();
    for (int i = 0; i < 160; ++i) {
      const double angle = 0.3 + M_PI_2 * (i % 4);
      const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3d along(-normal.y(), normal.x(), 0.0);
      const Eigen::Vector3d position =
          5.0 * normal + (0.2 * (i / 4) - 4.0) * along + 0.01 * i * Eigen::Vector3d::UnitZ();
      cloud->push_back(makePoint<PointT>(position, normal));
    }
    cloud->header.frame_id = "house";
    cloud->header.stamp = 42;
    return cloud;
  }

  static Clusters run(Clustering& clustering, const typename Cloud::ConstPtr& cloud) {
    Clusters clusters(3);  // what was there before must go
    clustering.setInputCloud(cloud);
    clustering.extract(clusters);
    return clusters;
  }
};
TYPED_TEST_SUITE(DominantDirectionClusteringTest, OrientedPointTypes);

TYPED_TEST(DominantDirectionClusteringTest, BoxHasFourOrientedDirections) {
  const auto cloud = TestFixture::makeBox();
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(5);
  const Clusters clusters = TestFixture::run(clustering, cloud);
  expectDirections(clustering.getDirections(), {0.3, 0.3 + M_PI_2, 0.3 - M_PI_2, 0.3 - M_PI}, 1e-4);
  ASSERT_EQ(clusters.size(), 4U);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(clusters[c].header.frame_id, "house");
    EXPECT_EQ(clusters[c].header.stamp, 42U);
    pcl::Indices expected(40);  // equal sizes: in the order of the first index
    for (std::size_t i = 0; i < 40; ++i) {
      expected[i] = static_cast<pcl::index_t>(4 * i + c);
    }
    EXPECT_EQ(clusters[c].indices, expected);
    const Eigen::Vector3d& direction = clustering.getDirections()[c];
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    EXPECT_EQ(direction.z(), 0.0);
    EXPECT_NEAR(angleBetween(angleOf(direction), 0.3 + M_PI_2 * static_cast<double>(c)), 0.0, 1e-6);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, InvalidAndHorizontalPointsAreInNoCluster) {
  auto cloud = TestFixture::makeBox();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[0].x = nan;
  (*cloud)[1].normal_x = nan;
  (*cloud)[2].getNormalVector3fMap().setZero();
  (*cloud)[3].getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
  (*cloud)[4].z = std::numeric_limits<float>::infinity();
  cloud->is_dense = true;  // a lie that files tell
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(2);
  const Clusters clusters = TestFixture::run(clustering, cloud);
  ASSERT_EQ(clusters.size(), 4U);
  std::vector<pcl::index_t> seen;
  for (const pcl::PointIndices& cluster : clusters) {
    EXPECT_TRUE(std::is_sorted(cluster.indices.begin(), cluster.indices.end()));
    seen.insert(seen.end(), cluster.indices.begin(), cluster.indices.end());
  }
  std::sort(seen.begin(), seen.end());
  pcl::Indices expected(155);
  std::iota(expected.begin(), expected.end(), 5);
  EXPECT_EQ(seen, expected);
}

TYPED_TEST(DominantDirectionClusteringTest, SubsetInAnyOrderIsTheSubCloud) {
  const Tower tower{regularAngles(6, 10.0)};
  const auto cloud = tower.sample<TypeParam>(3000, 4);
  std::mt19937 random(5);
  pcl::Indices subset(3000);
  std::iota(subset.begin(), subset.end(), 0);
  std::shuffle(subset.begin(), subset.end(), random);
  subset.resize(2000);
  typename TestFixture::Clustering clustering;
  clustering.setIndices(pcl::make_shared<pcl::Indices>(subset));
  const Clusters of_subset = TestFixture::run(clustering, cloud);

  std::sort(subset.begin(), subset.end());
  const auto sub_cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud, subset);
  typename TestFixture::Clustering other;
  Clusters of_cloud = TestFixture::run(other, sub_cloud);
  ASSERT_EQ(of_subset.size(), 6U);
  ASSERT_EQ(of_subset.size(), of_cloud.size());
  for (std::size_t c = 0; c < of_cloud.size(); ++c) {
    for (pcl::index_t& i : of_cloud[c].indices) {
      i = subset[static_cast<std::size_t>(i)];
    }
    EXPECT_EQ(of_subset[c].indices, of_cloud[c].indices);
    EXPECT_EQ(clustering.getDirections()[c], other.getDirections()[c]);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, OrderOfPointsDoesNotMatter) {
  const Tower tower{regularAngles(5, 20.0)};
  const auto cloud = tower.sample<TypeParam>(4000, 6);
  std::vector<std::size_t> place(cloud->size());
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::mt19937 random(7);
  std::shuffle(place.begin(), place.end(), random);
  auto permuted = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  for (std::size_t i = 0; i < place.size(); ++i) {
    (*permuted)[place[i]] = (*cloud)[i];
  }
  typename TestFixture::Clustering clustering;
  clustering.setMaxSamples(1500);  // the sample must be the same points too
  Clusters clusters = TestFixture::run(clustering, cloud);
  const Clusters of_permuted = TestFixture::run(clustering, permuted);
  ASSERT_EQ(clusters.size(), 5U);
  ASSERT_EQ(of_permuted.size(), 5U);
  for (std::size_t c = 0; c < 5; ++c) {
    for (pcl::index_t& i : clusters[c].indices) {
      i = static_cast<pcl::index_t>(place[static_cast<std::size_t>(i)]);
    }
    std::sort(clusters[c].indices.begin(), clusters[c].indices.end());
    EXPECT_EQ(clusters[c].indices, of_permuted[c].indices);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, ThreadsGiveTheSameBytes) {
  const auto cloud = Tower{regularAngles(5, 33.0)}.sample<TypeParam>(3000, 8);
  typename TestFixture::Clustering clustering;
  clustering.setNumberOfThreads(1);
  const Clusters one = TestFixture::run(clustering, cloud);
  const std::vector<Eigen::Vector3d> directions = clustering.getDirections();
  clustering.setNumberOfThreads(4);
  const Clusters four = TestFixture::run(clustering, cloud);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    EXPECT_EQ(one[c].indices, four[c].indices);
    EXPECT_EQ(directions[c], clustering.getDirections()[c]);
  }
}

TYPED_TEST(DominantDirectionClusteringTest, EquivariantUnderTurnAndShiftAndInputUnchanged) {
  const Tower tower{regularAngles(5, 0.0)};
  const auto cloud = tower.sample<TypeParam>(5000, 9);
  auto moved = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  const Eigen::AngleAxisf turn(0.7F, Eigen::Vector3f::UnitZ());
  for (TypeParam& p : *moved) {
    p.getVector3fMap() = turn * p.getVector3fMap() + Eigen::Vector3f(1000.0F, -1000.0F, 500.0F);
    p.getNormalVector3fMap() = turn * p.getNormalVector3fMap();
  }
  const pcl::PointCloud<TypeParam> before = *cloud;
  typename TestFixture::Clustering clustering;
  TestFixture::run(clustering, cloud);
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ((*cloud)[i].getVector3fMap(), before[i].getVector3fMap());
    ASSERT_EQ((*cloud)[i].getNormalVector3fMap(), before[i].getNormalVector3fMap());
  }
  std::vector<double> expected;
  for (const Eigen::Vector3d& direction : clustering.getDirections()) {
    expected.push_back(angleOf(direction) + 0.7);
  }
  ASSERT_EQ(expected.size(), 5U);
  TestFixture::run(clustering, moved);
  expectDirections(clustering.getDirections(), expected, 0.1);  // a bin
}

TYPED_TEST(DominantDirectionClusteringTest, NothingInNothingOut) {
  typename TestFixture::Clustering clustering;
  Clusters clusters(2);
  clustering.extract(clusters);  // no input
  EXPECT_TRUE(clusters.empty());
  EXPECT_TRUE(clustering.getDirections().empty());
  EXPECT_TRUE(TestFixture::run(clustering, pcl::make_shared<pcl::PointCloud<TypeParam>>()).empty());
  EXPECT_EQ(TestFixture::run(clustering, TestFixture::makeBox()).size(), 4U);  // another size
  clustering.setInputCloud(pcl::make_shared<pcl::PointCloud<TypeParam>>());
  clustering.extract(clusters);
  EXPECT_TRUE(clusters.empty());
  EXPECT_TRUE(clustering.getDirections().empty());
}

TYPED_TEST(DominantDirectionClusteringTest, BadParametersGiveNothing) {
  using Subject = typename TestFixture::Clustering;
  const auto cloud = TestFixture::makeBox();
  const auto expect_nothing = [&](auto change) {
    Subject clustering;
    EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 4U);
    change(clustering);
    EXPECT_TRUE(TestFixture::run(clustering, cloud).empty());
    EXPECT_TRUE(clustering.getDirections().empty());
  };
  expect_nothing([](Subject& c) { c.setSmoothingNeighbors(0); });
  expect_nothing([](Subject& c) { c.setMergeAngle(-0.1); });
  expect_nothing([](Subject& c) { c.setMergeAngle(4.0); });
  expect_nothing([](Subject& c) { c.setMergeAngle(std::nan("")); });
  expect_nothing([](Subject& c) { c.setMaxTilt(0.0); });
  expect_nothing([](Subject& c) { c.setMaxTilt(2.0); });
  expect_nothing([](Subject& c) { c.setMinClusterShare(1.5); });
  expect_nothing([](Subject& c) {
    c.setMinClusterSize(5);
    c.setMaxClusterSize(4);
  });
  expect_nothing(
      [](Subject& c) { c.setInputNormals(pcl::make_shared<pcl::PointCloud<TypeParam>>(3, 1)); });
  for (const pcl::index_t bad : {-1, 160}) {
    Subject clustering;
    clustering.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, bad}));
    EXPECT_TRUE(TestFixture::run(clustering, cloud).empty());
  }
}

TYPED_TEST(DominantDirectionClusteringTest, GettersAndTypes) {
  using Subject = typename TestFixture::Clustering;
  typename Subject::Ptr clustering(new Subject);
  typename Subject::ConstPtr constant = clustering;
  pcl::PCLBase<TypeParam>& base = *clustering;
  const auto cloud = TestFixture::makeBox();
  base.setInputCloud(cloud);
  EXPECT_EQ(constant->getDirections().size(), 0U);
  EXPECT_EQ(clustering->getInputCloud(), cloud);
  clustering->setInputNormals(cloud);
  EXPECT_EQ(clustering->getInputNormals(), cloud);
  const typename pcl::search::Search<TypeParam>::Ptr tree(new pcl::search::BruteForce<TypeParam>);
  clustering->setSearchMethod(tree);
  EXPECT_EQ(clustering->getSearchMethod(), tree);
  clustering->setNumberOfThreads(3);
  EXPECT_EQ(clustering->getNumberOfThreads(), 3U);
  clustering->setSmoothingNeighbors(7);
  EXPECT_EQ(clustering->getSmoothingNeighbors(), 7);
  clustering->setMaxSamples(70);
  EXPECT_EQ(clustering->getMaxSamples(), 70U);
  clustering->setMergeAngle(0.2);
  EXPECT_EQ(clustering->getMergeAngle(), 0.2);
  clustering->setMaxTilt(0.3);
  EXPECT_EQ(clustering->getMaxTilt(), 0.3);
  clustering->setMinClusterShare(0.1);
  EXPECT_EQ(clustering->getMinClusterShare(), 0.1);
  clustering->setMinClusterSize(3);
  EXPECT_EQ(clustering->getMinClusterSize(), 3U);
  clustering->setMaxClusterSize(333);
  EXPECT_EQ(clustering->getMaxClusterSize(), 333U);
  Clusters clusters;
  clustering->extract(clusters);
  EXPECT_EQ(clusters.size(), 4U);
  EXPECT_EQ(clustering->getUsedMergeAngle(), 0.2);
  EXPECT_EQ(tree->getInputCloud()->size(), 160U);  // the given tree was used
  EXPECT_STREQ(Exposed<TypeParam>().getClassName(), "DominantDirectionClustering");
}

TYPED_TEST(DominantDirectionClusteringTest, SizesAreHonoured) {
  auto cloud = TestFixture::makeBox();
  cloud->resize(142);  // 36, 36, 35, 35
  typename TestFixture::Clustering clustering;
  clustering.setSmoothingNeighbors(1);
  const Clusters all = TestFixture::run(clustering, cloud);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].indices.size(), 36U);
  EXPECT_EQ(all[3].indices.size(), 35U);
  clustering.setMinClusterSize(36);
  EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 2U);
  EXPECT_EQ(clustering.getDirections().size(), 2U);
  clustering.setMinClusterSize(1);
  clustering.setMaxClusterSize(35);
  const Clusters small = TestFixture::run(clustering, cloud);
  ASSERT_EQ(small.size(), 2U);
  EXPECT_EQ(small[0].indices, all[2].indices);
  clustering.setMaxClusterSize(1000);
  clustering.setMinClusterShare(0.25);  // of 142: 35.5
  EXPECT_EQ(TestFixture::run(clustering, cloud).size(), 2U);
}

}  // namespace
