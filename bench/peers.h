// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace storey::bench {

/// Something that is done to a cloud, by us or by PCL, on one thread.
struct Peer {
  std::string name;
  std::size_t most_points;  ///< beyond, it takes minutes or gigabytes and is not run
  std::function<void(const pcl::PointCloud<pcl::PointNormal>::ConstPtr&)> run;
};

/// The planar confidence and the normals of storey and what PCL has nearest to them, and PCL's ways
/// from points to outlines and surfaces.
std::vector<Peer> peers();

}  // namespace storey::bench
