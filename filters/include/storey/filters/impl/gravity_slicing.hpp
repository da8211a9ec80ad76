// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <storey/filters/detail/indices.h>
#include <storey/filters/detail/slice_layout.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pcl/impl/pcl_base.hpp>  // lets point types unknown to PCL link

namespace storey {

template <typename PointT>
void GravitySlicing<PointT>::extract(std::vector<pcl::PointIndices>& slices) {
  slices.clear();
  ranges_.clear();
  has_run_ = true;
  used_thickness_ = 0.0;
  if (!this->initCompute()) {
    return;
  }
  if (inputsValid()) {
    const pcl::Indices wall_points = findWallPoints();
    if (!wall_points.empty() && layOutSlices(wall_points)) {
      distribute(wall_points, slices);
    }
  }
  this->deinitCompute();
}

template <typename PointT>
bool GravitySlicing<PointT>::inputsValid() const {
  if (!(thickness_ >= 0.0 && std::isfinite(thickness_))) {
    PCL_ERROR("[storey::%s] the slice thickness is %g, expected >= 0.\n", getClassName(),
              thickness_);
    return false;
  }
  if (!(max_tilt_ > 0.0 && max_tilt_ <= M_PI_2)) {
    PCL_ERROR("[storey::%s] max_tilt is %g rad, expected (0, pi/2].\n", getClassName(), max_tilt_);
    return false;
  }
  return detail::indicesInside(*this->indices_, this->input_->size(), getClassName());
}

template <typename PointT>
bool GravitySlicing<PointT>::isWallPoint(const PointT& p) const {
  if (!detail::isSearchable({p.x, p.y, p.z})) {
    return false;
  }
  const double horizontal = std::hypot(p.normal_x, p.normal_y);
  const double vertical = std::abs(p.normal_z);
  if (!std::isfinite(horizontal + vertical) || horizontal + vertical == 0.0) {
    return keep_points_without_normals_;
  }
  return std::atan2(vertical, horizontal) <= max_tilt_;
}

template <typename PointT>
pcl::Indices GravitySlicing<PointT>::findWallPoints() const {
  pcl::Indices wall_points;
  for (const pcl::index_t i : *this->indices_) {
    if (isWallPoint((*this->input_)[static_cast<std::size_t>(i)])) {
      wall_points.push_back(i);
    }
  }
  std::sort(wall_points.begin(), wall_points.end());
  return wall_points;
}

template <typename PointT>
bool GravitySlicing<PointT>::layOutSlices(const pcl::Indices& wall_points) {
  std::vector<double> heights;
  std::vector<Eigen::Vector3f> positions;
  for (const pcl::index_t i : wall_points) {
    const PointT& p = (*this->input_)[static_cast<std::size_t>(i)];
    heights.push_back(p.z);
    positions.emplace_back(p.x, p.y, p.z);
  }
  const Range range = detail::robustHeightRange(heights);
  if (thickness_ > 0.0) {
    ranges_ = detail::stackSlices(range, thickness_, kMaxSlices);
    used_thickness_ = thickness_;
  } else {
    const CloudScale scale = detail::estimateCloudScale(positions, kDefaultScaleSeed);
    ranges_ = detail::divideIntoSlices(range, detail::deriveSliceThickness(scale));
    used_thickness_ = (range.second - range.first) / static_cast<double>(ranges_.size());
  }
  if (ranges_.empty()) {
    PCL_ERROR("[storey::%s] slices of %g between z = %g and %g are more than %zu.\n",
              getClassName(), thickness_, range.first, range.second, kMaxSlices);
    used_thickness_ = 0.0;
  }
  return !ranges_.empty();
}

template <typename PointT>
void GravitySlicing<PointT>::distribute(const pcl::Indices& wall_points,
                                        std::vector<pcl::PointIndices>& slices) const {
  slices.resize(ranges_.size());
  for (pcl::PointIndices& slice : slices) {
    slice.header = this->input_->header;
  }
  for (const pcl::index_t i : wall_points) {
    const std::ptrdiff_t s =
        detail::sliceAt(ranges_, (*this->input_)[static_cast<std::size_t>(i)].z);
    if (s >= 0) {
      slices[static_cast<std::size_t>(s)].indices.push_back(i);
    }
  }
}

template <typename PointT>
void projectSlice(const pcl::PointCloud<PointT>& cloud, const pcl::PointIndices& slice, double z,
                  pcl::PointCloud<PointT>& flat) {
  pcl::PointCloud<PointT> result;  // `flat` may be `cloud`
  result.header = cloud.header;
  result.sensor_origin_ = cloud.sensor_origin_;
  result.sensor_orientation_ = cloud.sensor_orientation_;
  if (detail::indicesInside(slice.indices, cloud.size(), "projectSlice")) {
    for (const pcl::index_t i : slice.indices) {
      PointT p = cloud[static_cast<std::size_t>(i)];
      const double length = std::hypot(p.normal_x, p.normal_y);
      const double unit = length > 0.0 && std::isfinite(length)
                              ? 1.0 / length
                              : std::numeric_limits<double>::quiet_NaN();
      p.z = static_cast<float>(z);
      p.normal_x = static_cast<float>(p.normal_x * unit);
      p.normal_y = static_cast<float>(p.normal_y * unit);
      p.normal_z = std::isfinite(unit) ? 0.0f : std::numeric_limits<float>::quiet_NaN();
      result.push_back(p);
      result.is_dense = result.is_dense && pcl::isXYZFinite(p);
    }
  }
  flat = result;
}

}  // namespace storey
