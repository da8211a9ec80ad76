// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/oriented_point.h>

#include <Eigen/Geometry>
#include <vector>

namespace storey::detail {

/// Appends a face of points 0.1 apart over a x b from a corner; a x b is its normal.
inline void addFace(std::vector<OrientedPoint>& points, const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d normal = a.cross(b).normalized();
  for (double s = 0.05; s < a.norm(); s += 0.1) {
    for (double t = 0.05; t < b.norm(); t += 0.1) {
      const Eigen::Vector3d place = corner + s * a.normalized() + t * b.normalized();
      points.push_back({place.cast<float>(), normal.cast<float>()});
    }
  }
}

}  // namespace storey::detail
