// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace storey::detail {

/// Optimal assignment: the permutation p of 0..n-1 that minimises sum_i cost[i * n + p(i)]
/// (Hungarian method with potentials, O(n^3)).
/// \param cost n x n, row-major, finite
/// \return n columns, one a row; ties go to the lower column
std::vector<int> solveAssignment(const std::vector<double>& cost, int n);

}  // namespace storey::detail
