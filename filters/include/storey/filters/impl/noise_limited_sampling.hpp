// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <storey/filters/detail/even_draw.h>
#include <storey/filters/detail/indices.h>

#include <algorithm>
#include <cmath>
#include <pcl/filters/impl/filter_indices.hpp>  // lets point types unknown to PCL link
#include <pcl/impl/pcl_base.hpp>
#include <utility>

namespace storey {

template <typename PointT>
void NoiseLimitedSampling<PointT>::applyFilter(PointCloud& output) {
  pcl::FilterIndices<PointT>::applyFilter(output);
  if (failed_) {
    output.clear();  // under setKeepOrganized the base copies the whole input
  } else if (!this->keep_organized_) {
    output.is_dense = true;  // the base copies the flag though no NaN is left
  }
}

template <typename PointT>
void NoiseLimitedSampling<PointT>::applyFilter(pcl::Indices& kept) {
  kept.clear();
  this->removed_indices_->clear();
  failed_ = !inputsValid();
  if (failed_) return;
  pcl::Indices finite;
  finite.reserve(this->indices_->size());
  for (const pcl::index_t i : *this->indices_) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    if (pcl::isXYZFinite(p)) finite.push_back(i);
  }
  pcl::Indices drawn = detail::drawEvenly(finite, sizeFor(finite));
  if (!this->negative_ && !this->extract_removed_indices_) {
    kept = std::move(drawn);
    return;
  }
  // Places in `finite` and `drawn` go up together, though indices may come in any order.
  auto next = drawn.begin();
  for (const pcl::index_t i : finite) {
    const bool is_drawn = next != drawn.end() && *next == i;
    if (is_drawn) ++next;
    (is_drawn != this->negative_ ? kept : *this->removed_indices_).push_back(i);
  }
  for (const pcl::index_t i : *this->indices_) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    if (!pcl::isXYZFinite(p)) this->removed_indices_->push_back(i);
  }
  if (!this->extract_removed_indices_) this->removed_indices_->clear();
}

template <typename PointT>
std::size_t NoiseLimitedSampling<PointT>::sizeFor(const pcl::Indices& finite) const {
  if (sample_size_ > 0) return sample_size_;
  if (finite.size() <= least_points_) return finite.size();
  const auto draw = [&](std::size_t count) {
    std::vector<Eigen::Vector3f> positions;
    positions.reserve(count);
    for (const pcl::index_t i : detail::drawEvenly(finite, count)) {
      const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
      positions.emplace_back(p.x, p.y, p.z);
    }
    return positions;
  };
  return detail::noiseLimitedSize(finite.size(), draw, noise_, points_per_noise_area_,
                                  least_points_, threads_);
}

template <typename PointT>
bool NoiseLimitedSampling<PointT>::inputsValid() const {
  const char* name = "NoiseLimitedSampling";
  if (!(noise_ >= 0.0) || std::isinf(noise_)) {
    PCL_ERROR("[storey::%s] the noise is %g, expected >= 0.\n", name, noise_);
    return false;
  }
  if (!(points_per_noise_area_ > 0.0) || std::isinf(points_per_noise_area_)) {
    PCL_ERROR("[storey::%s] %g points on a square of noise, expected > 0.\n", name,
              points_per_noise_area_);
    return false;
  }
  return detail::indicesInside(*this->indices_, this->input_->size(), name);
}

}  // namespace storey
