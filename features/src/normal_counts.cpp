// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/normal_counts.h>
#include <storey/filters/detail/instruction_sets.h>

#include <cmath>

namespace storey::detail {

STOREY_EACH_INSTRUCTION_SET
std::size_t countAcross(const VectorColumns& vectors, const double* u, double gate) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < vectors.size; ++i) {
    const double along = vectors.x[i] * u[0] + vectors.y[i] * u[1] + vectors.z[i] * u[2];
    count += std::abs(along) < gate ? 1 : 0;
  }
  return count;
}

}  // namespace storey::detail
