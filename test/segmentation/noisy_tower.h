// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <storey/segmentation/detail/circular_clustering.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

constexpr double kDegree = M_PI / 180.0;

template <typename PointT>
PointT makePoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  PointT p;
  p.getVector3fMap() = position.cast<float>();
  p.getNormalVector3fMap() = normal.cast<float>();
  return p;
}

// A unit vector about `degrees` (standard deviation) away from `normal` in a random direction.
inline Eigen::Vector3d disturb(const Eigen::Vector3d& normal, double degrees,
                               std::mt19937& random) {
  std::normal_distribution<double> tilt(0.0, degrees * kDegree);
  std::uniform_real_distribution<double> turn(0.0, M_PI);
  const double around = turn(random);
  const Eigen::Vector3d axis = std::cos(around) * normal.unitOrthogonal() +
                               std::sin(around) * normal.cross(normal.unitOrthogonal());
  return Eigen::AngleAxisd(tilt(random), axis) * normal;
}

// A tower over a convex polygon, given by the angles of its walls' normals and their distances
// from the middle: walls of height 10, points at random in proportion to their lengths.
struct Tower {
  std::vector<double> angles;
  double inradius = 10.0;
  double position_noise = 0.1;
  double normal_noise = 15.0;  // degrees

  template <typename PointT>
  typename pcl::PointCloud<PointT>::Ptr sample(std::size_t num_points, unsigned int seed) const {
    std::mt19937 random(seed);
    const std::size_t n = angles.size();
    std::vector<Eigen::Vector3d> corners;  // of walls i and i + 1, on a common inscribed circle
    std::vector<double> lengths;
    for (std::size_t i = 0; i < n; ++i) {
      const double next = i + 1 < n ? angles[i + 1] : angles[0] + 2.0 * M_PI;
      const double middle = 0.5 * (angles[i] + next);
      corners.push_back(inradius / std::cos(0.5 * (next - angles[i])) *
                        Eigen::Vector3d(std::cos(middle), std::sin(middle), 0.0));
    }
    for (std::size_t i = 0; i < n; ++i) {
      lengths.push_back((corners[i] - corners[(i + n - 1) % n]).norm());
    }
    std::discrete_distribution<std::size_t> wall(lengths.begin(), lengths.end());
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, position_noise);
    auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
    for (std::size_t p = 0; p < num_points; ++p) {
      const std::size_t i = wall(random);
      const Eigen::Vector3d normal(std::cos(angles[i]), std::sin(angles[i]), 0.0);
      const double along = unit(random);
      Eigen::Vector3d position = (1.0 - along) * corners[(i + n - 1) % n] + along * corners[i];
      position.z() = 10.0 * unit(random);
      position += Eigen::Vector3d(noise(random), noise(random), noise(random));
      cloud->push_back(makePoint<PointT>(position, disturb(normal, normal_noise, random)));
    }
    return cloud;
  }
};

inline std::vector<double> regularAngles(std::size_t n, double start_degrees) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < n; ++i) {
    angles.push_back(start_degrees * kDegree +
                     2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n));
  }
  return angles;
}

inline double angleOf(const Eigen::Vector3d& direction) {
  return std::atan2(direction.y(), direction.x());
}

inline double angleBetween(double a, double b) {
  return std::abs(storey::detail::wrapAngle(a - b));
}

// Every true direction is found, nothing else is.
inline void expectDirections(const std::vector<Eigen::Vector3d>& found,
                             const std::vector<double>& truth, double tolerance_degrees) {
  ASSERT_EQ(found.size(), truth.size());
  for (const double angle : truth) {
    double nearest = M_PI;
    for (const Eigen::Vector3d& direction : found) {
      nearest = std::min(nearest, angleBetween(angleOf(direction), angle));
    }
    EXPECT_LE(nearest / kDegree, tolerance_degrees) << "wall at " << angle / kDegree;
  }
}
