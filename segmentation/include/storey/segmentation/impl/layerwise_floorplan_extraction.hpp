// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/filters/detail/threads.h>
#include <storey/filters/gravity_slicing.h>
#include <storey/segmentation/detail/indexed_scale.h>
#include <storey/segmentation/dominant_direction_clustering.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace storey {

template <typename PointT>
bool LayerwiseFloorplanExtraction<PointT>::parametersValid() const {
  const auto isLength = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!isLength(noise_) || !isLength(thickness_) || k_ < 3) {
    PCL_ERROR("[storey::%s] noise is %g, thickness %g, k %d; expected >= 0, >= 0, >= 3.\n",
              getClassName(), noise_, thickness_, k_);
    return false;
  }
  return detail::indicesInside(*this->indices_, this->input_->size(), getClassName());
}

template <typename PointT>
bool LayerwiseFloorplanExtraction<PointT>::prepare(std::vector<pcl::PointIndices>& slices) {
  if (!parametersValid()) return false;
  const CloudScale scale =
      noise_ > 0.0 ? CloudScale{noise_} : detail::scaleOfIndexed(*this->input_, *this->indices_);
  used_noise_ = std::max(scale.noise, detail::kSliceLeastNoise * scale.extent);
  GravitySlicing<PointT> slicing;
  slicing.setInputCloud(this->input_);
  slicing.setIndices(this->indices_);
  slicing.setSliceThickness(thickness_);
  slicing.extract(slices);
  used_thickness_ = slicing.getSliceThickness();
  if (slices.empty()) {
    PCL_ERROR("[storey::%s] no wall points.\n", getClassName());
    return false;
  }
  used_directions_ = directions_;
  if (directions_.empty()) {
    DominantDirectionClustering<PointT> clustering;
    clustering.setInputCloud(this->input_);
    clustering.setIndices(this->indices_);
    clustering.setNumberOfThreads(threads_);
    std::vector<pcl::PointIndices> clusters;
    clustering.extract(clusters);
    used_directions_ = clustering.getDirections();
  }
  stages_.assign(slices.size(), {});
  for (std::size_t i = 0; i < slices.size(); ++i) {
    stages_[i].z_min = slicing.getSliceRanges()[i].first;
    stages_[i].z_max = slicing.getSliceRanges()[i].second;
  }
  return true;
}

template <typename PointT>
void LayerwiseFloorplanExtraction<PointT>::processSlice(const pcl::PointIndices& slice,
                                                        SliceStages<PointT>& stages) const {
  stages.indices = slice.indices;
  if (slice.indices.empty()) {
    stages.failure = "no points";
    return;
  }
  const SliceStageOptions options{used_directions_, used_noise_, k_, method_};
  smoothSlice(*this->input_, options, stages);
  labelSlice(options, stages);
  growSliceRegions(stages);
  refineSlice(options, stages);
  outlineSlice(options, stages);
  if (keep_stages_) return;
  stages.projected = {};
  stages.smoothed = {};
  stages.refined = {};
  stages.labels = {};
  stages.regions = {};
  stages.region_labels = {};
}

template <typename PointT>
bool LayerwiseFloorplanExtraction<PointT>::extract(std::vector<FloorplanLayer>& layers) {
  layers.clear();
  stages_.clear();
  used_thickness_ = 0.0;
  used_directions_.clear();
  if (!this->initCompute()) return false;
  std::vector<pcl::PointIndices> slices;
  const bool prepared = prepare(slices);
  if (prepared) {
    const auto count = static_cast<std::ptrdiff_t>(slices.size());
#pragma omp parallel for num_threads(detail::threadsFor(threads_)) schedule(dynamic, 1)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const auto s = static_cast<std::size_t>(i);
      try {  // nothing may leave the parallel region; a slice that fails is skipped
        processSlice(slices[s], stages_[s]);
      } catch (const std::exception& error) {
        stages_[s].floorplan = {};
        stages_[s].failure = error.what();
      }
    }
    for (const SliceStages<PointT>& stages : stages_) {
      layers.push_back({stages.z_min, stages.z_max, stages.floorplan});
    }
  }
  this->deinitCompute();
  return prepared;
}

}  // namespace storey
