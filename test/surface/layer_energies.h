// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/layer_energy.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <vector>

/// Energies of chains of layers, and their minima by going through all labelings.
namespace storey::test {

/// The sum as (11) is written, by another way than the class's own.
inline double energyOf(const LayerEnergy& e, const std::vector<int>& z) {
  double sum = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    sum += e.data[i * e.num_labels + static_cast<std::size_t>(z[i])];
  }
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    sum +=
        e.pair[static_cast<std::size_t>(z[i]) * e.num_labels + static_cast<std::size_t>(z[i + 1])];
  }
  for (const int t : std::set<int>(z.begin(), z.end())) {
    sum += e.label_cost[static_cast<std::size_t>(t)];
  }
  return sum;
}

/// Calls `visit` with every labelling.
template <typename Visit>
void forAllLabelings(const LayerEnergy& e, const Visit& visit) {
  std::vector<int> z(e.num_nodes, 0);
  while (true) {
    visit(z);
    std::size_t i = 0;
    while (i < z.size() && ++z[i] == static_cast<int>(e.num_labels)) z[i++] = 0;
    if (i == z.size()) return;
  }
}

inline double leastOfAllLabelings(const LayerEnergy& e) {
  double least = std::numeric_limits<double>::infinity();
  forAllLabelings(e, [&](const std::vector<int>& z) { least = std::min(least, energyOf(e, z)); });
  return least;
}

/// Pairwise costs of any kind: symmetric or not, no metric.
inline LayerEnergy randomEnergy(std::size_t nodes, std::size_t labels, std::mt19937& random,
                                double scale = 1.0) {
  LayerEnergy e;
  e.num_nodes = nodes;
  e.num_labels = labels;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> few(0, 2);
  const bool ties = few(random) == 0;
  const auto draw = [&] { return scale * (ties ? few(random) : unit(random)); };
  for (std::size_t k = 0; k < nodes * labels; ++k) e.data.push_back(draw());
  for (std::size_t a = 0; a < labels; ++a) {
    for (std::size_t b = 0; b < labels; ++b) e.pair.push_back(a == b ? 0.0 : 0.7 * draw());
  }
  for (std::size_t t = 0; t < labels; ++t) e.label_cost.push_back(draw());
  return e;
}

/// Runs of equal length with a label each, which costs 0.1 on its run; `singles` more labels that
/// fit one node each, without cost; all others cost 0.6 and a step `step`. No label costs.
inline LayerEnergy runsOfLabels(std::size_t nodes, std::size_t runs, std::size_t singles,
                                double step) {
  LayerEnergy e;
  e.num_nodes = nodes;
  e.num_labels = runs + singles;
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t t = 0; t < e.num_labels; ++t) {
      const bool own = t < runs ? i * runs / nodes == t : i == 3 * (t - runs);
      e.data.push_back(t < runs && own ? 0.1 : own ? 0.0 : 0.6);
    }
  }
  for (std::size_t a = 0; a < e.num_labels; ++a) {
    for (std::size_t b = 0; b < e.num_labels; ++b) e.pair.push_back(a == b ? 0.0 : step);
  }
  e.label_cost.assign(e.num_labels, 0.0);
  return e;
}

}  // namespace storey::test
