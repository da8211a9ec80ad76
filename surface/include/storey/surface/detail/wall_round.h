// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/wall_solving.h>

#include <cstddef>
#include <map>
#include <vector>

namespace storey::detail {

/// Distances of the points of a wall across it.
struct WallResiduals {
  ResidualHistogram histogram;
  std::size_t points = 0;

  WallResiduals& operator+=(const WallResiduals& other) {
    histogram += other.histogram;
    points += other.points;
    return *this;
  }
};

/// One more round of `fitWalls`, over points that come in parts: sums are all that is kept of them.
/// From lines that a part of the points was fitted to, one round leads to those of all: Tukey's
/// weights make it a step of Newton's method but for a tenth.
class WallRound {
 public:
  /// \param layers fitted to the sample \param sample tells which walls have panes
  WallRound(const std::vector<FloorplanLayer>& layers, const FitPoints& sample,
            const FitOptions& options);

  void add(const FitPoints& part);

  /// The lines by wall id; none without points.
  std::map<int, WallFit> solve();

 private:
  std::vector<FloorplanLayer> layers_;
  FitOptions options_;
  FittedWalls walls_;
  std::vector<WallResiduals> residuals_;
  std::vector<WallMoments> moments_;
};

}  // namespace storey::detail
