// SPDX-License-Identifier: BSD-3-Clause
// A PCL pipeline with one stage of storey in its middle: thin the cloud out, keep the points that
// lie on planes, and split what is left into its connected parts.
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/auto_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/planar_confidence_filter.h>

#include <cstdio>
#include <vector>

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

int main(int argc, char** argv) {
  const auto cloud = pcl::make_shared<Cloud>();
  if (argc != 2 || pcl::io::load(argv[1], *cloud) != 0) {
    std::fprintf(stderr, "usage: planar_points CLOUD\n");
    return 2;
  }
  const auto leaf = static_cast<float>(2.0 * storey::estimateCloudScale(*cloud).spacing);
  const auto thinned = pcl::make_shared<Cloud>();
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.filter(*thinned);

  const auto planar = pcl::make_shared<Cloud>();
  storey::PlanarConfidenceFilter<Point> confidence;
  confidence.setInputCloud(thinned);
  confidence.filter(*planar);

  pcl::EuclideanClusterExtraction<Point> clustering;
  clustering.setInputCloud(planar);
  clustering.setSearchMethod(pcl::make_shared<pcl::search::KdTree<Point>>());
  clustering.setClusterTolerance(3.0 * leaf);
  clustering.setMinClusterSize(100);
  std::vector<pcl::PointIndices> parts;
  clustering.extract(parts);

  std::printf("%zu points, thinned to %zu, %zu of them planar (k >= %.3f), in %zu parts\n",
              cloud->size(), thinned->size(), planar->size(), confidence.getThreshold(),
              parts.size());
  return parts.empty() ? 1 : 0;
}
