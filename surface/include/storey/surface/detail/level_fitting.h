// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/height_scan.h>
#include <storey/surface/detail/level_evidence.h>

#include <vector>

namespace storey::detail {

/// The height of a level by maximum likelihood, at most `max_shift` from its guess.
///
/// Heights of points of a wall that ends at z are a Poisson process of intensity
///     lambda exp(g (z_i - z)) ((1 - q) S((z - z_i) / sigma) + q),
/// with S the step of a normal distribution, of which a share `tails` errs five times as much, q
/// that of strays (points of close neighbours that go on), and g the change of density with height,
/// where it is clear, of each of the four lists; those of a level face are N(z, sigma), but for a
/// tenth that lie anywhere. lambda, q and g are profiled out, and all is relative to "nothing ends
/// here": uniform over the window. A level whose likelihood is not clearly more than that (by a
/// factor of e^10) stays at its guess with an infinite deviation; one at the end of where it is
/// sought may lie beyond, and its deviation is the length of the search.
class LevelFitting {
 public:
  /// \param level of which there must be one as long as this \param threads 0: all cores
  LevelFitting(const LevelEvidence& level, double noise, double max_shift,
               unsigned int threads = 1);

  HeightFit fit(double tails) const;

 private:
  const LevelEvidence& level_;
  double noise_;
  HeightScan scan_;
  std::vector<double> cap_values_;  // of the scan; none if level faces tell nothing
};

/// `fitHeights` from what the points tell of the levels of these layers.
std::vector<HeightFit> fitHeights(std::vector<FloorplanLayer>& layers,
                                  const std::vector<LevelEvidence>& evidence,
                                  const FitOptions& options);

}  // namespace storey::detail
