// SPDX-License-Identifier: BSD-3-Clause
#include "layer_chain.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <set>
#include <utility>

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
  std::vector<std::pair<double, std::size_t>> order(m);
  for (std::size_t i = 1; i < n; ++i) {
    // Cheapest first: pairs cost nothing or more, so what is dearer than the best need not be
    // tried.
    for (std::size_t a = 0; a < m; ++a) order[a] = {cost[a], a};
    std::sort(order.begin(), order.end());
    for (std::size_t b = 0; b < m; ++b) {
      next[b] = kInfinity;
      if (unary[i * m + b] == kInfinity) continue;
      std::size_t best = m;
      for (const auto& [before, a] : order) {
        if (before > next[b] || before == kInfinity) break;
        const double c = before + energy.pair[a * m + b];
        if (c > next[b] || (c == next[b] && a > best)) continue;  // of equals the first label
        next[b] = c;
        best = a;
      }
      if (best < m) from[i * m + b] = static_cast<int>(best);
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

std::size_t workLimit(const LayerEnergy& energy, std::size_t max_work) {
  constexpr double kSteps = 1e7;  // half a second or so, a step being a label of a node
  if (max_work > 0) return max_work;
  const auto steps = static_cast<double>(energy.num_nodes * energy.num_labels);
  return static_cast<std::size_t>(std::clamp(kSteps / steps, 200.0, 20000.0));
}

std::size_t labelLimit(const LayerEnergy& energy) {
  return energy.max_labels == 0 ? energy.num_labels
                                : std::min(energy.max_labels, energy.num_labels);
}

}  // namespace storey::detail
