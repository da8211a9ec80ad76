// SPDX-License-Identifier: BSD-3-Clause
#include "layer_chain.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <set>

namespace storey::detail {
namespace {

constexpr double kEpsilon = 1e-9;  // of the largest cost

}  // namespace

double roundingOf(const LayerEnergy& energy) {
  double largest = 0.0;
  for (const std::vector<double>* costs : {&energy.data, &energy.pair, &energy.label_cost}) {
    for (const double cost : *costs) largest = std::max(largest, cost);
  }
  return kEpsilon * largest;
}

bool isConsistent(const LayerEnergy& energy) {
  const std::size_t n = energy.num_nodes;
  const std::size_t m = energy.num_labels;
  bool valid =
      energy.data.size() == n * m && energy.pair.size() == m * m && energy.label_cost.size() == m;
  for (const std::vector<double>* costs : {&energy.data, &energy.pair, &energy.label_cost}) {
    for (const double cost : *costs) valid = valid && cost >= 0.0 && cost < kInfinity;
  }
  if (!valid) {
    PCL_ERROR(
        "[storey::LayerEnergy] %zu x %zu data, %zu pair and %zu label costs expected, all finite "
        "and >= 0.\n",
        n, m, m * m, m);
  }
  return valid;
}

ChainSolution solveChain(const LayerEnergy& energy, const std::vector<double>& unary) {
  const std::size_t n = energy.num_nodes;
  const std::size_t m = energy.num_labels;
  std::vector<double> cost(unary.begin(), unary.begin() + static_cast<std::ptrdiff_t>(m));
  std::vector<double> next(m);
  std::vector<int> from(n * m, 0);
  for (std::size_t i = 1; i < n; ++i) {
    for (std::size_t b = 0; b < m; ++b) {
      next[b] = kInfinity;
      if (unary[i * m + b] == kInfinity) continue;
      for (std::size_t a = 0; a < m; ++a) {
        const double c = cost[a] + energy.pair[a * m + b];
        if (c < next[b]) {
          next[b] = c;
          from[i * m + b] = static_cast<int>(a);
        }
      }
      next[b] += unary[i * m + b];
    }
    cost.swap(next);
  }
  ChainSolution solution;
  const auto best = std::min_element(cost.begin(), cost.end());
  solution.energy = *best;
  solution.labels.assign(n, static_cast<int>(best - cost.begin()));
  for (std::size_t i = n - 1; i > 0; --i) {
    solution.labels[i - 1] = from[i * m + static_cast<std::size_t>(solution.labels[i])];
  }
  return solution;
}

std::size_t countLabels(const std::vector<int>& labels) {
  return std::set<int>(labels.begin(), labels.end()).size();
}

std::size_t labelLimit(const LayerEnergy& energy) {
  return energy.max_labels == 0 ? energy.num_labels
                                : std::min(energy.max_labels, energy.num_labels);
}

}  // namespace storey::detail
