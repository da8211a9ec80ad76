// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using Directions = std::vector<Eigen::Vector3d>;

inline Directions regularDirections(int n) {
  Directions directions;
  for (int i = 0; i < n; ++i) {
    directions.emplace_back(std::cos(2.0 * M_PI * i / n), std::sin(2.0 * M_PI * i / n), 0.0);
  }
  return directions;
}

template <typename PointT>
struct Slice {
  typename pcl::PointCloud<PointT>::Ptr cloud{new pcl::PointCloud<PointT>};
  std::vector<std::uint32_t> truth;
};

// A slice of height 1 of a regular polygon, its walls 10 away from the middle, noise 0.1 on
// positions and `normal_noise` degrees on the angles of normals.
template <typename PointT>
Slice<PointT> makeSlice(int num_walls, int num_points, double normal_noise, unsigned int seed) {
  std::mt19937 random(seed);
  const double half_length = 10.0 * std::tan(M_PI / num_walls);
  std::uniform_real_distribution<double> along(-half_length, half_length);
  std::uniform_real_distribution<double> height(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::normal_distribution<double> turn(0.0, normal_noise * M_PI / 180.0);
  const Directions directions = regularDirections(num_walls);
  Slice<PointT> slice;
  for (int i = 0; i < num_points; ++i) {
    const auto wall = static_cast<std::size_t>(i % num_walls);
    const Eigen::Vector3d& out = directions[wall];
    const Eigen::Vector3d side(-out.y(), out.x(), 0.0);
    const Eigen::Vector3d place = (10.0 + noise(random)) * out + along(random) * side +
                                  height(random) * Eigen::Vector3d::UnitZ();
    const double angle = turn(random);
    const Eigen::Vector3d normal = std::cos(angle) * out + std::sin(angle) * side;
    PointT p;
    p.getVector3fMap() = place.cast<float>();
    p.getNormalVector3fMap() = normal.cast<float>();
    slice.cloud->push_back(p);
    slice.truth.push_back(static_cast<std::uint32_t>(wall));
  }
  slice.cloud->header.frame_id = "slice";
  return slice;
}
