// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/window_confidence.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

struct Sum {
  double score = 0.0;
  double seen = 0.0;   // texels
  double total = 0.0;  // texels on the raster

  double mean() const { return seen > 0.0 ? score / seen : 0.0; }
};

/// Sums within a rectangle, the raster's edge allowed for.
Sum sumOf(const WindowScores& scores, double left, double top, double right, double bottom) {
  const auto clamped = [](double value, Eigen::Index size) {
    return std::clamp<Eigen::Index>(std::lround(value), 0, size);
  };
  const Eigen::Index x = clamped(left, scores.cols());
  const Eigen::Index y = clamped(top, scores.rows());
  const auto area =
      scores.block(y, x, clamped(bottom, scores.rows()) - y, clamped(right, scores.cols()) - x);
  return {area.cast<double>().sum(), static_cast<double>((area != 0.0f).count()),
          static_cast<double>(area.size())};
}

}  // namespace

WindowEvidence evidenceOf(const WindowScores& scores, const Band& columns, const Band& rows) {
  constexpr double kBlur = 1.5;  // texels at the edges that are both
  const double around = 0.25 * std::min(columns.length(), rows.length());
  const auto grown = [&](double by) {
    return sumOf(scores, columns.begin - by, rows.begin - by, columns.end + by, rows.end + by);
  };
  const Sum window = grown(-kBlur);
  const Sum rim = grown(kBlur);
  const Sum all = grown(std::max(around, kBlur + 2.0));
  const double wall_seen = all.seen - rim.seen;
  const double wall = wall_seen > 0.0 ? (all.score - rim.score) / wall_seen : -1.0;
  WindowEvidence evidence;
  evidence.seen = window.total > 0.0 ? window.seen / window.total : 0.0;
  evidence.score = window.mean();
  evidence.confidence = window.seen > 0.0 ? 0.5 * (1.0 + window.mean()) * 0.5 * (1.0 - wall) : 0.0;
  return evidence;
}

}  // namespace storey::detail
