// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <array>
#include <vector>

namespace storey::detail {

/// What the points tell of one level: heights, each list ascending. Those of walls are of points
/// between `low` and `high`, the window that the density of the points is taken from.
struct LevelEvidence {
  double guess = 0.0;
  double low = 0.0;
  double high = 0.0;
  /// Points of walls that end at the level, and of those that start there; [1]: of walls with one
  /// of the other layer so close beside that points of both mix.
  std::array<std::vector<double>, 2> ends;
  std::array<std::vector<double>, 2> starts;
  std::vector<double> caps;  ///< points of the level faces: roofs, grounds, ceilings

  std::array<std::vector<double>*, 5> lists() {
    return {&ends[0], &ends[1], &starts[0], &starts[1], &caps};
  }
  std::array<const std::vector<double>*, 5> lists() const {
    return {&ends[0], &ends[1], &starts[0], &starts[1], &caps};
  }
  LevelEvidence& operator+=(
      const LevelEvidence& other);  ///< the points of the same level, unsorted
};

/// The evidence of all levels in one pass over the points: level k is the foot of layer k, the last
/// one the top.
std::vector<LevelEvidence> collectLevelEvidence(const std::vector<FloorplanLayer>& layers,
                                                const FitPoints& points, const FitOptions& options);

/// The share of points with heavy tails, five times the noise: from what lies 3 to 15 deviations
/// beyond the levels, less the strays, which go on further. 0 if there is not clearly more.
double tailsOf(const std::vector<LevelEvidence>& levels, const std::vector<HeightFit>& fits,
               double noise);

}  // namespace storey::detail
