// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/wall_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr double kMinPoints = 20.0;  // of an edge that takes part

// n ln n, with the small numbers looked up.
class NLogN {
 public:
  explicit NLogN(std::size_t most) {
    constexpr std::size_t kMostKept = 1 << 16;
    values_.resize(std::min(most, kMostKept) + 1, 0.0);
    for (std::size_t n = 2; n < values_.size(); ++n) values_[n] = valueOf(n);
  }
  double operator()(std::size_t n) const { return n < values_.size() ? values_[n] : valueOf(n); }

 private:
  static double valueOf(std::size_t n) {
    return static_cast<double>(n) * std::log(static_cast<double>(n));
  }

  std::vector<double> values_;
};

// Points of the edges that have enough of them, below each boundary of the bins.
class EdgeCounts {
 public:
  explicit EdgeCounts(const WallEvidence& evidence)
      : bins_(evidence.num_bins), below_(bins_ + 1), n_log_n_(gather(evidence)) {}

  std::size_t numEdges() const { return below_[0].size(); }

  // The Poisson log-likelihood of a constant density of each edge in these bins: the sum of
  // n ln(n / length), but for what is the same for any partition.
  double likelihood(std::size_t from, std::size_t to) const {
    double sum = 0.0;
    std::size_t all = 0;
    for (std::size_t e = 0; e < numEdges(); ++e) {
      const std::size_t n = below_[to][e] - below_[from][e];
      sum += n_log_n_(n);
      all += n;
    }
    return sum - static_cast<double>(all) * std::log(static_cast<double>(to - from));
  }

 private:
  std::size_t gather(const WallEvidence& evidence) {
    std::size_t most = 0;
    for (std::size_t slot = 0; slot < evidence.ahead.size(); slot += bins_) {
      std::vector<std::size_t> sums(bins_ + 1, 0);
      for (std::size_t b = 0; b < bins_; ++b) {
        sums[b + 1] = sums[b] + static_cast<std::size_t>(evidence.ahead[slot + b] +
                                                         evidence.behind[slot + b]);
      }
      if (static_cast<double>(sums.back()) < kMinPoints) continue;
      most = std::max(most, sums.back());
      for (std::size_t b = 0; b <= bins_; ++b) below_[b].push_back(sums[b]);
    }
    return most;
  }

  std::size_t bins_;
  std::vector<std::vector<std::size_t>> below_;  // by boundary and edge
  NLogN n_log_n_;
};

}  // namespace

std::vector<std::size_t> findLevels(const WallEvidence& evidence) {
  const std::size_t bins = evidence.num_bins;
  if (bins == 0) return {};
  const EdgeCounts counts(evidence);
  const auto edges = static_cast<double>(counts.numEdges());
  const double penalty =
      0.5 * edges + 3.0 * std::sqrt(0.5 * edges) + 2.0 * std::log(static_cast<double>(bins) + 1.0);
  std::vector<double> best(bins + 1, -std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(bins + 1, 0);
  best[0] = 0.0;
  // Where the last range may start. A cut never lowers the likelihood: a start that lies behind the
  // best partition up to here even without the penalty of one more range does so for good (PELT,
  // Killick et al. 2012).
  std::vector<std::size_t> starts;
  for (std::size_t to = 1; to <= bins; ++to) {
    starts.push_back(to - 1);
    std::vector<double> values;
    for (const std::size_t start : starts) {
      values.push_back(best[start] + counts.likelihood(start, to));
      if (values.back() - penalty > best[to]) {
        best[to] = values.back() - penalty;
        from[to] = start;
      }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (values[i] >= best[to]) starts[kept++] = starts[i];
    }
    starts.resize(kept);
  }
  std::vector<std::size_t> levels;
  for (std::size_t b = bins; b > 0; b = from[b]) levels.push_back(b);
  levels.push_back(0);
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace storey::detail
