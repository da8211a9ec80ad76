// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Points per unit of wall area at each height: clouds get thinner away from the scanner.
class HeightDensity {
 public:
  /// In zones of equal height, the median over points of the zone of how dense their surroundings
  /// are: those in which a point has ten others of its wall.
  /// \param threads 0: all cores; the result is the same for any number
  HeightDensity(const std::vector<WallPoint>& points, const WallScale& scale,
                unsigned int threads = 0);

  double at(double z) const { return densities_[zoneOf(z)]; }  ///< there must be points
  double least() const;

 private:
  std::size_t zoneOf(double z) const;

  double low_ = 0.0;
  double step_ = 1.0;
  std::vector<double> densities_;
};

}  // namespace storey::detail
