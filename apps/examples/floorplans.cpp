// SPDX-License-Identifier: BSD-3-Clause
// The floorplans alone: where they hold, what area and how many edges they have, and their outer
// rings as well-known text, which GIS programs and databases read.
#include <pcl/io/auto_io.h>
#include <pcl/point_types.h>
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/building_floorplan_extraction.h>

#include <cstdio>
#include <vector>

using Point = pcl::PointNormal;

void printRing(const storey::FloorplanRing& ring) {
  std::printf("POLYGON((");
  for (const Eigen::Vector2d& v : ring.vertices) std::printf("%.3f %.3f, ", v.x(), v.y());
  std::printf("%.3f %.3f))\n", ring.vertices.front().x(), ring.vertices.front().y());
}

int main(int argc, char** argv) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<Point>>();
  if (argc != 2 || pcl::io::load(argv[1], *cloud) != 0) {
    std::fprintf(stderr, "usage: floorplans CLOUD\n");
    return 2;
  }
  const auto planar = pcl::make_shared<pcl::Indices>();
  storey::PlanarConfidenceFilter<Point> filter;
  filter.setInputCloud(cloud);
  filter.filter(*planar);

  storey::BuildingFloorplanExtraction<Point> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(planar);
  std::vector<storey::FloorplanLayer> blocks;
  if (!extraction.extract(blocks)) return 1;
  for (const storey::FloorplanLayer& block : blocks) {
    std::printf("# z %.3f to %.3f: area %.2f, %zu edges\n", block.z_min, block.z_max,
                storey::area(block.plan), storey::countEdges(block.plan));
    for (const storey::FloorplanComponent& part : block.plan.components) printRing(part.outer);
  }
  return 0;
}
