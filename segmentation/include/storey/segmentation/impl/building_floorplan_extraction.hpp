// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/segmentation/detail/wall_input.h>

#include <cmath>
#include <pcl/impl/pcl_base.hpp>

namespace storey {
namespace detail {

constexpr double kMinComponentSideInNoise = 10.0;

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
bool BuildingFloorplanExtraction<PointT>::extract(std::vector<FloorplanLayer>& blocks) {
  blocks.clear();
  result_ = {};
  if (!this->initCompute()) return false;
  if (!parametersValid()) {
    this->deinitCompute();
    return false;
  }
  const detail::WallInput input = detail::gatherWallInput(
      *this->input_, *this->indices_, {noise_, density_, min_wall_area_}, threads_);
  detail::BuildingFloorplanOptions options;
  options.min_wall_area = input.min_wall_area;
  options.block_cost = block_cost_;
  options.limits = limits_;
  options.steps = steps_;
  options.threads = threads_;
  options.min_area = std::pow(detail::kMinComponentSideInNoise * input.scale.noise, 2);
  result_ = detail::extractBuildingFloorplans(input, options);
  blocks = result_.layers;
  this->deinitCompute();
  return !blocks.empty();
}

}  // namespace storey
