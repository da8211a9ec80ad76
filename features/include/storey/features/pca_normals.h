// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/eigen_alignment.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace storey {

namespace detail {

/// Normal and surface variation of a neighbourhood; zero normal where there is none.
struct PcaNormal {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float variation = 0.0f;
};

/// One for each position. \param k neighbours, the point itself among them; 0: derived and returned
std::vector<PcaNormal> estimatePcaNormals(const std::vector<Eigen::Vector3f>& positions, int& k,
                                          unsigned int num_threads);

}  // namespace detail

/// Estimates a normal for every point of a cloud that has none: the direction of least variance
/// of its k nearest distinct positions, itself among them, in double precision about the
/// point. The sign is arbitrary (`OutwardNormalOrientation` sets it), but
/// the same for the same positions. If the point type has a curvature, it becomes the surface
/// variation l3 / (l1 + l2 + l3). NaN where the position is not finite or the neighbours span no
/// plane. \param[in,out] cloud its normals and curvatures are overwritten \param k >= 3, or 0
/// (default) for 80 density noise^2 within [16, 200], so that the neighbourhood is wider than five
/// noises \param num_threads 0 = all cores; the result does not depend on it \return the k that was
/// used, 0 after a PCL_ERROR if k is out of range (cloud unchanged)
template <typename PointT>
int estimateNormals(pcl::PointCloud<PointT>& cloud, int k = 0, unsigned int num_threads = 0) {
  if (k != 0 && k < 3) {
    PCL_ERROR("[storey::estimateNormals] k is %d, expected 0 or at least 3.\n", k);
    return 0;
  }
  const auto estimates = detail::estimatePcaNormals(detail::positionsOf(cloud), k, num_threads);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool valid = !estimates[i].normal.isZero();
    const Eigen::Vector3f n =
        valid ? estimates[i].normal
              : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
    cloud[i].normal_x = n.x();
    cloud[i].normal_y = n.y();
    cloud[i].normal_z = n.z();
    if constexpr (pcl::traits::has_curvature_v<PointT>) {
      cloud[i].curvature = valid ? estimates[i].variation : n.x();
    }
  }
  return k;
}

}  // namespace storey
