// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// How far the points of the cloud are from the surface of the model.
struct ResidualHistogram {
  std::size_t points = 0;           ///< measured
  double bin = 0.0;                 ///< a quarter of the noise
  std::vector<std::size_t> counts;  ///< bin k: from k to k + 1 bins, up to six times the noise
  std::size_t beyond = 0;           ///< points further off
};

/// Takes every k-th point, so that there are at most 50000: the shares of that many are good to a
/// quarter of a per cent.
ResidualHistogram measureResiduals(const Result& result);

}  // namespace storey::reconstruct
