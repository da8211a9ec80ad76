// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/point_types.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/segmentation/slice_floorplan_extraction.h>

#include <string>
#include <vector>

namespace storey {

/// All that is known of one slice on its way from points to a floorplan. The clouds are parallel:
/// point i of each is point `indices[i]` of the input.
template <typename PointT>
struct SliceStages {
  double z_min = 0.0;
  double z_max = 0.0;
  pcl::Indices indices;
  pcl::PointCloud<PointT> projected;       ///< onto the horizontal plane at mid-height
  pcl::PointCloud<PointT> smoothed;        ///< normals by (1)-(3)
  std::vector<int> labels;                 ///< index of the direction by (4)-(6); -1: none
  std::vector<pcl::PointIndices> regions;  ///< edge regions, of points of the slice
  std::vector<int> region_labels;          ///< parallel to `regions`
  pcl::PointCloud<PointT> refined;         ///< positions by (7)-(8), normals of the labels
  std::vector<detail::LineSegment> segments;
  Floorplan floorplan;
  std::string failure;  ///< why there is no floorplan; empty if there is one
};

/// What the steps of a slice need to know.
struct SliceStageOptions {
  std::vector<Eigen::Vector3d> directions;  ///< dominant ones, horizontal unit vectors
  double noise = 0.0;                       ///< standard deviation across the walls, > 0
  int k = 30;                               ///< neighbours, for the normals and the positions
  detail::LinkingMethod linking = detail::LinkingMethod::Optimal;
};

// The way of a slice from points to a floorplan, step by step, each from what the steps before it
// left in `SliceStages`. One thread each.

/// Projects the points `indices` of the cloud and smooths their normals: `projectSlice`,
/// `AnisotropicNormalEstimation`.
template <typename PointT>
void smoothSlice(const pcl::PointCloud<PointT>& cloud, const SliceStageOptions& options,
                 SliceStages<PointT>& stages);

/// `DominantDirectionLabeling` of the smoothed points.
template <typename PointT>
void labelSlice(const SliceStageOptions& options, SliceStages<PointT>& stages);

/// `EdgeRegionGrowing` over the labelled points.
template <typename PointT>
void growSliceRegions(SliceStages<PointT>& stages);

/// `AnisotropicPositionRefinement` within the regions; the normals become those of the labels.
template <typename PointT>
void refineSlice(const SliceStageOptions& options, SliceStages<PointT>& stages);

/// `SliceFloorplanExtraction` from the refined points and the regions.
template <typename PointT>
void outlineSlice(const SliceStageOptions& options, SliceStages<PointT>& stages);

}  // namespace storey

#include <storey/segmentation/impl/slice_stages.hpp>
