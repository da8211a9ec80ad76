// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <storey/features/detail/oriented_points.h>
#include <storey/features/detail/outward_signs.h>
#include <storey/features/outward_normal_orientation.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/threads.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link

namespace storey {

namespace detail {
constexpr double kVoxelSpacing = 3.0;       // 9 points expected where a wall crosses a voxel
constexpr double kVoxelNoise = 4.0;         // a wall must be thinner than the step of a ray off it
constexpr double kVoxelExtent = 1.0 / 256;  // finer says no more and costs more
}  // namespace detail

template <typename PointT>
void OutwardNormalOrientation<PointT>::orient(pcl::PointCloud<PointT>& output) {
  confidences_.clear();
  confidence_ = 0.0;
  if (!this->initCompute()) {
    output.clear();
    return;
  }
  if (!parametersValid()) {
    output.clear();
  } else {
    if (&output != this->input_.get()) {
      output = *this->input_;
    }
    turn(output);
  }
  this->deinitCompute();
}

template <typename PointT>
bool OutwardNormalOrientation<PointT>::parametersValid() const {
  const char* name = "OutwardNormalOrientation";
  if (!up_.allFinite() || up_.isZero()) {
    PCL_ERROR("[storey::%s] the up vector is zero or not finite.\n", name);
  } else if (!(voxel_size_ >= 0.0) || !std::isfinite(voxel_size_)) {
    PCL_ERROR("[storey::%s] voxel_size is %g, expected >= 0.\n", name, voxel_size_);
  } else if (!detail::indicesInRange(*this->indices_, this->input_->size())) {
    PCL_ERROR("[storey::%s] an index lies outside the cloud of %zu points.\n", name,
              this->input_->size());
  } else {
    return true;
  }
  return false;
}

template <typename PointT>
void OutwardNormalOrientation<PointT>::turn(pcl::PointCloud<PointT>& output) {
  confidences_.assign(output.size(), 0.0f);
  detail::OrientedPoints points =
      detail::gatherOrientedPoints(*this->input_, *this->input_, *this->indices_);
  const double side = voxelSize();
  if (points.size() == 0 || !(side > 0.0)) {
    return;
  }
  const Eigen::Matrix3d to_upright =
      Eigen::Quaterniond::FromTwoVectors(up_, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.positions[i] = to_upright * points.positions[i];
    points.normals[i] = to_upright * points.normals[i];
  }
  const detail::OutwardSigns signs = detail::findOutwardSigns(points.positions, points.normals,
                                                              side, detail::threadsFor(threads_));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto id = static_cast<std::size_t>(points.ids[i]);
    confidences_[id] = signs.confidence[i];
    if (signs.sign[i] < 0) {
      output[id].normal_x = -output[id].normal_x;
      output[id].normal_y = -output[id].normal_y;
      output[id].normal_z = -output[id].normal_z;
    }
  }
  confidence_ = signs.wall_confidence;
}

template <typename PointT>
double OutwardNormalOrientation<PointT>::voxelSize() const {
  if (voxel_size_ > 0.0) {
    return voxel_size_;
  }
  const CloudScale scale =
      detail::estimateCloudScale(detail::positionsOf(*this->input_), kDefaultScaleSeed, threads_);
  const double spacing =
      scale.density > 0.0 ? detail::kVoxelSpacing / std::sqrt(scale.density) : 0.0;
  return std::max(
      {spacing, detail::kVoxelNoise * scale.noise, detail::kVoxelExtent * scale.extent});
}

}  // namespace storey
