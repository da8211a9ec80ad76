// SPDX-License-Identifier: BSD-3-Clause
// The paper's chain by hand, class by class (doc/tutorial.md explains it): planar points, dominant
// directions, and for each slice along gravity normals and a floorplan; then the model. The cloud
// is upright, its normals point outwards. (`LayerwiseFloorplanExtraction` does the middle part with
// all threads.)
#include <pcl/io/auto_io.h>
#include <pcl/io/vtk_io.h>
#include <pcl/point_types.h>
#include <storey/features/anisotropic_normal_estimation.h>
#include <storey/filters/gravity_slicing.h>
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/dominant_direction_clustering.h>
#include <storey/segmentation/slice_floorplan_extraction.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <cstdio>

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

int main(int argc, char** argv) {
  const auto cloud = pcl::make_shared<Cloud>();
  if (argc != 3 || pcl::io::load(argv[1], *cloud) != 0) {
    std::fprintf(stderr, "usage: five_classes CLOUD MODEL.vtk\n");
    return 2;
  }
  const auto planar = pcl::make_shared<Cloud>();
  storey::PlanarConfidenceFilter<Point> filter;
  filter.setInputCloud(cloud);
  filter.filter(*planar);

  storey::DominantDirectionClustering<Point> clustering;
  clustering.setInputCloud(planar);
  std::vector<pcl::PointIndices> clusters;
  clustering.extract(clusters);

  storey::GravitySlicing<Point> slicing;
  slicing.setInputCloud(planar);
  std::vector<pcl::PointIndices> slices;
  slicing.extract(slices);

  std::vector<storey::FloorplanLayer> layers;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const auto [z_min, z_max] = slicing.getSliceRanges()[i];
    const auto flat = pcl::make_shared<Cloud>();
    storey::projectSlice(*planar, slices[i], 0.5 * (z_min + z_max), *flat);
    const auto smooth = pcl::make_shared<Cloud>();
    storey::AnisotropicNormalEstimation<Point> normals;
    normals.setInputCloud(flat);
    normals.setInputNormals(flat);
    normals.setKSearch(30);
    normals.compute(*smooth);

    storey::SliceFloorplanExtraction<Point> extraction;
    extraction.setInputCloud(smooth);
    extraction.setDirections(clustering.getDirections());
    storey::FloorplanLayer layer{z_min, z_max, {}};
    extraction.extract(layer.plan);  // a slice without one stays empty
    layers.push_back(layer);
  }

  storey::LayerwiseMRFReconstruction<Point> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setFloorplans(layers);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  std::printf("%zu directions, %zu slices, %d floorplan types, %zu triangles\n", clusters.size(),
              slices.size(), reconstruction.getResult().dominant.num_types, mesh.polygons.size());
  return reconstruction.getResult().check.ok() ? pcl::io::saveVTKFile(argv[2], mesh) : 1;
}
