// SPDX-License-Identifier: BSD-3-Clause
#include "stages/classes.h"

#include <pcl/common/point_tests.h>
#include <storey/segmentation/detail/point_classes.h>
#include <storey/segmentation/detail/wall_input.h>

#include "stages/attitude.h"

namespace storey::stages {

std::string classify(StageCloud& cloud) {
  requireNormals(cloud);
  ensureScale(cloud);
  const storey::detail::WallScale scale{cloud.state.noise, cloud.state.density};
  const pcl::Indices planar = planarPoints(cloud);
  std::vector<char> is_planar(cloud.points->size(), 0);
  for (const pcl::index_t index : planar) {
    const auto i = static_cast<std::size_t>(index);
    is_planar[i] = pcl::isNormalFinite((*cloud.points)[i]) ? 1 : 0;  // none where none was found
  }
  std::vector<storey::detail::OrientedPoint> points;
  for (const Point& p : *cloud.points) {
    points.push_back({p.getVector3fMap().cast<double>(), p.getNormalVector3fMap().cast<double>()});
  }
  const storey::detail::WallInput input =
      storey::detail::gatherWallInput(*cloud.points, planar, {scale.noise, scale.density, 0.0});
  const auto classes = classifyPoints(points, is_planar, scale, input.min_wall_area);
  std::size_t count[storey::detail::kNumPointClasses] = {};
  cloud.groups(Class).clear();
  for (const storey::detail::PointClass c : classes) {
    cloud.groups(Class).push_back(static_cast<int>(c));
    ++count[static_cast<std::size_t>(c)];
  }
  return format("%zu points of walls, %zu level, %zu ground, %zu sloped, %zu apart", count[0],
                count[1], count[2], count[3], count[5]);
}

}  // namespace storey::stages
