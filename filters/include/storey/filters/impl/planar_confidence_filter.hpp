// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/filters/detail/planar_confidence.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <pcl/filters/impl/filter_indices.hpp>  // lets point types unknown to PCL link
#include <pcl/impl/pcl_base.hpp>

namespace storey {

template <typename PointT>
PlanarConfidenceFilter<PointT>::PlanarConfidenceFilter(bool extract_removed_indices)
    : pcl::FilterIndices<PointT>(extract_removed_indices) {
  this->filter_name_ = "PlanarConfidenceFilter";
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::setKeptShare(double share) {
  kept_share_ = share;
  threshold_is_fixed_ = false;
  threshold_ = std::numeric_limits<double>::quiet_NaN();
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::setThreshold(double threshold) {
  threshold_ = threshold;
  threshold_is_fixed_ = true;
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::applyFilter(PointCloud& output) {
  pcl::FilterIndices<PointT>::applyFilter(output);
  if (failed_) {
    output.clear();  // under setKeepOrganized the base copies the whole input
  } else if (!this->keep_organized_) {
    output.is_dense = true;  // the base copies the flag though no NaN is left
  }
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::applyFilter(pcl::Indices& kept) {
  kept.clear();
  this->removed_indices_->clear();
  confidences_.clear();
  if (!threshold_is_fixed_) {
    threshold_ = std::numeric_limits<double>::quiet_NaN();
  }
  failed_ = !inputsValid();
  if (failed_) {
    return;
  }
  computeConfidences();
  chooseThreshold();
  for (std::size_t i = 0; i < this->indices_->size(); ++i) {
    const double confidence = confidences_[i];
    const bool planar = confidence >= threshold_;
    if (!std::isnan(confidence) && planar != this->negative_) {
      kept.push_back((*this->indices_)[i]);
    } else if (this->extract_removed_indices_) {
      this->removed_indices_->push_back((*this->indices_)[i]);
    }
  }
}

template <typename PointT>
bool PlanarConfidenceFilter<PointT>::inputsValid() const {
  const char* name = this->getClassName().c_str();
  if (k_ < 4) {
    PCL_ERROR("[storey::%s] k is %d, expected at least 4.\n", name, k_);
    return false;
  }
  if (!(kept_share_ > 0.0 && kept_share_ <= 1.0)) {
    PCL_ERROR("[storey::%s] the kept share is %g, expected (0, 1].\n", name, kept_share_);
    return false;
  }
  if (threshold_is_fixed_ && !(threshold_ >= 0.0 && threshold_ <= 1.0)) {
    PCL_ERROR("[storey::%s] the threshold is %g, expected [0, 1].\n", name, threshold_);
    return false;
  }
  return detail::indicesInside(*this->indices_, this->input_->size(), name);
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::computeConfidences() {
  const detail::DistinctPositions distinct =
      detail::findDistinctPositions(detail::positionsOf(*this->input_), threads_);
  const std::vector<double> of_position = confidencesOf(distinct);
  confidences_.reserve(this->indices_->size());
  for (const pcl::index_t i : *this->indices_) {
    const pcl::index_t id = distinct.id_of_input[static_cast<std::size_t>(i)];
    confidences_.push_back(id < 0 ? std::numeric_limits<double>::quiet_NaN()
                                  : of_position[static_cast<std::size_t>(id)]);
  }
}

template <typename PointT>
std::vector<double> PlanarConfidenceFilter<PointT>::confidencesOf(
    const detail::DistinctPositions& distinct) {
  std::vector<char> wanted(distinct.cloud->size(), 0);
  for (const pcl::index_t i : *this->indices_) {
    const pcl::index_t id = distinct.id_of_input[static_cast<std::size_t>(i)];
    if (id >= 0) {
      wanted[static_cast<std::size_t>(id)] = 1;
    }
  }
  if (!search_ || distinct.cloud->size() != this->input_->size()) {
    return detail::planarConfidences(distinct.cloud, wanted, k_, nullptr, threads_);
  }
  if (search_->getInputCloud() != this->input_) {
    search_->setInputCloud(this->input_);
  }
  pcl::Indices input_of_id(distinct.cloud->size());  // without duplicates a permutation
  for (std::size_t i = 0; i < distinct.id_of_input.size(); ++i) {
    input_of_id[static_cast<std::size_t>(distinct.id_of_input[i])] = static_cast<pcl::index_t>(i);
  }
  const auto query = [&](pcl::index_t id, int k, pcl::Indices& neighbors) {
    std::vector<float> squared_distances;
    const auto i = static_cast<std::size_t>(input_of_id[static_cast<std::size_t>(id)]);
    search_->nearestKSearch((*this->input_)[i], k, neighbors, squared_distances);
    for (pcl::index_t& j : neighbors) {
      j = distinct.id_of_input[static_cast<std::size_t>(j)];
    }
  };
  return detail::planarConfidences(distinct.cloud, wanted, k_, query, threads_);
}

template <typename PointT>
void PlanarConfidenceFilter<PointT>::chooseThreshold() {
  if (threshold_is_fixed_) {
    return;
  }
  std::vector<double> sorted;
  sorted.reserve(confidences_.size());
  std::copy_if(confidences_.begin(), confidences_.end(), std::back_inserter(sorted),
               [](double confidence) { return !std::isnan(confidence); });
  if (sorted.empty()) {
    return;
  }
  constexpr double kRounding = 1e-9;  // 0.85 x 100 points are 85, not 85.00000001 and so 86
  const auto n = static_cast<double>(sorted.size());
  const auto num_kept =
      static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(kept_share_ * n * (1.0 - kRounding))));
  const auto lowest_kept = sorted.end() - num_kept;
  std::nth_element(sorted.begin(), lowest_kept, sorted.end());
  threshold_ = *lowest_kept;
}

}  // namespace storey
