// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/layer_energy.h>

#include "layer_chain.h"

namespace storey {

double LayerEnergy::evaluate(const std::vector<int>& labels) const {
  double sum = 0.0;
  std::vector<char> used(num_labels, 0);
  for (std::size_t i = 0; i < num_nodes; ++i) {
    const auto t = static_cast<std::size_t>(labels[i]);
    sum += data[i * num_labels + t];
    if (i > 0) sum += pair[static_cast<std::size_t>(labels[i - 1]) * num_labels + t];
    used[t] = 1;
  }
  for (std::size_t t = 0; t < num_labels; ++t) {
    if (used[t] != 0) sum += label_cost[t];
  }
  return sum;
}

LayerLabeling expandLayerLabels(const LayerEnergy& energy) {
  LayerLabeling current;
  if (energy.num_nodes == 0 || energy.num_labels == 0 || !detail::isConsistent(energy))
    return current;
  current.energy = detail::kInfinity;
  const std::size_t limit = detail::labelLimit(energy);
  const double rounding = detail::roundingOf(energy);
  const std::size_t m = energy.num_labels;
  for (std::size_t t = 0; t < m; ++t) {
    const std::vector<int> constant(energy.num_nodes, static_cast<int>(t));
    const double value = energy.evaluate(constant);
    if (value < current.energy) {
      current.energy = value;
      current.labels = constant;
    }
  }
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t alpha = 0; alpha < m; ++alpha) {
      // Every node keeps its label or takes alpha: a chain where two labels a node are allowed.
      std::vector<double> unary(energy.data.size(), detail::kInfinity);
      for (std::size_t i = 0; i < energy.num_nodes; ++i) {
        const auto kept = static_cast<std::size_t>(current.labels[i]);
        unary[i * m + kept] = energy.data[i * m + kept];
        unary[i * m + alpha] = energy.data[i * m + alpha];
      }
      const detail::ChainSolution move = detail::solveChain(energy, unary);
      ++current.work;
      const double value = energy.evaluate(move.labels);
      if (value < current.energy - rounding && detail::countLabels(move.labels) <= limit) {
        current.energy = value;
        current.labels = move.labels;
        improved = true;
      }
    }
  }
  return current;
}

}  // namespace storey
