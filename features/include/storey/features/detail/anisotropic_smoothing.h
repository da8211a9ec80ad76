// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace storey::detail {

/// exp(-x) for x >= 0, 0 from x = 87.7 on. Relative error below 1e-6 up to x = 4 and below 1e-5
/// beyond, where x itself is rounded more coarsely. Plain float arithmetic without a branch: the
/// compiler makes it four at a time, and the bytes are the same everywhere.
inline float fastExpOfMinus(float x) {
  // 2^y = 2^i 2^f with |f| <= 1/2; adding and taking away kRound leaves the nearest integer.
  constexpr float kLog2E = 1.44269504f;
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23
  constexpr float kLargest = 88.0f;      // i = -127: the bits of 0
  const float y = -(x < kLargest ? x : kLargest) * kLog2E;
  const float i = (y + kRound) - kRound;
  const float f = y - i;
  // Taylor series of 2^f; the first term left out is below 1.2e-7.
  float p = 1.5403530e-4f;
  p = p * f + 1.3333558e-3f;
  p = p * f + 9.6181291e-3f;
  p = p * f + 5.5504109e-2f;
  p = p * f + 2.4022651e-1f;
  p = p * f + 6.9314718e-1f;
  p = p * f + 1.0f;
  const std::int32_t bits = (static_cast<std::int32_t>(i) + 127) << 23;
  float power = 0.0f;
  std::memcpy(&power, &bits, sizeof power);
  return p * power;
}

/// The neighbours N_i of many points in one flat list; copies of a position share a row.
struct Neighborhoods {
  std::vector<std::uint32_t> row_of_point;    ///< kNoRow for a point that cannot be searched
  std::vector<std::uint32_t> representative;  ///< per row: the point it was searched for
  std::vector<std::size_t> first;             ///< rows + 1 offsets into the lists below
  std::vector<std::uint32_t> neighbor;        ///< points, without the representative itself
  std::vector<float> distance;                ///< parallel to `neighbor`

  static constexpr std::uint32_t kNoRow = 0xffffffffu;
  std::size_t numRows() const { return representative.size(); }
};

/// The parameters of (1)-(3).
struct SmoothingParameters {
  double sigma_p = 0.0;  ///< length, > 0; 0: phi = 1 everywhere
  double sigma_n = 0.0;  ///< rad
  double alpha = 0.0;    ///< weight of the prior normal
  int iterations = 0;    ///< 0: until the normals rest
  int num_threads = 1;
};

/// Unit normals padded to four floats (the last is 0), so that one fits a register. An all-zero
/// normal marks a point without one: it has no influence and gets none.
using PaddedNormals = std::vector<Eigen::Vector4f>;

/// Median over all rows of the distance to the farthest neighbour; 0 without neighbours.
double medianReach(const Neighborhoods& neighborhoods);

/// Iterates (3) from the priors and returns the normals, zero where the prior is zero.
/// \param[out] iterations how many were done
PaddedNormals smoothNormals(const PaddedNormals& priors, const Neighborhoods& neighborhoods,
                            const SmoothingParameters& parameters, int* iterations);

/// One update (3) of a normal. \param neighbors, distances of its neighbours, \param normals theirs
Eigen::Vector4f updatedNormal(const Eigen::Vector4f& normal, const Eigen::Vector4f& prior,
                              const std::vector<std::uint32_t>& neighbors,
                              const std::vector<float>& distances, const PaddedNormals& normals,
                              const SmoothingParameters& parameters);

}  // namespace storey::detail
