// SPDX-License-Identifier: BSD-3-Clause
#include "stages/planar.h"

#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/dominant_direction_clustering.h>

namespace storey::stages {

std::string measureConfidence(StageCloud& cloud, double kept_share, unsigned int threads) {
  PlanarConfidenceFilter<Point> filter;
  filter.setInputCloud(cloud.points);
  filter.setKeptShare(kept_share);
  filter.setNumberOfThreads(threads);
  pcl::Indices kept;
  filter.filter(kept);
  // Floats, as in the file: which points are planar must not depend on whether they went through
  // one.
  cloud.state.planar_threshold = static_cast<float>(filter.getThreshold());
  cloud.confidences.clear();
  for (const double confidence : filter.getConfidences()) {
    cloud.confidences.push_back(static_cast<float>(confidence));
  }
  return format("T_k = %.3f, %zu points kept", static_cast<double>(cloud.state.planar_threshold),
                planarPoints(cloud).size());
}

std::string findDirections(StageCloud& cloud, unsigned int threads) {
  requireNormals(cloud);
  DominantDirectionClustering<Point> clustering;
  clustering.setInputCloud(cloud.points);
  clustering.setIndices(pcl::make_shared<pcl::Indices>(planarPoints(cloud)));
  clustering.setNumberOfThreads(threads);
  std::vector<pcl::PointIndices> clusters;
  clustering.extract(clusters);
  cloud.state.directions = clustering.getDirections();
  if (cloud.state.directions.empty()) {
    refuse(cloud, "no dominant wall direction found", "is the cloud a building with planar walls?");
  }
  std::vector<int>& direction_of = cloud.groups(Direction);
  direction_of.assign(cloud.points->size(), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const pcl::index_t i : clusters[c].indices) {
      direction_of[static_cast<std::size_t>(i)] = static_cast<int>(c);
    }
  }
  return format("%zu dominant directions", cloud.state.directions.size());
}

}  // namespace storey::stages
