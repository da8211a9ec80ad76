// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// How much of what the cloud shows upright the model explains: points within 3 deviations of it.
struct Agreement {
  std::size_t upright = 0;   ///< planar points with |n.up| < 0.3
  double explained = 0.0;    ///< share of these
  std::size_t building = 0;  ///< those of them that are not of leaning or small surfaces, nor apart
  double explained_of_building = 0.0;  ///< share of these
};

/// Of at most 200,000 of the points, evenly drawn; the counts are of all.
Agreement agreementWith(const Result& result);

}  // namespace storey::reconstruct
