// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <storey/filters/cloud_scale.h>
#include <storey/segmentation/detail/cell_energy.h>
#include <storey/segmentation/detail/wall_points.h>

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

/// A cloud as the search for walls sees it.
struct WallInput {
  std::vector<WallPoint> walls;
  pcl::Indices wall_indices;  ///< of `walls` in the cloud
  std::vector<LevelPoint> levels;
  WallScale scale;
  double min_wall_area = 0.0;
};

/// Diagonal of the box around the wall points.
double extentOf(const std::vector<WallPoint>& points);

/// Sorts the points by their normals; those with a non-finite position or normal are left out.
template <typename PointT>
WallInput gatherWallInput(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                          const WallParameters& parameters) {
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
  for (const pcl::index_t i : indices) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    if (!pcl::isXYZFinite(p) || !pcl::isNormalFinite(p)) continue;
    const Eigen::Vector3d n(p.normal_x, p.normal_y, p.normal_z);
    if (!(n.norm() > 0.0)) continue;
    const double nz = n.z() / n.norm();
    if (std::abs(nz) < kWallMaxNormalZ) {
      input.walls.push_back({{p.x, p.y}, p.z, n.head<2>().normalized()});
      input.wall_indices.push_back(i);
    } else if (std::abs(nz) > kLevelMinNormalZ) {
      input.levels.push_back({{p.x, p.y}, p.z, nz > 0.0});
    }
  }
  input.min_wall_area = parameters.min_wall_area;
  if (!(input.min_wall_area > 0.0)) {
    input.min_wall_area = std::max(std::pow(kMinWallSideInNoise * input.scale.noise, 2),
                                   std::pow(kMinWallSideInExtent * extentOf(input.walls), 2));
  }
  return input;
}

}  // namespace storey::detail
