// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/even_draw.h>
#include <storey/filters/detail/main_box.h>
#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/detail/place_order.h>
#include <storey/segmentation/detail/wall_lines.h>
#include <storey/segmentation/detail/wall_points.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace storey::detail {

constexpr double kWallMaxNormalZ = 0.57357644;  // sin(35 degrees), as GravitySlicing
constexpr double kLevelMinNormalZ = 0.9;        // cos(25 degrees)
constexpr double kMinWallSideInNoise = 20.0;
constexpr double kMinWallSideInExtent = 1.0 / 40.0;
constexpr double kLeastWallNoise = 1e-5;  // of the extent, where a cloud has none

/// What is known beforehand; zeros are derived from the cloud.
struct WallParameters {
  double noise = 0.0;
  double density = 0.0;
  double min_wall_area = 0.0;
};

/// A cloud as the search for walls sees it. Points of walls come in the order of their places.
struct WallInput {
  std::vector<WallPoint> walls;   ///< without outliers
  pcl::Indices wall_indices;      ///< of `walls` in the cloud
  std::vector<WallPoint> sample;  ///< at most 250,000 of `walls`, evenly drawn: to find lines with
  std::vector<LevelPoint> levels;
  WallScale scale;
  double min_wall_area = 0.0;
};

/// What a point is of, by its normal. `Neither` also where it or the position is not finite.
enum class Attitude { Upright, Level, Neither };

template <typename PointT>
Attitude attitudeOf(const PointT& p) {
  if (!pcl::isXYZFinite(p) || !pcl::isNormalFinite(p)) return Attitude::Neither;
  const Eigen::Vector3d n(p.normal_x, p.normal_y, p.normal_z);
  const double length = n.norm();
  if (!(length > 0.0)) return Attitude::Neither;
  const double nz = std::abs(n.z() / length);
  return nz < kWallMaxNormalZ    ? Attitude::Upright
         : nz > kLevelMinNormalZ ? Attitude::Level
                                 : Attitude::Neither;
}

/// The points of walls without outliers so far away that nothing could be derived from the extent.
template <typename PointT>
pcl::Indices withoutOutliers(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& of_walls) {
  const auto positionOf = [&cloud](pcl::index_t i) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    return Eigen::Vector3f(p.x, p.y, p.z);
  };
  std::vector<Eigen::Vector3f> sample;
  for (const pcl::index_t i : drawEvenly(of_walls, kLineSample)) sample.push_back(positionOf(i));
  const Eigen::AlignedBox3f box = mainBoxOf(sample);
  pcl::Indices inside;
  inside.reserve(of_walls.size());
  for (const pcl::index_t i : of_walls) {
    if (box.contains(positionOf(i))) inside.push_back(i);
  }
  return inside;
}

/// The least area of a wall, derived from a cloud with these points of walls.
template <typename PointT>
double leastWallArea(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& of_walls,
                     double noise) {
  Eigen::AlignedBox3f box;
  for (const pcl::index_t i : of_walls) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    box.extend(Eigen::Vector3f(p.x, p.y, p.z));
  }
  const double extent =
      box.isEmpty()
          ? 0.0
          : (box.max().template cast<double>() - box.min().template cast<double>()).norm();
  return std::max(std::pow(kMinWallSideInNoise * noise, 2),
                  std::pow(kMinWallSideInExtent * extent, 2));
}

template <typename PointT>
std::vector<WallPoint> toWallPoints(const pcl::PointCloud<PointT>& cloud,
                                    const pcl::Indices& indices, unsigned int threads = 0) {
  std::vector<WallPoint> points(indices.size());
  forEachChunk(indices.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PointT& p = cloud[static_cast<std::size_t>(indices[k])];
      points[k] = {{p.x, p.y}, p.z, Eigen::Vector2d(p.normal_x, p.normal_y).normalized()};
    }
  });
  return points;
}

/// Sorts the points by their normals; those with a non-finite position or normal are left out.
template <typename PointT>
WallInput gatherWallInput(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          const WallParameters& parameters, unsigned int threads) {
  WallInput input;
  input.scale = {parameters.noise, parameters.density};
  if (!(parameters.noise > 0.0) || !(parameters.density > 0.0)) {
    const CloudScale measured = storey::estimateCloudScale(cloud);
    if (!(parameters.noise > 0.0)) {
      input.scale.noise = std::max(measured.noise, kLeastWallNoise * measured.extent);
    }
    if (!(parameters.density > 0.0)) input.scale.density = measured.density;
  }
  if (!(input.scale.noise > 0.0) || !(input.scale.density > 0.0)) return input;
  pcl::Indices of_walls;
  for (const pcl::index_t i : indices) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    const Attitude attitude = attitudeOf(p);
    if (attitude == Attitude::Upright) of_walls.push_back(i);
    if (attitude == Attitude::Level) input.levels.push_back({{p.x, p.y}, p.z, p.normal_z > 0.0f});
  }
  of_walls = withoutOutliers(cloud, of_walls);
  input.min_wall_area = parameters.min_wall_area > 0.0
                            ? parameters.min_wall_area
                            : leastWallArea(cloud, of_walls, input.scale.noise);
  input.sample =
      toWallPoints(cloud, orderByPlace(cloud, drawEvenly(of_walls, kLineSample), threads), threads);
  input.wall_indices = orderByPlace(cloud, of_walls, threads);
  input.walls = toWallPoints(cloud, input.wall_indices, threads);
  return input;
}

}  // namespace storey::detail
