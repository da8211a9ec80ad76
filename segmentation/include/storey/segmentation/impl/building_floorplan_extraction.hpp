// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <storey/filters/cloud_scale.h>

#include <algorithm>
#include <cmath>
#include <pcl/impl/pcl_base.hpp>

namespace storey {
namespace detail {

constexpr double kWallMaxNormalZ = 0.57357644;  // sin(35 degrees), as GravitySlicing
constexpr double kLevelMinNormalZ = 0.9;        // cos(25 degrees)
constexpr double kMinWallSideInNoise = 20.0;
constexpr double kMinWallSideInExtent = 1.0 / 40.0;
constexpr double kMinComponentSideInNoise = 10.0;
constexpr double kBuildingLeastNoise = 1e-5;  // of the extent, where a cloud has none

/// Diagonal of the box around the wall points.
inline double extentOf(const std::vector<WallPoint>& points) {
  if (points.empty()) return 0.0;
  Eigen::Vector3d low(points[0].position.x(), points[0].position.y(), points[0].z);
  Eigen::Vector3d high = low;
  for (const WallPoint& p : points) {
    const Eigen::Vector3d q(p.position.x(), p.position.y(), p.z);
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  return (high - low).norm();
}

}  // namespace detail

template <typename PointT>
bool BuildingFloorplanExtraction<PointT>::parametersValid() const {
  for (const double value : {noise_, density_, min_wall_area_, block_cost_}) {
    if (!(value >= 0.0) || std::isinf(value)) {
      PCL_ERROR("[storey::BuildingFloorplanExtraction] a parameter is %g, expected >= 0.\n", value);
      return false;
    }
  }
  const auto size = static_cast<pcl::index_t>(this->input_->size());
  for (const pcl::index_t i : *this->indices_) {
    if (i < 0 || i >= size) {
      PCL_ERROR("[storey::BuildingFloorplanExtraction] index %d is outside the cloud.\n",
                static_cast<int>(i));
      return false;
    }
  }
  return true;
}

template <typename PointT>
void BuildingFloorplanExtraction<PointT>::gatherPoints(
    std::vector<detail::WallPoint>& walls, std::vector<detail::LevelPoint>& levels) const {
  for (const pcl::index_t i : *this->indices_) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    if (!pcl::isXYZFinite(p) || !pcl::isNormalFinite(p)) continue;
    const Eigen::Vector3d n = Eigen::Vector3d(p.normal_x, p.normal_y, p.normal_z);
    if (!(n.norm() > 0.0)) continue;
    const double nz = n.z() / n.norm();
    if (std::abs(nz) < detail::kWallMaxNormalZ) {
      walls.push_back({{p.x, p.y}, p.z, n.head<2>().normalized()});
    } else if (std::abs(nz) > detail::kLevelMinNormalZ) {
      levels.push_back({{p.x, p.y}, p.z, nz > 0.0});
    }
  }
}

template <typename PointT>
bool BuildingFloorplanExtraction<PointT>::extract(std::vector<FloorplanLayer>& blocks) {
  blocks.clear();
  result_ = {};
  if (!this->initCompute()) return false;
  if (!parametersValid()) {
    this->deinitCompute();
    return false;
  }
  detail::WallScale scale{noise_, density_};
  if (!(noise_ > 0.0) || !(density_ > 0.0)) {
    const CloudScale measured = estimateCloudScale(*this->input_);
    if (!(noise_ > 0.0)) {
      scale.noise = std::max(measured.noise, detail::kBuildingLeastNoise * measured.extent);
    }
    if (!(density_ > 0.0)) scale.density = measured.density;
  }
  std::vector<detail::WallPoint> walls;
  std::vector<detail::LevelPoint> levels;
  if (scale.noise > 0.0 && scale.density > 0.0) gatherPoints(walls, levels);
  const auto square = [&](double side) { return std::pow(side * scale.noise, 2); };
  detail::BuildingFloorplanOptions options;
  options.min_wall_area = min_wall_area_;
  if (!(options.min_wall_area > 0.0)) {
    options.min_wall_area =
        std::max(square(detail::kMinWallSideInNoise),
                 std::pow(detail::kMinWallSideInExtent * detail::extentOf(walls), 2));
  }
  options.block_cost = block_cost_;
  options.limits = limits_;
  options.min_area = square(detail::kMinComponentSideInNoise);
  result_ = detail::extractBuildingFloorplans(walls, levels, scale, options);
  blocks = result_.layers;
  this->deinitCompute();
  return !blocks.empty();
}

}  // namespace storey
