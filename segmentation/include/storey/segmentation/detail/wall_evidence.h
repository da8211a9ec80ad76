// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// What the points say of each edge of the plan at each height. All arrays are num_edges x
/// num_bins, edge by edge.
struct WallEvidence {
  double z_min = 0.0;
  double bin = 1.0;
  std::size_t num_bins = 0;
  std::vector<float> ahead;   ///< points whose normals agree with the line's
  std::vector<float> behind;  ///< points whose normals oppose it
  /// Signed area that they confirm, in [-area, area] of edge and bin: positive where the wall's
  /// outside is ahead of the line.
  std::vector<float> seen;
  /// Area just beyond an end of a wall, where it does not go on; empty: none. See `noteEnds`.
  std::vector<float> beyond;

  double heightOf(std::size_t boundary) const {
    return z_min + bin * static_cast<double>(boundary);
  }
};

/// Gives each point to the nearest line within 2.5 noise deviations whose direction its normal
/// confirms (within 60 degrees), there to its edge and bin; to a hypothetical line only where there
/// is no other: it would cut corners of walls that were found.
///
/// `seen` is counted in tiles of the edge, one bin high and as wide as six points need. A tile is
/// seen wholly if its points (those ahead less those behind: errors of orientation cancel) have
/// half the density of the walls at its height, and in proportion below that. So a dense patch does
/// not stand for a whole wall, and walls that are sampled more thinly than others count all the
/// same. \param saturated false: `seen` is the plain sum of the points over the density of all
/// \param threads 0: all cores; the result is the same for any number
WallEvidence gatherEvidence(const LineArrangement& plan, const std::vector<WallPoint>& points,
                            const WallScale& scale, bool saturated = true,
                            unsigned int threads = 0);

/// Boundaries (bins) of the layers: the optimal partition of the heights into ranges in which each
/// edge has a constant density, by dynamic programming. Poisson likelihood with change points that
/// all edges share; a change must gain more than the noise of all edges together would.
/// \return ascending, from 0 to num_bins
std::vector<std::size_t> findLevels(const WallEvidence& evidence);

}  // namespace storey::detail
