// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kGate = 2.5;          // noise deviations
constexpr double kMinAgreement = 0.5;  // cosine of 60 degrees
constexpr double kBin = 3.0;           // noise deviations
constexpr double kMaxBins = 300.0;     // the partition is quadratic in them
constexpr double kMinPoints = 20.0;    // of an edge that takes part in the levels

// n ln(n / length), the Poisson log-likelihood of n points at their own mean density.
double logLikelihood(double n, double length) { return n > 0.0 ? n * std::log(n / length) : 0.0; }

}  // namespace

WallEvidence gatherEvidence(const LineArrangement& plan, const std::vector<WallPoint>& points,
                            const WallScale& scale) {
  WallEvidence evidence;
  if (points.empty() || plan.edges.empty()) return evidence;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const WallPoint& p : points) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  evidence.z_min = low;
  evidence.bin = std::max(kBin * scale.noise, (high - low) / kMaxBins);
  evidence.num_bins = static_cast<std::size_t>((high - low) / evidence.bin) + 1;
  evidence.ahead.assign(plan.edges.size() * evidence.num_bins, 0.0f);
  evidence.behind.assign(plan.edges.size() * evidence.num_bins, 0.0f);

  std::vector<std::size_t> first_edge(plan.lines.size() + 1, 0);  // edges are sorted by line
  for (const PlanEdge& edge : plan.edges) ++first_edge[static_cast<std::size_t>(edge.line) + 1];
  for (std::size_t l = 0; l < plan.lines.size(); ++l) first_edge[l + 1] += first_edge[l];

  for (const WallPoint& p : points) {
    double nearest = kGate * scale.noise;
    std::size_t line = plan.lines.size();
    for (std::size_t l = 0; l < plan.lines.size(); ++l) {
      const double d = std::abs(plan.lines[l].across(p.position));
      if (d < nearest && std::abs(plan.lines[l].normal.dot(p.normal)) > kMinAgreement) {
        nearest = d;
        line = l;
      }
    }
    if (line == plan.lines.size()) continue;
    const double s = plan.lines[line].tangent().dot(p.position);
    const auto begin = plan.edges.begin() + static_cast<std::ptrdiff_t>(first_edge[line]);
    const auto end = plan.edges.begin() + static_cast<std::ptrdiff_t>(first_edge[line + 1]);
    const auto edge = std::lower_bound(
        begin, end, s, [](const PlanEdge& e, double value) { return e.s_max < value; });
    if (edge == end || s < edge->s_min) continue;
    const auto bin =
        std::min(evidence.num_bins - 1, static_cast<std::size_t>((p.z - low) / evidence.bin));
    const std::size_t slot =
        static_cast<std::size_t>(edge - plan.edges.begin()) * evidence.num_bins + bin;
    (plan.lines[line].normal.dot(p.normal) > 0.0 ? evidence.ahead : evidence.behind)[slot] += 1.0f;
  }
  return evidence;
}

std::vector<std::size_t> findLevels(const WallEvidence& evidence) {
  const std::size_t bins = evidence.num_bins;
  if (bins == 0) return {};
  // Running sums over the bins, of the edges that have enough points.
  std::vector<std::vector<double>> sums;
  for (std::size_t slot = 0; slot < evidence.ahead.size(); slot += bins) {
    std::vector<double> sum(bins + 1, 0.0);
    for (std::size_t b = 0; b < bins; ++b) {
      sum[b + 1] = sum[b] + evidence.ahead[slot + b] + evidence.behind[slot + b];
    }
    if (sum.back() >= kMinPoints) sums.push_back(std::move(sum));
  }
  const auto edges = static_cast<double>(sums.size());
  const double penalty =
      0.5 * edges + 3.0 * std::sqrt(0.5 * edges) + 2.0 * std::log(static_cast<double>(bins) + 1.0);
  std::vector<double> best(bins + 1, -std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(bins + 1, 0);
  best[0] = 0.0;
  for (std::size_t to = 1; to <= bins; ++to) {
    for (std::size_t start = 0; start < to; ++start) {
      double value = best[start] - penalty;
      const auto length = static_cast<double>(to - start);
      for (const std::vector<double>& sum : sums)
        value += logLikelihood(sum[to] - sum[start], length);
      if (value > best[to]) {
        best[to] = value;
        from[to] = start;
      }
    }
  }
  std::vector<std::size_t> levels;
  for (std::size_t b = bins; b > 0; b = from[b]) levels.push_back(b);
  levels.push_back(0);
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace storey::detail
