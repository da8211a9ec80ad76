// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/height_histogram.h>
#include <storey/surface/floorplan_fitting.h>

#include <array>
#include <vector>

namespace storey::detail {

/// What the points between `low` and `high` tell of one level.
struct LevelEvidence {
  LevelEvidence(double level, double from, double to, double noise);

  double guess;
  double low;
  double high;
  /// Points of walls that end at the level, and of those that start there; [1]: of walls with one
  /// of the other layer so close beside that points of both mix.
  std::array<HeightHistogram, 2> ends;
  std::array<HeightHistogram, 2> starts;
  HeightHistogram caps;  ///< points of the level faces: roofs, grounds, ceilings

  LevelEvidence& operator+=(const LevelEvidence& other);  ///< the points of the same level
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
