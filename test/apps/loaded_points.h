// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/cloud_reader.h"

namespace storey::test {

/// The loaded point nearest to a position in the file's coordinates, for the reader's order is its
/// own. The cloud must not be empty.
inline const pcl::PointNormal& pointAt(const io::LoadedCloud& loaded,
                                       const Eigen::Vector3d& position) {
  const auto distance = [&](const pcl::PointNormal& point) {
    return (point.getVector3fMap().cast<double>() + loaded.offset - position).squaredNorm();
  };
  const pcl::PointNormal* nearest = &loaded.cloud->front();
  for (const pcl::PointNormal& point : *loaded.cloud) {
    if (distance(point) < distance(*nearest)) nearest = &point;
  }
  return *nearest;
}

}  // namespace storey::test
