// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// Positions with unit normals; both vectors are parallel, all entries finite and searchable.
struct OrientedPositions {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
};

struct RefinementParameters {
  int k = 0;             // nearest neighbours; 0: all within `radius`
  double radius = 0.0;   // length
  double sigma_p = 0.0;  // length > 0
  double sigma_n = 0.0;  // rad
  double beta = 0.0;
  int iterations = 0;
  unsigned int threads = 0;  // 0: all cores
};

/// Of more neighbours within a radius the nearest are taken: bounds memory and time.
constexpr int kMaxRadiusNeighbors = 256;

/// 5 deviations of the noise along the normals, at least 2 spacings; 0 for fewer than 2 positions.
/// The noise is the median of |n_i.(x_j - x_i)| over 300 neighbourhoods, divided by
/// 0.6745 sqrt(2): both ends scatter. It works on flattened slices too, where no covariance would
/// tell a wall's noise from its neighbours' directions.
double deriveSigmaP(const OrientedPositions& points);

/// Regions from this size on are worth several threads; of smaller ones several are done at once.
constexpr std::size_t kLargeRegion = 50000;

/// The displacements t_i that `iterations` steps of (8) [Sui et al. 2016] lead to from t = 0, all
/// points being one edge region. Parallel to the positions.
std::vector<double> refineAlongNormals(const OrientedPositions& points,
                                       const RefinementParameters& parameters);

}  // namespace storey::detail
