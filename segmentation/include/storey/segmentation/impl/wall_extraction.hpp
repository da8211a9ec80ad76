// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/segmentation/detail/wall_input.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <algorithm>
#include <cmath>
#include <pcl/impl/pcl_base.hpp>

namespace storey {

template <typename PointT>
bool WallExtraction<PointT>::parametersValid() const {
  for (const double value : {parameters_.noise, parameters_.density, parameters_.min_wall_area}) {
    if (!(value >= 0.0) || std::isinf(value)) {
      PCL_ERROR("[storey::%s] a parameter is %g, expected >= 0.\n", getClassName(), value);
      return false;
    }
  }
  const auto size = static_cast<pcl::index_t>(this->input_->size());
  for (const pcl::index_t i : *this->indices_) {
    if (i < 0 || i >= size) {
      PCL_ERROR("[storey::%s] index %d is outside the cloud.\n", getClassName(),
                static_cast<int>(i));
      return false;
    }
  }
  return true;
}

template <typename PointT>
void WallExtraction<PointT>::extract(std::vector<pcl::PointIndices>& walls) {
  walls.clear();
  lines_.clear();
  if (!this->initCompute()) return;
  if (!parametersValid()) {
    this->deinitCompute();
    return;
  }
  const detail::WallInput input =
      detail::gatherWallInput(*this->input_, *this->indices_, parameters_, threads_);
  std::vector<detail::WallLine> lines;
  if (!input.sample.empty()) {
    detail::WallScale scale = input.scale;
    scale.density *=
        static_cast<double>(input.sample.size()) / static_cast<double>(input.walls.size());
    lines = detail::findWallLines(input.sample, scale, {input.min_wall_area, {}, threads_});
  }
  std::vector<pcl::PointIndices> found(lines.size());
  const std::vector<int> wall_of = detail::assignToWalls(input.walls, lines, input.scale);
  for (std::size_t i = 0; i < wall_of.size(); ++i) {
    if (wall_of[i] < 0) continue;
    found[static_cast<std::size_t>(wall_of[i])].indices.push_back(input.wall_indices[i]);
  }
  std::vector<std::size_t> order;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    std::sort(found[l].indices.begin(), found[l].indices.end());
    if (!found[l].indices.empty()) order.push_back(l);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const pcl::Indices& one = found[a].indices;
    const pcl::Indices& other = found[b].indices;
    return one.size() != other.size() ? one.size() > other.size() : one.front() < other.front();
  });
  for (const std::size_t l : order) {
    found[l].header = this->input_->header;
    walls.push_back(std::move(found[l]));
    lines_.push_back(std::move(lines[l]));
  }
  this->deinitCompute();
}

}  // namespace storey
