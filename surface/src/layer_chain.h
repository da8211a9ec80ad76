// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/layer_energy.h>

#include <limits>
#include <vector>

/// What the minimisers of the layers' energy share: the chain without label costs.
namespace storey::detail {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct ChainSolution {
  std::vector<int> labels;
  double energy = kInfinity;
};

/// Viterbi: the cheapest labelling under `unary` (num_nodes x num_labels) and the pairwise costs.
/// Labels that are not allowed have an infinite unary.
ChainSolution solveChain(const LayerEnergy& energy, const std::vector<double>& unary);

/// Differences of energies below this are rounding of sums.
double roundingOf(const LayerEnergy& energy);

/// Whether the sizes agree and all costs are finite and >= 0; otherwise a PCL_ERROR.
bool isConsistent(const LayerEnergy& energy);

/// How many different labels there are.
std::size_t countLabels(const std::vector<int>& labels);

/// The limit of dynamic programs for an energy of that size, unless it is given (not 0).
std::size_t workLimit(const LayerEnergy& energy, std::size_t max_work);

/// The greatest number of labels that may be used.
std::size_t labelLimit(const LayerEnergy& energy);

}  // namespace storey::detail
