// SPDX-License-Identifier: BSD-3-Clause
#include "stages/classes.h"

#include <pcl/common/point_tests.h>
#include <storey/segmentation/detail/point_classes.h>
#include <storey/segmentation/detail/wall_input.h>

#include "stages/attitude.h"

namespace storey::stages {

std::string classify(StageCloud& cloud, unsigned int threads) {
  requireNormals(cloud);
  ensureScale(cloud);
  const storey::detail::WallScale scale{cloud.state.noise, cloud.state.density};
  std::vector<storey::detail::OrientedPoint> points;
  points.reserve(cloud.points->size());
  for (const Point& p : *cloud.points) {
    points.push_back({p.getVector3fMap(), p.getNormalVector3fMap()});
  }
  std::vector<char> is_planar(points.size(), 0);
  pcl::Indices of_walls;
  for (const pcl::index_t i : planarPoints(cloud)) {
    const Point& p = (*cloud.points)[static_cast<std::size_t>(i)];
    is_planar[static_cast<std::size_t>(i)] = pcl::isNormalFinite(p) ? 1 : 0;  // not found: none
    if (storey::detail::attitudeOf(p) == storey::detail::Attitude::Upright) of_walls.push_back(i);
  }
  of_walls = storey::detail::withoutOutliers(*cloud.points, of_walls);
  const double least_wall =
      storey::detail::leastWallArea(*cloud.points, of_walls, cloud.state.noise);
  const auto classes = classifyPoints(points, is_planar, scale, least_wall, threads);
  std::size_t count[storey::detail::kNumPointClasses] = {};
  std::vector<int>& groups = cloud.groups(Class);
  groups.resize(classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    groups[i] = static_cast<int>(classes[i]);
    ++count[static_cast<std::size_t>(classes[i])];
  }
  return format("%zu points of walls, %zu level, %zu ground, %zu sloped, %zu apart, %zu small",
                count[0], count[1], count[2], count[3], count[5], count[6]);
}

}  // namespace storey::stages
