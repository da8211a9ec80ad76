// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

#include <cmath>
#include <cstdint>

/// The walls of a house 10 x 8 x 6 with its foot at z = 0: points on a regular lattice, displaced a
/// little by a fixed sequence.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeHouse() {
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  const float corners[5][2] = {{0, 0}, {10, 0}, {10, 8}, {0, 8}, {0, 0}};
  std::uint32_t state = 1;
  const auto jitter = [&] {  // uniform in +- 0.02
    state = state * 1664525u + 1013904223u;
    return 0.04f * (static_cast<float>(state >> 8) / 16777216.0f - 0.5f);
  };
  for (int wall = 0; wall < 4; ++wall) {
    const float dx = corners[wall + 1][0] - corners[wall][0];
    const float dy = corners[wall + 1][1] - corners[wall][1];
    const float length = std::hypot(dx, dy);
    for (float s = 0.05f; s < length; s += 0.1f) {
      for (float z = 0.05f; z < 6.0f; z += 0.1f) {
        PointT p;
        p.x = corners[wall][0] + s / length * dx + jitter();
        p.y = corners[wall][1] + s / length * dy + jitter();
        p.z = z + jitter();
        p.normal_x = dy / length;
        p.normal_y = -dx / length;
        p.normal_z = 0.0f;
        cloud->push_back(p);
      }
    }
  }
  return cloud;
}
