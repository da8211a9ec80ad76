// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "floorplans.h"

/// Clouds of walls over given rings, for the tests of what extracts floorplans from them.
namespace storey::test {

struct WallCloudOptions {
  double density = 40.0;  // points per unit of area
  double noise = 0.0;
  double normal_noise = 0.0;  // radians
  double z_min = 0.0;
  double z_max = 1.0;
  unsigned seed = 1;
};

template <typename PointT>
void addPoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
              pcl::PointCloud<PointT>& cloud) {
  PointT p;
  p.getVector3fMap() = position.cast<float>();
  p.getNormalVector3fMap() = normal.cast<float>();
  cloud.push_back(p);
}

/// Adds the walls of one ring, with the building on the left of its edges.
template <typename PointT>
void addWalls(const Corners& ring, const WallCloudOptions& options,
              pcl::PointCloud<PointT>& cloud) {
  std::mt19937 random(options.seed + static_cast<unsigned>(cloud.size()));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d along = ring[(i + 1) % ring.size()] - a;
    const double height = options.z_max - options.z_min;
    const int count = static_cast<int>(options.density * along.norm() * height);
    const double facing = std::atan2(-along.x(), along.y());
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector2d p = a + unit(random) * along;
      const double z = options.z_min + height * unit(random);
      const double angle = facing + options.normal_noise * normal(random);
      addPoint({p.x() + options.noise * normal(random), p.y() + options.noise * normal(random),
                z + options.noise * normal(random)},
               {std::cos(angle), std::sin(angle), 0.0}, cloud);
    }
  }
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr wallCloud(const std::vector<Corners>& rings,
                                                const WallCloudOptions& options = {}) {
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const Corners& ring : rings) addWalls(ring, options, *cloud);
  cloud->header.frame_id = "building";
  cloud->header.stamp = 12345;
  return cloud;
}

/// Points that are no points: NaN positions, NaN normals, no normals.
template <typename PointT>
void addUnusable(pcl::PointCloud<PointT>& cloud) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 20; ++i) {
    addPoint({nan, 1.0, 0.5}, {1.0, 0.0, 0.0}, cloud);
    addPoint({3.0 + 0.1 * i, 3.0, 0.5}, {nan, 0.0, 0.0}, cloud);
    addPoint({3.0, 3.0 + 0.1 * i, 0.5}, {0.0, 0.0, 0.0}, cloud);
  }
  cloud.is_dense = false;
}

template <typename PointT>
bool sameBytes(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b) {
  if (a.size() != b.size() || a.width != b.width || a.height != b.height ||
      a.is_dense != b.is_dense || a.header.frame_id != b.header.frame_id) {
    return false;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(a[i].data, b[i].data, sizeof(a[i].data)) != 0 ||
        std::memcmp(a[i].data_n, b[i].data_n, sizeof(a[i].data_n)) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace storey::test
