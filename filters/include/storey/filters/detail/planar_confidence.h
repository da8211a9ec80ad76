// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace storey::detail {

/// k = 1 - exp(-0.02 (l1 + l2 + l3) / l3) [Sui et al. 2016, Sec. 3.1] of eigenvalues in any order;
/// 1 for l3 = 0 (a perfect plane or line), 0 if all are 0 (no extent, so no evidence of a plane).
double planarConfidence(const Eigen::Vector3d& eigenvalues);

/// Finds the k nearest of position `id`, itself among them, as ids of positions.
using NeighborQuery = std::function<void(pcl::index_t id, int k, pcl::Indices& neighbors)>;

/// A query by a k-d tree over `positions`, which must be distinct and searchable. The query may be
/// called from several threads.
NeighborQuery makeNeighborQuery(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& positions);

/// Confidences of the positions marked in `wanted` (parallel to `positions`; 0 elsewhere) from
/// their k nearest, or from all if there are fewer. Fewer than 4 positions have no confidence (0):
/// three always lie on a plane.
std::vector<double> planarConfidences(const pcl::PointCloud<pcl::PointXYZ>& positions,
                                      const std::vector<char>& wanted, int k,
                                      const NeighborQuery& query, unsigned int threads);

}  // namespace storey::detail
