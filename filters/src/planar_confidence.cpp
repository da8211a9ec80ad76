// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/planar_confidence.h>
#include <storey/filters/detail/surface_variation.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr double kFalloff = 0.02;  // [Sui et al. 2016, Sec. 3.1]
constexpr std::size_t kMinPositions = 4;

Neighborhood neighborhoodOf(const pcl::PointCloud<pcl::PointXYZ>& positions,
                            const pcl::Indices& ids, std::array<std::vector<float>, 3>& xyz) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    xyz[axis].clear();
    for (const pcl::index_t id : ids) {
      xyz[axis].push_back(positions[static_cast<std::size_t>(id)].data[axis]);
    }
  }
  return {0, {}, ids.size(), ids.data(), xyz[0].data(), xyz[1].data(), xyz[2].data()};
}

}  // namespace

std::array<double, kLanes> planarConfidences(const MomentBatch& batch) {
  std::array<double, kLanes> confidences{};
  if (batch.count < kMinPositions) {
    return confidences;
  }
  surfaceVariations(batch.moments, static_cast<double>(batch.count), confidences);
  for (double& value : confidences) {
    const double variation = value;
    value = variation > 0.0 ? 1.0 - std::exp(-kFalloff / variation) : variation < 0.0 ? 0.0 : 1.0;
  }
  return confidences;
}

std::vector<double> planarConfidences(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& positions,
                                      const std::vector<char>& wanted, int k,
                                      const NeighborQuery& query, unsigned int threads) {
  std::vector<double> confidences(positions->size(), 0.0);
  if (!query) {
    NeighborSearch(positions).forEachMoments(
        static_cast<std::size_t>(k), wanted, threads, [&](const MomentBatch& batch) {
          const std::array<double, kLanes> of_batch = planarConfidences(batch);
          for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (batch.ids[lane] >= 0) {
              confidences[static_cast<std::size_t>(batch.ids[lane])] = of_batch[lane];
            }
          }
        });
    return confidences;
  }
  const int k_found = static_cast<int>(std::min(positions->size(), static_cast<std::size_t>(k)));
  const auto n = static_cast<std::ptrdiff_t>(positions->size());
#pragma omp parallel num_threads(threadsFor(threads))
  {
    pcl::Indices neighbors;
    std::array<std::vector<float>, 3> xyz;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      if (wanted[static_cast<std::size_t>(i)]) {
        query(static_cast<pcl::index_t>(i), k_found, neighbors);
        std::sort(neighbors.begin(), neighbors.end());  // whatever the search's order
        const pcl::PointXYZ& origin = (*positions)[static_cast<std::size_t>(k_found < n ? i : 0)];
        confidences[static_cast<std::size_t>(i)] = planarConfidences(momentsOf(
            neighborhoodOf(*positions, neighbors, xyz), {origin.x, origin.y, origin.z}))[0];
      }
    }
  }
  return confidences;
}

}  // namespace storey::detail
