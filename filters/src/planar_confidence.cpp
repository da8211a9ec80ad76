// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/kdtree/kdtree_flann.h>
#include <storey/filters/detail/planar_confidence.h>
#include <storey/filters/detail/threads.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace storey::detail {
namespace {

constexpr double kFalloff = 0.02;         // [Sui et al. 2016, Sec. 3.1]
constexpr std::size_t kMinPositions = 4;  // three always lie on a plane

// Relative to the first neighbour: products of raw coordinates would lose the digits that count.
Eigen::Vector3d eigenvaluesOf(const pcl::PointCloud<pcl::PointXYZ>& positions,
                              const pcl::Indices& neighbors) {
  const auto at = [&positions](pcl::index_t i) -> Eigen::Vector3d {
    return positions[static_cast<std::size_t>(i)].getVector3fMap().cast<double>();
  };
  const Eigen::Vector3d origin = at(neighbors[0]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const pcl::index_t j : neighbors) {
    const Eigen::Vector3d d = at(j) - origin;
    sum += d;
    products += d * d.transpose();
  }
  const auto k = static_cast<double>(neighbors.size());
  const Eigen::Matrix3d covariance = products / k - (sum / k) * (sum / k).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace

double planarConfidence(const Eigen::Vector3d& eigenvalues) {
  const Eigen::Vector3d l = eigenvalues.cwiseMax(0.0);  // rounding may leave -1e-20
  if (l.minCoeff() > 0.0) {
    return 1.0 - std::exp(-kFalloff * l.sum() / l.minCoeff());
  }
  return l.maxCoeff() > 0.0 ? 1.0 : 0.0;
}

NeighborQuery makeNeighborQuery(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& positions) {
  auto tree = std::make_shared<pcl::KdTreeFLANN<pcl::PointXYZ>>(false);  // order is of no use
  if (!positions->empty()) {
    tree->setInputCloud(positions);
  }
  return [tree, positions](pcl::index_t id, int k, pcl::Indices& neighbors) {
    thread_local std::vector<float> squared_distances;
    tree->nearestKSearch((*positions)[static_cast<std::size_t>(id)], static_cast<unsigned>(k),
                         neighbors, squared_distances);
  };
}

std::vector<double> planarConfidences(const pcl::PointCloud<pcl::PointXYZ>& positions,
                                      const std::vector<char>& wanted, int k,
                                      const NeighborQuery& query, unsigned int threads) {
  std::vector<double> confidences(positions.size(), 0.0);
  const int k_found = static_cast<int>(std::min(positions.size(), static_cast<std::size_t>(k)));
  const auto n = static_cast<std::ptrdiff_t>(positions.size());
#pragma omp parallel num_threads(threadsFor(threads))
  {
    pcl::Indices neighbors;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      if (wanted[static_cast<std::size_t>(i)]) {
        query(static_cast<pcl::index_t>(i), k_found, neighbors);
        // Points with the same neighbours get the same bytes, whatever the search's order.
        std::sort(neighbors.begin(), neighbors.end());
        if (neighbors.size() >= kMinPositions) {
          confidences[static_cast<std::size_t>(i)] =
              planarConfidence(eigenvaluesOf(positions, neighbors));
        }
      }
    }
  }
  return confidences;
}

}  // namespace storey::detail
