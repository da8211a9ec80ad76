// SPDX-License-Identifier: BSD-3-Clause
// Directions against the truth of towers whose walls are known.
#include <gtest/gtest.h>
#include <storey/segmentation/dominant_direction_clustering.h>

#include <cmath>
#include <random>
#include <vector>

#include "../point_types.h"
#include "noisy_tower.h"

namespace {

using Clusters = std::vector<pcl::PointIndices>;
using Clustering = storey::DominantDirectionClustering<pcl::PointNormal>;

TEST(DominantDirectionClustering, SeparateCloudOfNormals) {
  auto positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto box = Tower{regularAngles(4, 5.0), 10.0, 0.0, 0.0}.sample<pcl::PointNormal>(400, 1);
  for (const pcl::PointNormal& p : *box) {
    positions->push_back(pcl::PointXYZ(p.x, p.y, p.z));
    normals->push_back(pcl::Normal(p.normal_x, p.normal_y, p.normal_z));
  }
  storey::DominantDirectionClustering<pcl::PointXYZ, pcl::Normal> clustering;
  clustering.setInputCloud(positions);
  Clusters clusters;
  clustering.extract(clusters);
  EXPECT_TRUE(clusters.empty());  // no normals
  clustering.setInputNormals(normals);
  clustering.setSmoothingNeighbors(1);
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), regularAngles(4, 5.0), 1e-4);
}

TEST(DominantDirectionClustering, NoisyDecagonToHalfADegree) {
  // 15 degrees of noise, averaged over 30: 2 degrees; over 10,000 points a wall 0.02
  const std::vector<double> truth = regularAngles(10, 7.0);
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(200000, 2);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, WallsOfUnequalLength) {
  // turns of 36 +- 10 degrees: the lengths differ by a factor of 2
  const std::vector<double> turns = {26, 46, 30, 42, 36, 26, 46, 36, 30, 42};
  std::vector<double> truth = {0.2};
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    truth.push_back(truth.back() + turns[i] * kDegree);
  }
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(200000, 3);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, MoreNeighborsSeparateTwelveDegrees) {
  std::vector<double> truth = regularAngles(4, 0.0);
  truth.insert(truth.begin() + 1, 12.0 * kDegree);
  const auto cloud = Tower{truth, 40.0}.sample<pcl::PointNormal>(150000, 4);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setSmoothingNeighbors(100);  // 1.1 degrees of noise
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.5);
}

TEST(DominantDirectionClustering, RawNormalsOfABoxNeedNoNeighbors) {
  const std::vector<double> truth = regularAngles(4, 40.0);
  const auto cloud = Tower{truth}.sample<pcl::PointNormal>(20000, 5);
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setSmoothingNeighbors(1);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), truth, 0.6);  // 3 x 10.6 degrees / sqrt(4000)
}

TEST(DominantDirectionClustering, FacesOfAThinWallDoNotCancel) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-5.0, 5.0);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (int i = 0; i < 2000; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Eigen::Vector3d normal = disturb({side, 0.0, 0.0}, 10.0, random);
    cloud->push_back(
        makePoint<pcl::PointNormal>({0.01 * side, unit(random), unit(random)}, normal));
  }
  Clustering clustering;
  clustering.setInputCloud(cloud);
  Clusters clusters;
  clustering.extract(clusters);
  expectDirections(clustering.getDirections(), {0.0, M_PI}, 0.7);  // 3 x 7 degrees / sqrt(1000)
  for (const pcl::PointIndices& cluster : clusters) {
    EXPECT_EQ(cluster.indices.size(), 1000U);
  }
}

TEST(DominantDirectionClustering, AMillionCopiesAndAFarawayPoint) {
  auto cloud = Tower{regularAngles(4, 0.0), 10.0, 0.0, 0.0}.sample<pcl::PointNormal>(1000, 7);
  cloud->resize(1001000, (*cloud)[0]);
  cloud->push_back(makePoint<pcl::PointNormal>({3e38, 0.0, 0.0}, Eigen::Vector3d::UnitX()));
  cloud->push_back(makePoint<pcl::PointNormal>({1e7, 1e7, 0.0}, Eigen::Vector3d::UnitY()));
  Clustering clustering;
  clustering.setInputCloud(cloud);
  clustering.setMinClusterShare(0.0);
  clustering.setMaxSamples(0);
  Clusters clusters;
  clustering.extract(clusters);
  ASSERT_GE(clusters.size(), 4U);
  EXPECT_GE(clusters[0].indices.size(), 1000000U);
}

}  // namespace
