// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <storey/features/vertical_direction_estimation.h>
#include <storey/filters/cloud_scale.h>
#include <storey/segmentation/building_floorplan_extraction.h>
#include <storey/segmentation/layerwise_floorplan_extraction.h>
#include <storey/surface/layerwise_model.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "io/cloud_reader.h"
#include "reconstruct/options.h"

namespace storey::reconstruct {

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

struct StageTime {
  std::string name;
  double seconds = 0.0;
};

/// What every stage found, from the cloud to the model.
struct Result {
  io::LoadedCloud loaded;  ///< the cloud itself is moved on to `cloud`
  Cloud::Ptr cloud;        ///< upright (+z is up), with outward normals
  Eigen::Isometry3d local_to_input = Eigen::Isometry3d::Identity();
  int normals_k = 0;  ///< neighbours of estimated normals; 0: they were given
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the input's frame
  bool level = false;  ///< +z is within the accuracy of `up` and was taken for it
  VerticalQuality vertical;
  bool inside = false;  ///< the model is a space seen from inside
  std::string side_reason;
  CloudScale scale;
  double noise = 0.0;              ///< what the later stages work with
  double planar_threshold = 0.0;   ///< T_k
  std::vector<float> confidences;  ///< planar confidence of each point
  pcl::Indices planar;             ///< indices of the planar points
  std::vector<Eigen::Vector3d> directions;
  std::vector<std::size_t> direction_points;
  std::vector<int> point_directions;  ///< of each point; -1: none
  double slice_thickness = 0.0;
  std::vector<FloorplanLayer> slices;  ///< method paper: a floorplan for each slice
  std::vector<FloorplanLayer> blocks;  ///< method building
  detail::BuildingFloorplans building;
  std::vector<SliceStages<Point>> stages;
  LayerwiseModel model;
  std::vector<StageTime> times;
};

/// Takes the cloud `options.input` through all stages. \param progress is called at the end of each
/// stage with a line that says what it found \throws io::Failure (BadInput) with the reason where a
/// stage finds nothing to go on with
Result reconstruct(const Options& options, const std::function<void(const std::string&)>& progress);

/// The same for a cloud in memory; `options.input` is only its name in messages.
Result reconstruct(io::LoadedCloud cloud, const Options& options,
                   const std::function<void(const std::string&)>& progress);

}  // namespace storey::reconstruct
