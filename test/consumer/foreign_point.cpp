// SPDX-License-Identifier: BSD-3-Clause
// Every class with a point type that neither PCL nor storey has compiled.
#include "../foreign_point.h"

#include <storey/features/anisotropic_normal_estimation.h>
#include <storey/features/outward_normal_orientation.h>
#include <storey/features/vertical_direction_estimation.h>
#include <storey/filters/anisotropic_position_refinement.h>
#include <storey/filters/gravity_slicing.h>
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/dominant_direction_clustering.h>
#include <storey/segmentation/dominant_direction_labeling.h>
#include <storey/segmentation/edge_region_growing.h>
#include <storey/segmentation/slice_floorplan_extraction.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <cmath>
#include <cstdio>

#include "house.h"

int main() {
  const auto cloud = makeHouse<ForeignPoint>();
  Eigen::Vector3d up;
  storey::VerticalDirectionEstimation<ForeignPoint> vertical;
  vertical.setInputCloud(cloud);
  if (!vertical.compute(up) || up.z() < 0.9999) return 1;

  storey::DominantDirectionClustering<ForeignPoint> directions;
  directions.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  directions.extract(clusters);
  if (clusters.size() != 4) return 2;

  storey::GravitySlicing<ForeignPoint> slicing;
  slicing.setInputCloud(cloud);
  std::vector<pcl::PointIndices> slices;
  slicing.extract(slices);
  if (slices.empty()) return 3;

  pcl::PointCloud<ForeignPoint> smoothed;
  storey::AnisotropicNormalEstimation<ForeignPoint> normals;
  normals.setInputCloud(cloud);
  normals.setInputNormals(cloud);
  normals.setKSearch(10);
  normals.compute(smoothed);
  if (smoothed.size() != cloud->size()) return 4;

  storey::LayerwiseMRFReconstruction<ForeignPoint> reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  std::printf("%zu triangles\n", mesh.polygons.size());
  return reconstruction.getResult().check.ok() && mesh.polygons.size() == 12 ? 0 : 5;
}
