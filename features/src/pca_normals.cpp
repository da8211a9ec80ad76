// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/kdtree/kdtree_flann.h>
#include <storey/features/detail/thread_count.h>
#include <storey/features/pca_normals.h>
#include <storey/filters/cloud_scale.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kNeighborsPerNoise = 80.0;  // k = 80 density noise^2 is a radius of 5 noises
constexpr int kFewestNeighbors = 16;
constexpr int kMostNeighbors = 200;
constexpr double kLine = 1e-9;  // second variance over the first below which no plane is spanned

int derivedNeighbors(const std::vector<Eigen::Vector3f>& positions) {
  const CloudScale scale = estimateCloudScale(positions, kDefaultScaleSeed);
  const double k = kNeighborsPerNoise * scale.density * scale.noise * scale.noise;
  return static_cast<int>(std::lround(std::clamp<double>(k, kFewestNeighbors, kMostNeighbors)));
}

PcaNormal fitNormal(const pcl::PointCloud<pcl::PointXYZ>& cloud, const pcl::Indices& neighbors) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const pcl::index_t j : neighbors) {
    mean += cloud[static_cast<std::size_t>(j)].getVector3fMap().cast<double>();
  }
  mean /= static_cast<double>(neighbors.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const pcl::index_t j : neighbors) {
    const Eigen::Vector3d d =
        cloud[static_cast<std::size_t>(j)].getVector3fMap().cast<double>() - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d& l = solver.eigenvalues();  // ascending
  PcaNormal result;
  if (l[1] > kLine * l[2]) {
    result.normal = solver.eigenvectors().col(0).cast<float>();
    result.variation = static_cast<float>(std::max(l[0], 0.0) / l.sum());
  }
  return result;
}

}  // namespace

std::vector<PcaNormal> estimatePcaNormals(const std::vector<Eigen::Vector3f>& positions, int& k,
                                          unsigned int num_threads) {
  k = k > 0 ? k : derivedNeighbors(positions);
  const DistinctPositions distinct = findDistinctPositions(positions);
  std::vector<PcaNormal> result(positions.size());
  if (distinct.cloud->size() < 3) {
    return result;
  }
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(distinct.cloud);
  std::vector<PcaNormal> fitted(distinct.cloud->size());
#pragma omp parallel num_threads(threadCount(num_threads))
  {
    pcl::Indices neighbors;
    std::vector<float> squared;
#pragma omp for schedule(dynamic, 1024)
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(fitted.size()); ++i) {
      tree.nearestKSearch((*distinct.cloud)[static_cast<std::size_t>(i)], k, neighbors, squared);
      fitted[static_cast<std::size_t>(i)] = fitNormal(*distinct.cloud, neighbors);
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (distinct.id_of_input[i] >= 0) {
      result[i] = fitted[static_cast<std::size_t>(distinct.id_of_input[i])];
    }
  }
  return result;
}

}  // namespace storey::detail
