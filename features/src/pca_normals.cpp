// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/pca_normals.h>
#include <storey/filters/cloud_scale.h>
#include <storey/filters/detail/neighbor_search.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>

namespace storey::detail {
namespace {

constexpr double kNeighborsPerNoise = 80.0;  // k = 80 density noise^2 is a radius of 5 noises
constexpr int kFewestNeighbors = 16;
constexpr int kMostNeighbors = 200;
constexpr double kLine = 1e-9;  // second variance over the first below which no plane is spanned

int derivedNeighbors(const std::vector<Eigen::Vector3f>& positions, unsigned int num_threads) {
  const CloudScale scale = estimateCloudScale(positions, kDefaultScaleSeed, num_threads);
  const double k = kNeighborsPerNoise * scale.density * scale.noise * scale.noise;
  return static_cast<int>(std::lround(std::clamp<double>(k, kFewestNeighbors, kMostNeighbors)));
}

PcaNormal fitNormal(const MomentBatch& batch, std::size_t lane) {
  const auto moment = [&](std::size_t which) { return batch.moments[which][lane]; };
  const Eigen::Vector3d sum(moment(0), moment(1), moment(2));
  Eigen::Matrix3d covariance;
  covariance << moment(3), moment(4), moment(5), moment(4), moment(6), moment(7), moment(5),
      moment(7), moment(8);
  covariance -= sum * sum.transpose() / static_cast<double>(batch.count);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d& l = solver.eigenvalues();  // ascending
  PcaNormal result;
  if (l[1] > kLine * l[2]) {
    result.normal = solver.eigenvectors().col(0).cast<float>();
    result.variation = static_cast<float>(std::max(l[0], 0.0) / l.sum());
  }
  return result;
}

std::vector<PcaNormal> fitNormals(const NeighborSearch& search, int k, unsigned int num_threads) {
  std::vector<PcaNormal> fitted(search.size());
  const std::vector<char> all(fitted.size(), 1);
  search.forEachMoments(
      static_cast<std::size_t>(k), all, num_threads, [&](const MomentBatch& batch) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (batch.ids[lane] >= 0) {
            fitted[static_cast<std::size_t>(batch.ids[lane])] = fitNormal(batch, lane);
          }
        }
      });
  return fitted;
}

}  // namespace

std::vector<PcaNormal> estimatePcaNormals(const std::vector<Eigen::Vector3f>& positions, int& k,
                                          unsigned int num_threads) {
  k = k > 0 ? k : derivedNeighbors(positions, num_threads);
  DistinctPositions distinct = findDistinctPositions(positions, num_threads);
  std::vector<PcaNormal> result;
  if (distinct.cloud->size() < 3) {
    result.resize(positions.size());
    return result;
  }
  auto search = std::make_unique<NeighborSearch>(distinct.cloud);
  distinct.cloud.reset();  // the search has its own, and the memory is wanted
  const std::vector<PcaNormal> fitted = fitNormals(*search, k, num_threads);
  search.reset();
  result.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (distinct.id_of_input[i] >= 0) {
      result[i] = fitted[static_cast<std::size_t>(distinct.id_of_input[i])];
    }
  }
  return result;
}

}  // namespace storey::detail
