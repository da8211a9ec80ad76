// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace storey::detail {

/// Vectors by their coordinates.
struct VectorColumns {
  const double* x;
  const double* y;
  const double* z;
  std::size_t size;
};

/// How many of the vectors n have |n.u| < gate.
std::size_t countAcross(const VectorColumns& vectors, const double* u, double gate);

}  // namespace storey::detail
