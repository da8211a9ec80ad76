// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>
#include <storey/filters/detail/neighbor_search.h>

#include <array>
#include <functional>
#include <vector>

namespace storey::detail {

/// k = 1 - exp(-0.02 (l1 + l2 + l3) / l3) [Sui et al. 2016, Sec. 3.1] for the eigenvalues of the
/// covariance of the positions of each neighbourhood; 1 for l3 = 0 (a perfect plane or line), 0 if
/// all are 0 (no extent, so no evidence of a plane). 0 for fewer than 4 positions: three always lie
/// on a plane.
std::array<double, kLanes> planarConfidences(const MomentBatch& batch);

/// Finds the k nearest of position `id`, itself among them, as ids of positions. Called from
/// several threads at once.
using NeighborQuery = std::function<void(pcl::index_t id, int k, pcl::Indices& neighbors)>;

/// Confidences of the positions marked in `wanted` (parallel to `positions`; 0 elsewhere) from
/// their k nearest, or from all if there are fewer. `positions` are distinct, in Morton order.
/// \param query null: an exact search of our own
std::vector<double> planarConfidences(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& positions,
                                      const std::vector<char>& wanted, int k,
                                      const NeighborQuery& query, unsigned int threads);

}  // namespace storey::detail
