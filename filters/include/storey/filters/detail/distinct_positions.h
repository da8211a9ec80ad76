// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>
#include <storey/filters/detail/morton_curve.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// The different positions among many. A k-d tree over m copies of one point visits all m for a
/// query there; over distinct positions it never does, and the multiplicities give the same
/// neighbours. The order along a Morton curve makes queries, run in that order, three times faster
/// than in a random order, and makes results independent of the order of the input.
struct DistinctPositions {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;  ///< every searchable position once, Morton order
  std::vector<std::uint32_t> multiplicity;    ///< parallel to `cloud`, >= 1
  std::vector<pcl::index_t> id_of_input;      ///< place in `cloud` of every input position, or -1
};

/// O(n). Positions that are not `isSearchable` are left out (id -1). \param threads 0: all cores
DistinctPositions findDistinctPositions(const std::vector<Eigen::Vector3f>& positions,
                                        unsigned int threads = 1);

/// The same, in the memory of the positions.
DistinctPositions findDistinctPositions(std::vector<Eigen::Vector3f>&& positions,
                                        unsigned int threads = 1);

/// The positions of a cloud of any point type.
template <typename PointT>
std::vector<Eigen::Vector3f> positionsOf(const pcl::PointCloud<PointT>& cloud) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(cloud.size());
  for (const PointT& p : cloud) {
    positions.emplace_back(p.x, p.y, p.z);
  }
  return positions;
}

}  // namespace storey::detail
