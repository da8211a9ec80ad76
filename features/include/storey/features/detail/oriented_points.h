// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// The usable points of a cloud in double precision, about an origin amid them.
struct OrientedPoints {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< centre of the box of all usable points
  std::vector<Eigen::Vector3d> positions;            ///< less `origin`
  std::vector<Eigen::Vector3d> normals;              ///< unit, parallel to `positions`
  std::vector<pcl::index_t> ids;                     ///< place of each in the cloud

  std::size_t size() const { return positions.size(); }
};

/// The normal of a point, made unit; zero if it is not finite or has no length.
template <typename NormalT>
Eigen::Vector3d unitNormal(const NormalT& n) {
  const Eigen::Vector3d v(n.normal_x, n.normal_y, n.normal_z);
  const double length = v.norm();
  if (!(length > 1e-6) || !std::isfinite(length)) {
    return Eigen::Vector3d::Zero();
  }
  return v / length;
}

/// Whether all indices lie in [0, size): PCL checks neither its own nor the user's.
inline bool indicesInRange(const pcl::Indices& indices, std::size_t size) {
  for (const pcl::index_t i : indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= size) {
      return false;
    }
  }
  return true;
}

/// Gathers the indexed points whose position and normal are finite and whose normal has a length.
/// \param normals parallel to `cloud`; indices must be in range.
template <typename PointT, typename NormalT>
OrientedPoints gatherOrientedPoints(const pcl::PointCloud<PointT>& cloud,
                                    const pcl::PointCloud<NormalT>& normals,
                                    const pcl::Indices& indices) {
  OrientedPoints result;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  result.positions.reserve(indices.size());
  result.normals.reserve(indices.size());
  result.ids.reserve(indices.size());
  for (const pcl::index_t id : indices) {
    const auto i = static_cast<std::size_t>(id);
    const Eigen::Vector3d x(cloud[i].x, cloud[i].y, cloud[i].z);
    const Eigen::Vector3d n = unitNormal(normals[i]);
    if (!x.allFinite() || n.isZero()) {
      continue;
    }
    low = result.ids.empty() ? x : Eigen::Vector3d(low.cwiseMin(x));
    high = result.ids.empty() ? x : Eigen::Vector3d(high.cwiseMax(x));
    result.positions.push_back(x);
    result.normals.push_back(n);
    result.ids.push_back(id);
  }
  result.origin = (low + high) / 2.0;
  for (Eigen::Vector3d& x : result.positions) {
    x -= result.origin;
  }
  return result;
}

}  // namespace storey::detail
