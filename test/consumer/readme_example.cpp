// SPDX-License-Identifier: BSD-3-Clause
// The example of README.md, letter by letter between the two markers.
#include <pcl/PolygonMesh.h>
#include <pcl/point_types.h>
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/layerwise_floorplan_extraction.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "house.h"

namespace {
pcl::PointCloud<pcl::PointNormal>::Ptr readHouse() { return makeHouse<pcl::PointNormal>(); }
}  // namespace

int main() {
  // clang-format off
// README begin
pcl::PointCloud<pcl::PointNormal>::Ptr cloud = readHouse();  // upright, outward normals
storey::PlanarConfidenceFilter<pcl::PointNormal> planar;      // a pcl::Filter
planar.setInputCloud(cloud);
auto walls = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
planar.filter(*walls);

storey::LayerwiseFloorplanExtraction<pcl::PointNormal> extraction;
extraction.setInputCloud(walls);
std::vector<storey::FloorplanLayer> slices;
extraction.extract(slices);  // one floorplan a slice

storey::LayerwiseMRFReconstruction<pcl::PointNormal> reconstruction;  // a pcl::SurfaceReconstruction
reconstruction.setInputCloud(cloud);
reconstruction.setFloorplans(slices);
pcl::PolygonMesh mesh;
reconstruction.reconstruct(mesh);
// README end
  // clang-format on
  const storey::ModelCheck& check = reconstruction.getResult().check;
  std::printf("%zu triangles, volume %.2f\n", mesh.polygons.size(), check.volume);
  // The house is 10 x 8 x 6; its lattice of points ends half a step, 0.05, short of every edge.
  const bool good =
      check.ok() && mesh.polygons.size() == 12 && std::abs(check.volume - 480.0) < 10.0;
  return good ? 0 : 1;
}
