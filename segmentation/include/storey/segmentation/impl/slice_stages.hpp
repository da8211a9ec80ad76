// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/features/anisotropic_normal_estimation.h>
#include <storey/filters/anisotropic_position_refinement.h>
#include <storey/filters/gravity_slicing.h>
#include <storey/segmentation/dominant_direction_labeling.h>
#include <storey/segmentation/edge_region_growing.h>

namespace storey {

template <typename PointT>
void smoothSlice(const pcl::PointCloud<PointT>& cloud, const SliceStageOptions& options,
                 SliceStages<PointT>& stages) {
  pcl::PointIndices slice;
  slice.indices = stages.indices;
  projectSlice(cloud, slice, 0.5 * (stages.z_min + stages.z_max), stages.projected);
  const auto projected = pcl::make_shared<pcl::PointCloud<PointT>>(stages.projected);
  AnisotropicNormalEstimation<PointT> smoothing;
  smoothing.setInputCloud(projected);
  smoothing.setInputNormals(projected);
  smoothing.setKSearch(options.k);
  smoothing.setNumberOfThreads(1);
  smoothing.compute(stages.smoothed);
}

template <typename PointT>
void labelSlice(const SliceStageOptions& options, SliceStages<PointT>& stages) {
  DominantDirectionLabeling<PointT> labeling;
  labeling.setInputCloud(pcl::make_shared<pcl::PointCloud<PointT>>(stages.smoothed));
  labeling.setDirections(options.directions);
  pcl::PointCloud<pcl::Label> labels;
  labeling.segment(labels);
  stages.labels.assign(stages.smoothed.size(), -1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i].label >= options.directions.size()) continue;
    stages.labels[i] = static_cast<int>(labels[i].label);
  }
}

template <typename PointT>
void growSliceRegions(SliceStages<PointT>& stages) {
  const auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
  for (const int label : stages.labels) {
    labels->push_back(pcl::Label());
    labels->back().label = label < 0 ? kUnlabeled : static_cast<std::uint32_t>(label);
  }
  EdgeRegionGrowing<PointT> growing;
  growing.setInputCloud(pcl::make_shared<pcl::PointCloud<PointT>>(stages.smoothed));
  growing.setLabels(labels);
  growing.extract(stages.regions);
  stages.region_labels.clear();
  for (const std::uint32_t label : growing.getRegionLabels()) {
    stages.region_labels.push_back(static_cast<int>(label));
  }
}

template <typename PointT>
void refineSlice(const SliceStageOptions& options, SliceStages<PointT>& stages) {
  const auto labelled = pcl::make_shared<pcl::PointCloud<PointT>>(stages.smoothed);
  for (std::size_t i = 0; i < labelled->size(); ++i) {
    if (stages.labels[i] < 0) continue;
    (*labelled)[i].getNormalVector3fMap() =
        options.directions[static_cast<std::size_t>(stages.labels[i])].template cast<float>();
  }
  AnisotropicPositionRefinement<PointT> refinement;
  refinement.setInputCloud(labelled);
  refinement.setRegions(stages.regions);
  refinement.setKSearch(options.k);
  refinement.setNumberOfThreads(1);
  refinement.filter(stages.refined);
}

template <typename PointT>
void outlineSlice(const SliceStageOptions& options, SliceStages<PointT>& stages) {
  SliceFloorplanExtraction<PointT> extraction;
  extraction.setInputCloud(pcl::make_shared<pcl::PointCloud<PointT>>(stages.refined));
  extraction.setRegions(stages.regions, stages.region_labels);
  extraction.setDirections(options.directions);
  extraction.setNoise(options.noise);
  extraction.setLinkingMethod(options.linking);
  extraction.extract(stages.floorplan);
  stages.failure = extraction.getFailure();
  stages.segments = extraction.getSegments();
}

}  // namespace storey
