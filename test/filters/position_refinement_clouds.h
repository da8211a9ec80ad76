// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <storey/filters/anisotropic_position_refinement.h>

#include <limits>
#include <random>
#include <vector>

#include "../point_types.h"

// Clouds and fixture of the tests of AnisotropicPositionRefinement.

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
PointT makePoint(double x, double y, double nx, double ny) {
  PointT p;
  p.getVector3fMap() = Eigen::Vector3d(x, y, 0).cast<float>();
  p.getNormalVector3fMap() = Eigen::Vector3d(nx, ny, 0).cast<float>();
  p.curvature = 0.25f;
  return p;
}

// n points at steps of 0.05 along x, noise 0.01 in y: a flattened wall.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeLine(int n, double noise = 0.01) {
  std::mt19937 random(3);
  std::normal_distribution<double> e(0.0, noise);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < n; ++i) {
    cloud->push_back(makePoint<PointT>(0.05 * i, e(random), 0, 1));
  }
  cloud->header.frame_id = "site";
  return cloud;
}

// Two walls of 500 points that meet in (0, 0): along x (first) and along y.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeCorner() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.0, 5.0);
  std::normal_distribution<double> e(0.0, 0.02);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (int i = 0; i < 500; ++i) {
    cloud->push_back(makePoint<PointT>(u(random), e(random), 0, -1));
  }
  for (int i = 0; i < 500; ++i) {
    cloud->push_back(makePoint<PointT>(e(random), u(random), -1, 0));
  }
  return cloud;
}

inline std::vector<pcl::PointIndices> cornerRegions() {
  std::vector<pcl::PointIndices> regions(2);
  for (int i = 0; i < 1000; ++i) {
    regions[i < 500 ? 0 : 1].indices.push_back(i);
  }
  return regions;
}

template <typename PointT>
class PositionRefinementOf : public testing::Test {
 protected:
  using Cloud = pcl::PointCloud<PointT>;
  using Refinement = storey::AnisotropicPositionRefinement<PointT>;

  static Cloud refine(const typename Cloud::ConstPtr& cloud, Refinement& refinement) {
    Cloud output;
    output.push_back(PointT());  // must not survive
    refinement.setInputCloud(cloud);
    refinement.filter(output);
    return output;
  }

  static void expectSame(const Cloud& a, const Cloud& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].getVector3fMap(), b[i].getVector3fMap()) << i;
    }
  }
};
