// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/types.h>
#include <storey/filters/cloud_scale.h>

#include <vector>

namespace storey::detail {

/// The scale of the indexed points alone: the others may be of another kind.
template <typename PointT>
CloudScale scaleOfIndexed(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(indices.size());
  for (const pcl::index_t i : indices) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    positions.emplace_back(p.x, p.y, p.z);
  }
  return estimateCloudScale(positions, kDefaultScaleSeed);
}

}  // namespace storey::detail
