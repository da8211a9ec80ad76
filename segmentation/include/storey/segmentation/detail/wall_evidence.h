// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Signed counts of points: for each edge of the plan and each bin of height, the points whose
/// normals agree with the line's and those that oppose it.
struct WallEvidence {
  double z_min = 0.0;
  double bin = 1.0;
  std::size_t num_bins = 0;
  std::vector<float> ahead;   ///< num_edges x num_bins: normal along the line's
  std::vector<float> behind;  ///< against it

  double heightOf(std::size_t boundary) const {
    return z_min + bin * static_cast<double>(boundary);
  }
};

/// Gives each point to the nearest line within 2.5 noise deviations whose direction its normal
/// confirms (within 60 degrees), there to its edge and bin.
WallEvidence gatherEvidence(const LineArrangement& plan, const std::vector<WallPoint>& points,
                            const WallScale& scale);

/// Boundaries (bins) of the layers: the optimal partition of the heights into ranges in which each
/// edge has a constant density, by dynamic programming. Poisson likelihood with change points that
/// all edges share; a change must gain more than the noise of all edges together would.
/// \return ascending, from 0 to num_bins
std::vector<std::size_t> findLevels(const WallEvidence& evidence);

}  // namespace storey::detail
