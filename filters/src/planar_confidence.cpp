// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/neighbor_search.h>
#include <storey/filters/detail/planar_confidence.h>
#include <storey/filters/detail/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr double kFalloff = 0.02;  // [Sui et al. 2016, Sec. 3.1]
constexpr double kMinPositions = 4.0;
constexpr int kLaguerreRounds = 10;  // three or four are enough
constexpr double kSettled = 1e-6;    // relative: the next step, a third power, would be rounding

// The smallest root of the characteristic polynomial x^3 - x^2 + minors x - determinant of a
// covariance with trace 1. All roots are real, so Laguerre's method goes up to it from 0 without
// passing it, even where roots coincide.
double smallestEigenvalue(double minors, double determinant) {
  double x = 0.0;
  for (int round = 0; round < kLaguerreRounds; ++round) {
    const double p = ((x - 1.0) * x + minors) * x - determinant;
    const double slope = (3.0 * x - 2.0) * x + minors;
    const double curvature = 6.0 * x - 2.0;
    const double root = std::sqrt(std::max(4.0 * slope * slope - 6.0 * p * curvature, 0.0));
    if (!(p < 0.0) || !(slope + root > 0.0)) {
      break;
    }
    const double step = -3.0 * p / (slope + root);
    x += step;
    if (step <= kSettled * x) {
      break;
    }
  }
  return x;
}

Moments momentsOf(const pcl::PointCloud<pcl::PointXYZ>& positions, const pcl::Indices& neighbors) {
  if (neighbors.empty()) {
    return {};
  }
  const pcl::PointXYZ& p = positions[static_cast<std::size_t>(neighbors[0])];
  const std::size_t padded = (neighbors.size() + kLanes - 1) / kLanes * kLanes;
  std::vector<float> x(padded, p.x), y(padded, p.y), z(padded, p.z);
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const pcl::PointXYZ& q = positions[static_cast<std::size_t>(neighbors[i])];
    x[i] = q.x;
    y[i] = q.y;
    z[i] = q.z;
  }
  return momentsAbout(x.data(), y.data(), z.data(), padded, p.data, neighbors.size());
}

}  // namespace

double planarConfidence(const Moments& moments) {
  if (moments.count < kMinPositions) {
    return 0.0;
  }
  const double share = 1.0 / moments.count;
  const auto& s = moments.sum;
  const auto& p = moments.products;
  double xx = p[0] - s[0] * s[0] * share;
  double yy = p[3] - s[1] * s[1] * share;
  double zz = p[5] - s[2] * s[2] * share;
  const double trace = xx + yy + zz;
  if (!(trace > 0.0)) {
    return 0.0;
  }
  const double unit = 1.0 / trace;
  xx *= unit;
  yy *= unit;
  zz *= unit;
  const double xy = (p[1] - s[0] * s[1] * share) * unit;
  const double xz = (p[2] - s[0] * s[2] * share) * unit;
  const double yz = (p[4] - s[1] * s[2] * share) * unit;
  const double minor = yy * zz - yz * yz;
  const double minors = minor + xx * yy - xy * xy + xx * zz - xz * xz;
  const double determinant = xx * minor - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const double least = smallestEigenvalue(minors, determinant);
  return least > 0.0 ? 1.0 - std::exp(-kFalloff / least) : 1.0;
}

std::vector<double> planarConfidences(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& positions,
                                      const std::vector<char>& wanted, int k,
                                      const NeighborQuery& query, unsigned int threads) {
  std::vector<double> confidences(positions->size(), 0.0);
  if (!query) {
    NeighborSearch(positions).forEach(
        static_cast<std::size_t>(k), wanted, threads, [&](const Neighborhood& found) {
          confidences[static_cast<std::size_t>(found.id)] = planarConfidence(found.moments());
        });
    return confidences;
  }
  const int k_found = static_cast<int>(std::min(positions->size(), static_cast<std::size_t>(k)));
  const auto n = static_cast<std::ptrdiff_t>(positions->size());
#pragma omp parallel num_threads(threadsFor(threads))
  {
    pcl::Indices neighbors;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      if (wanted[static_cast<std::size_t>(i)]) {
        query(static_cast<pcl::index_t>(i), k_found, neighbors);
        std::sort(neighbors.begin(), neighbors.end());  // whatever the search's order
        confidences[static_cast<std::size_t>(i)] =
            planarConfidence(momentsOf(*positions, neighbors));
      }
    }
  }
  return confidences;
}

}  // namespace storey::detail
