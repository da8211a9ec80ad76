// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bench/experiment.h"

namespace storey::bench {

/// Largest distance of a true corner to the nearest model vertex in an exact model, in standard
/// deviations of the noise: far above what fitting leaves, far below any part of a building.
constexpr double kCornerReach = 5.0;

/// The smallest value that at least a share `q` of the values does not exceed (nearest rank);
/// 0 of none.
double quantile(std::vector<double> values, double q);

/// The middle value, or the mean of the two middle ones; 0 of none.
double median(std::vector<double> values);

/// As many polygons and corners as the truth, and every true corner near a vertex of the model.
bool isExact(const Outcome& outcome);

/// Exact, but for what no point shows: every true corner at which two walls with points meet is
/// near a vertex of the model, and of polygons and corners none are too many and no more are
/// missing than hidden walls can have hidden, two polygons (with a roof) and four corners each. The
/// same as `isExact` where no wall is hidden.
bool isExactWhereShown(const Outcome& outcome);

/// The paper's error over its statistical limit.
double errorRatio(const Outcome& outcome);

/// Many outcomes in a few numbers. A failure is neither valid nor exact and has IoU 0; ratios are
/// over those that have a model.
struct Summary {
  std::size_t count = 0;
  std::size_t models = 0;
  std::size_t valid = 0;
  std::size_t exact = 0;
  std::size_t exact_where_shown = 0;
  std::size_t overlapping = 0;  ///< with at least the wanted IoU
  double iou_median = 0.0;
  double iou_min = 0.0;
  double error_median = 0.0;
  double error_deviation_median = 0.0;
  double ratio_median = 0.0;
  double ratio_90 = 0.0;  ///< 90 % quantile
  double ratio_max = 0.0;
  double corner_ratio_median = 0.0;  ///< mean displacement of the true corners over its limit
  double seconds_median = 0.0;
};

Summary summarize(const std::vector<Outcome>& outcomes, double wanted_iou);

}  // namespace storey::bench
