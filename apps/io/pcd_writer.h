// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <string>
#include <vector>

namespace storey::io {

namespace detail {

/// A cloud in memory, whatever its point type.
struct CloudView {
  std::vector<pcl::PCLPointField> fields;
  const unsigned char* points = nullptr;
  std::size_t point_bytes = 0;  ///< from one point to the next, padding included
  std::size_t width = 0;
  std::size_t height = 0;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

void writePcd(const std::string& path, const CloudView& cloud);

}  // namespace detail

/// Writes a cloud as binary PCD with all registered fields of its point type, for `pcl_viewer`.
/// Not `pcl::PCDWriter`: that one maps the file into memory, where a full disk ends in a signal or
/// goes unnoticed; here every write is checked and the file appears complete or not at all.
/// \throws Failure (CannotCreate, IoError)
template <typename PointT>
void writeCloudPcd(const std::string& path, const pcl::PointCloud<PointT>& cloud) {
  detail::CloudView view;
  view.fields = pcl::getFields<PointT>();
  view.points = reinterpret_cast<const unsigned char*>(cloud.points.data());
  view.point_bytes = sizeof(PointT);
  const bool organised = std::size_t{cloud.width} * cloud.height == cloud.size();
  view.width = organised ? cloud.width : cloud.size();
  view.height = organised ? cloud.height : 1;
  view.origin = cloud.sensor_origin_;
  view.orientation = cloud.sensor_orientation_;
  detail::writePcd(path, view);
}

}  // namespace storey::io
