// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/peers.h"

#include <pcl/common/io.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/surface/concave_hull.h>
#include <pcl/surface/poisson.h>
#include <storey/features/pca_normals.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/planar_confidence_filter.h>

#include <algorithm>
#include <cmath>

namespace storey::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

constexpr int kNeighbors = 30;
constexpr int kSlices = 40;

void planarConfidence(const Cloud::ConstPtr& cloud) {
  PlanarConfidenceFilter<pcl::PointNormal> filter;
  filter.setInputCloud(cloud);
  filter.setKSearch(kNeighbors);
  filter.setNumberOfThreads(1);
  pcl::Indices kept;
  filter.filter(kept);
}

void normals(const Cloud::ConstPtr& cloud) {
  Cloud copy = *cloud;
  estimateNormals(copy, kNeighbors, 1);
}

void pclNormals(const Cloud::ConstPtr& cloud) {
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(kNeighbors);
  estimation.setNumberOfThreads(1);
  pcl::PointCloud<pcl::Normal> output;
  estimation.compute(output);
}

// PCL has it compiled for normals that lie apart only.
void pclRegionGrowing(const Cloud::ConstPtr& cloud) {
  auto positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto normals_alone = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::copyPointCloud(*cloud, *positions);
  pcl::copyPointCloud(*cloud, *normals_alone);
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(positions);
  growing.setInputNormals(normals_alone);
  growing.setNumberOfNeighbours(kNeighbors);
  std::vector<pcl::PointIndices> regions;
  growing.extract(regions);
}

// The outline of each of some slices, laid into a plane.
void pclConcaveHulls(const Cloud::ConstPtr& cloud) {
  const auto [low, high] = std::minmax_element(
      cloud->begin(), cloud->end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const float bottom = low->z;
  const float height = std::max(high->z - bottom, 1e-6f) / kSlices;
  std::vector<pcl::PointCloud<pcl::PointXYZ>::Ptr> slices(kSlices);
  for (auto& slice : slices) slice = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const pcl::PointNormal& p : *cloud) {
    const int slice = std::min(kSlices - 1, static_cast<int>((p.z - bottom) / height));
    slices[static_cast<std::size_t>(slice)]->push_back({p.x, p.y, 0.0f});
  }
  for (const auto& slice : slices) {
    if (slice->size() < 4) continue;
    pcl::ConcaveHull<pcl::PointXYZ> hull;
    hull.setInputCloud(slice);
    hull.setDimension(2);
    hull.setAlpha(height);
    pcl::PointCloud<pcl::PointXYZ> outline;
    hull.reconstruct(outline);
  }
}

void pclPoisson(const Cloud::ConstPtr& cloud) {
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(cloud);
  poisson.setDepth(8);
  pcl::PolygonMesh mesh;
  poisson.reconstruct(mesh);
}

}  // namespace

std::vector<Peer> peers() {
  return {
      {"storey::PlanarConfidenceFilter, K = 30", planarConfidence},
      {"pcl::NormalEstimationOMP, K = 30", pclNormals},
      {"storey::estimateNormals, K = 30", normals},
      {"pcl::RegionGrowing, K = 30", pclRegionGrowing},
      {"pcl::ConcaveHull of 40 slices", pclConcaveHulls},
      {"pcl::Poisson, depth 8", pclPoisson},
#ifdef STOREY_BENCH_CGAL
      {"CGAL::Polygonal_surface_reconstruction, GLPK", cgalPolygonalSurface, true, true},
#endif
  };
}

std::string missingPeers() {
#ifdef STOREY_BENCH_CGAL
  return "";
#else
  return "CGAL 5.5 with GLPK is not installed: left out.";
#endif
}

}  // namespace storey::bench
