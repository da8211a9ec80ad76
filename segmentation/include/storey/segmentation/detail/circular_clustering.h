// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace storey::detail {

/// A cluster of horizontal directions: angles in radians, counter-clockwise from +x, in [-pi, pi).
struct AngleCluster {
  double center;
  double weight;
};

/// The angle in [-pi, pi) that differs from `angle` by whole turns.
double wrapAngle(double angle);

/// How many directions there are at each angle of the circle. A bin remembers the mean of its
/// angles, so that nothing but their order within the bin is lost.
class AngleHistogram {
 public:
  static constexpr std::size_t kNumBins = 3600;  // 0.1 degree: far below any noise of normals
  static constexpr double kBinWidth = 2.0 * 3.14159265358979323846 / kNumBins;

  AngleHistogram() : counts_(kNumBins, 0), offsets_(kNumBins, 0.0) {}

  /// \param angle radians, within a few turns
  void add(double angle);

  std::size_t total() const { return total_; }
  const std::vector<std::size_t>& counts() const { return counts_; }

  /// One cluster for each occupied bin, centres ascending.
  std::vector<AngleCluster> clusters() const;

 private:
  std::vector<std::size_t> counts_;
  std::vector<double> offsets_;  // sum of (angle - middle of the bin)
  std::size_t total_ = 0;
};

/// Merges the two closest clusters, at the weighted mean of their centres, until the closest two
/// are further apart than `merge_angle` [Sui et al. 2016, Sec. 3.1]. The closest two on a circle
/// are neighbours, so this takes O(m log m). Of several closest pairs the first in the order of the
/// input merges first. Returns the clusters by ascending centre.
/// \param clusters by ascending centre
/// \param merge_angle radians within (0, pi)
std::vector<AngleCluster> mergeOnCircle(const std::vector<AngleCluster>& clusters,
                                        double merge_angle);

/// Standard deviation, in radians, of the directions of one wall: from the width of the highest
/// mode of the histogram at a tenth of its height, so that other walls do not count. (Noise in a
/// random direction on the sphere has a sharp peak and wide tails on the circle: at half height it
/// would look too narrow.) 0 if there is nothing.
double modeSpread(const AngleHistogram& histogram);

/// The merge angle, in radians, for walls whose normals have this standard deviation: 4 of them,
/// within [5, 25] degrees.
double mergeAngleFor(double spread);

/// Robust mean direction of the bins around each centre: Tukey's biweight, scaled by the median
/// deviation. It looks at most 30 degrees, and half the way to the next centre, to both sides.
std::vector<double> refineCenters(const std::vector<AngleCluster>& bins,
                                  const std::vector<AngleCluster>& centers);

}  // namespace storey::detail
