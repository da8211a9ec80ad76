// SPDX-License-Identifier: BSD-3-Clause
#include "bench/summary.h"

#include <algorithm>
#include <cmath>

namespace storey::bench {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(q * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

bool isExact(const Outcome& outcome) {
  const Measures& m = outcome.measures;
  return m.has_model && m.polygons == m.true_polygons && m.corners == m.true_corners &&
         m.worst_corner <= kCornerReach * m.noise;
}

bool isExactWhereShown(const Outcome& outcome) {
  const Measures& m = outcome.measures;
  if (m.hidden_walls == 0 || isExact(outcome)) return isExact(outcome);
  return m.has_model && m.polygons <= m.true_polygons &&
         m.polygons + 2 * m.hidden_walls >= m.true_polygons && m.corners <= m.true_corners &&
         m.corners + 4 * m.hidden_walls >= m.true_corners &&
         m.worst_shown_corner <= kCornerReach * m.noise;
}

double errorRatio(const Outcome& outcome) {
  return outcome.measures.error / outcome.measures.error_limit;
}

Summary summarize(const std::vector<Outcome>& outcomes, double wanted_iou) {
  Summary s;
  std::vector<double> ious;
  std::vector<double> errors;
  std::vector<double> deviations;
  std::vector<double> ratios;
  std::vector<double> corner_ratios;
  std::vector<double> seconds;
  for (const Outcome& outcome : outcomes) {
    const Measures& m = outcome.measures;
    ++s.count;
    s.exact += isExact(outcome) ? 1 : 0;
    s.exact_where_shown += isExactWhereShown(outcome) ? 1 : 0;
    ious.push_back(m.has_model ? m.iou : 0.0);
    s.overlapping += ious.back() >= wanted_iou ? 1 : 0;
    seconds.push_back(m.seconds);
    if (!m.has_model) continue;
    ++s.models;
    s.valid += m.valid ? 1 : 0;
    errors.push_back(m.error);
    deviations.push_back(m.error_deviation);
    ratios.push_back(errorRatio(outcome));
    corner_ratios.push_back(m.corner / m.corner_limit);
  }
  s.iou_median = median(ious);
  s.iou_min = quantile(ious, 0.0);
  s.error_median = median(errors);
  s.error_deviation_median = median(deviations);
  s.ratio_median = median(ratios);
  s.ratio_90 = quantile(ratios, 0.9);
  s.ratio_max = quantile(ratios, 1.0);
  s.corner_ratio_median = median(corner_ratios);
  s.seconds_median = median(seconds);
  return s;
}

}  // namespace storey::bench
