// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/distance_kernels.h>

#include <array>

namespace storey::detail {

/// Surface variation l3 / (l1 + l2 + l3) of the positions whose moments each lane holds, with
/// l1 >= l2 >= l3 the eigenvalues of their covariance; 0 for a perfect plane, -1 for coincident
/// positions. \param count positions of each lane
void surfaceVariations(const MomentLanes& moments, double count,
                       std::array<double, kLanes>& variations);

}  // namespace storey::detail
