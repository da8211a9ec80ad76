// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/segmentation/detail/position_search.h>
#include <storey/segmentation/detail/region_components.h>

#include <algorithm>
#include <cfloat>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link
#include <utility>

namespace storey {

template <typename PointT>
void EdgeRegionGrowing<PointT>::extract(std::vector<pcl::PointIndices>& regions) {
  regions.clear();
  region_labels_.clear();
  used_radius_ = 0.0;
  if (!this->initCompute()) {
    return;
  }
  if (parametersValid() &&
      detail::indicesInside(*this->indices_, this->input_->size(), getClassName())) {
    growRegions(regions);
  }
  this->deinitCompute();
}

template <typename PointT>
bool EdgeRegionGrowing<PointT>::parametersValid() const {
  if (radius_ != 0.0 && !(radius_ >= FLT_MIN && radius_ <= FLT_MAX)) {
    PCL_ERROR("[storey::%s] radius is %g, expected 0 or more.\n", getClassName(), radius_);
    return false;
  }
  if (!labels_) {
    PCL_ERROR("[storey::%s] no labels: call setLabels.\n", getClassName());
    return false;
  }
  if (labels_->size() != this->indices_->size()) {
    PCL_ERROR("[storey::%s] %zu labels for %zu points.\n", getClassName(), labels_->size(),
              this->indices_->size());
    return false;
  }
  return true;
}

template <typename PointT>
void EdgeRegionGrowing<PointT>::growRegions(std::vector<pcl::PointIndices>& regions) {
  std::vector<std::pair<pcl::index_t, std::uint32_t>> labeled;
  for (std::size_t place = 0; place < this->indices_->size(); ++place) {
    const pcl::index_t i = (*this->indices_)[place];
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    const std::uint32_t label = (*labels_)[place].label;
    if (label != kUnlabeled && detail::isSearchable({p.x, p.y, p.z})) {
      labeled.emplace_back(i, label);
    }
  }
  std::sort(labeled.begin(), labeled.end());  // so that regions come out ascending
  pcl::Indices indices;
  std::vector<std::uint32_t> labels;
  std::vector<Eigen::Vector3d> positions;
  for (const auto& [i, label] : labeled) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    indices.push_back(i);
    labels.push_back(label);
    positions.emplace_back(p.x, p.y, p.z);
  }
  used_radius_ = radius_ > 0.0 ? radius_ : deriveRadius(indices);
  const double radius =
      std::max(used_radius_, static_cast<double>(FLT_MIN));  // copies of one point
  const std::vector<std::size_t> component = detail::labeledComponents(positions, labels, radius);
  std::vector<pcl::PointIndices> found(indices.size());
  for (std::size_t j = 0; j < indices.size(); ++j) {
    found[component[j]].indices.push_back(indices[j]);
  }
  keepRegions(found, labels, regions);
}

template <typename PointT>
double EdgeRegionGrowing<PointT>::deriveRadius(const pcl::Indices& points) const {
  constexpr int kNeighbors = 8;
  constexpr double kSpacings = 3.0;
  constexpr std::size_t kMaxQueries = 2000;  // the median is then good to 2 %
  const detail::PositionSearch<PointT> search(*this->input_, points, nullptr);
  return kSpacings * search.medianSpacing(kNeighbors, kMaxQueries);
}

// found[c]: component c, with the label labels[c]; most are empty.
template <typename PointT>
void EdgeRegionGrowing<PointT>::keepRegions(std::vector<pcl::PointIndices>& found,
                                            const std::vector<std::uint32_t>& labels,
                                            std::vector<pcl::PointIndices>& regions) {
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < found.size(); ++c) {
    const std::size_t size = found[c].indices.size();
    if (size > 0 && size >= min_region_size_) {
      order.push_back(c);
    }
  }
  std::sort(order.begin(), order.end(), [&found](std::size_t a, std::size_t b) {
    const std::size_t size_a = found[a].indices.size();
    const std::size_t size_b = found[b].indices.size();
    return size_a != size_b ? size_a > size_b : a < b;  // c ascends with the first index
  });
  for (const std::size_t c : order) {
    region_labels_.push_back(labels[c]);
    regions.push_back(std::move(found[c]));
    regions.back().header = this->input_->header;
  }
}

}  // namespace storey
