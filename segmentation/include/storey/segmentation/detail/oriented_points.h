// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/types.h>
#include <storey/filters/detail/distinct_positions.h>

#include <Eigen/Core>
#include <cmath>
#include <type_traits>
#include <vector>

namespace storey::detail {

/// Points with a searchable position and a normal of length > 0. \tparam Normal a vector: floats
/// take half the memory
template <typename Normal>
struct LabelPoints {
  pcl::Indices indices;         ///< into the cloud
  pcl::Indices places;          ///< in the list of indices they were taken from
  std::vector<Normal> normals;  ///< unit length

  std::size_t size() const { return indices.size(); }
};

/// The normals of a stage: those given, else the fields of the cloud itself. A PCL_ERROR in the
/// name of the class `caller` and null if there are none, or not one for each point of the cloud.
template <typename PointT, typename NormalT>
const pcl::PointCloud<NormalT>* chooseNormals(
    const pcl::PointCloud<PointT>& cloud,
    const typename pcl::PointCloud<NormalT>::ConstPtr& normals, const char* caller) {
  if (normals) {
    if (normals->size() == cloud.size()) {
      return normals.get();
    }
    PCL_ERROR("[storey::%s] %zu normals for a cloud of %zu points.\n", caller, normals->size(),
              cloud.size());
    return nullptr;
  }
  if constexpr (std::is_same_v<PointT, NormalT>) {
    return &cloud;
  } else {
    PCL_ERROR("[storey::%s] no normals: call setInputNormals.\n", caller);
    return nullptr;
  }
}

/// \param normals parallel to `cloud`; the points keep the order of `indices`
template <typename Normal, typename PointT, typename NormalT>
LabelPoints<Normal> collectOrientedPoints(const pcl::PointCloud<PointT>& cloud,
                                          const pcl::PointCloud<NormalT>& normals,
                                          const pcl::Indices& indices) {
  LabelPoints<Normal> result;
  result.indices.reserve(indices.size());
  result.places.reserve(indices.size());
  result.normals.reserve(indices.size());
  for (std::size_t place = 0; place < indices.size(); ++place) {
    const auto i = static_cast<std::size_t>(indices[place]);
    const PointT& p = cloud[i];
    const Eigen::Vector3d normal(normals[i].normal_x, normals[i].normal_y, normals[i].normal_z);
    const double length = normal.norm();
    if (isSearchable({p.x, p.y, p.z}) && std::isfinite(length) && length > 0.0) {
      result.indices.push_back(indices[place]);
      result.places.push_back(static_cast<pcl::index_t>(place));
      result.normals.push_back((normal / length).cast<typename Normal::Scalar>());
    }
  }
  return result;
}

}  // namespace storey::detail
