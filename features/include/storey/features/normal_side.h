// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <storey/features/detail/oriented_points.h>

#include <Eigen/Core>
#include <numeric>
#include <vector>

namespace storey {

/// What the normals of a cloud point out of, or into.
enum class NormalSide {
  Building,   ///< out of a solid
  Space,      ///< into an enclosed space: a yard or a room seen from inside
  Undecided,  ///< the walls contradict each other, or there are none
};

/// The evidence behind a `NormalSide`.
struct NormalSideEvidence {
  NormalSide side = NormalSide::Undecided;
  double outwardness = 0.0;    ///< sum n.(x - c) / sum |x - c|, in [-1, 1]; > 0: out of a solid
  double one_sidedness = 0.0;  ///< |mean of the wall normals|, in [0, 1]; 1: a single facade
};

namespace detail {
NormalSideEvidence judgeNormalSide(const OrientedPoints& points, const Eigen::Vector3d& up);
}  // namespace detail

/// Judges by the walls (normals within 30 degrees of level) whether given, oriented normals point
/// out of a building or into an enclosed space. Each voxel of 1/64 of the extent has one vote, so
/// that dense regions do not dominate; x and the centre c (the mean of the votes) are horizontal.
/// For a closed surface the sum is twice the volume, negative if seen from inside, wherever c is.
///
/// `Building` if outwardness > 0.1, `Space` if < -0.1, else `Undecided`. If one_sidedness > 0.4,
/// only one side was seen, which encloses nothing: `Building` whatever the outwardness. Points with
/// a non-finite position or normal, and outliers (`detail::mainBoxOf`), are left out. O(n log n).
/// \param up the up direction, of any length but not zero (else `Undecided`)
template <typename PointT>
NormalSideEvidence detectNormalSide(const pcl::PointCloud<PointT>& cloud,
                                    const Eigen::Vector3d& up) {
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return detail::judgeNormalSide(detail::gatherOrientedPoints(cloud, cloud, all), up);
}

}  // namespace storey
