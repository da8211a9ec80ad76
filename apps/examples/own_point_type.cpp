// SPDX-License-Identifier: BSD-3-Clause
// A point type of your own: register its fields as PCL asks, and every class takes it. Fields that
// storey does not know stay with their points.
#include <pcl/io/auto_io.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstdio>

struct EIGEN_ALIGN16 ScanPoint {
  PCL_ADD_POINT4D
  PCL_ADD_NORMAL4D
  double time;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(ScanPoint,
    (float, x, x)(float, y, y)(float, z, z)
    (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)
    (double, time, time))
// clang-format on

// The classes are templates: they are compiled here for the new type.
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/wall_extraction.h>

int main(int argc, char** argv) {
  pcl::PointCloud<pcl::PointNormal> read;
  if (argc != 2 || pcl::io::load(argv[1], read) != 0) {
    std::fprintf(stderr, "usage: own_point_type CLOUD\n");
    return 2;
  }
  const auto cloud = pcl::make_shared<pcl::PointCloud<ScanPoint>>();
  pcl::copyPointCloud(read, *cloud);
  for (std::size_t i = 0; i < cloud->size(); ++i) (*cloud)[i].time = 1e-5 * static_cast<double>(i);

  const auto planar = pcl::make_shared<pcl::PointCloud<ScanPoint>>();
  storey::PlanarConfidenceFilter<ScanPoint> filter;
  filter.setInputCloud(cloud);
  filter.filter(*planar);

  storey::WallExtraction<ScanPoint> extraction;
  extraction.setInputCloud(planar);
  std::vector<pcl::PointIndices> walls;
  extraction.extract(walls);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const storey::detail::WallLine& line = extraction.getLines()[w];
    std::printf("wall %zu: %zu points, normal %.3f %.3f, first seen at %.2f s\n", w,
                walls[w].indices.size(), line.normal.x(), line.normal.y(),
                (*planar)[static_cast<std::size_t>(walls[w].indices.front())].time);
  }
  return walls.empty() ? 1 : 0;
}
