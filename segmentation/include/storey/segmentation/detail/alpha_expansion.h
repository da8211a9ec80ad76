// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace storey::detail {

/// Two different nodes that pay `weight` (>= 0) when their labels differ.
struct PottsEdge {
  std::size_t a;
  std::size_t b;
  double weight;
};

/// The energy  E(l) = sum_i D_i(l_i) + sum_edges w_e [l_a != l_b]  over labels 0 .. L-1, the form
/// of [Sui et al. 2016, (4)-(6)]. Repeated edges add up.
struct PottsProblem {
  std::size_t num_labels = 0;
  std::vector<double> data_costs;  ///< n x num_labels, row-major, finite: D_i(l)
  std::vector<PottsEdge> edges;

  std::size_t numNodes() const { return num_labels == 0 ? 0 : data_costs.size() / num_labels; }
};

/// E of n labels.
double pottsEnergy(const PottsProblem& problem, const std::vector<std::size_t>& labels);

/// For every node the label of the smallest data cost, the first of several.
std::vector<std::size_t> cheapestLabels(const PottsProblem& problem);

/// Iterated conditional modes: every node in turn takes its best label while the others are held,
/// until none changes. E never increases.
void descendByNodes(const PottsProblem& problem, std::vector<std::size_t>& labels);

/// Iterated conditional modes, then expansions in which only the nodes within `reach` links of a
/// label may take it, until none lowers E. E never increases. Cheap where the labels are right up
/// to the course of their boundaries.
void moveBoundaries(const PottsProblem& problem, std::size_t reach,
                    std::vector<std::size_t>& labels);

/// Minimises E from the cheapest labels by iterated conditional modes and then alpha-expansion
/// until no expansion of any label lowers E: within a factor of two of the optimum (for
/// non-negative costs), the optimum itself for two labels. Costs are rounded once to integers (of
/// 2^-51 of their sum), so that all sums are exact. Nodes that provably keep their label do
/// not enter a cut.
std::vector<std::size_t> minimizePotts(const PottsProblem& problem);

/// The same energy for labellings that are constant on groups: node i belongs to group[i] in
/// 0 .. num_groups-1. Costs and the weights between two groups are summed.
PottsProblem aggregatePotts(const PottsProblem& problem, const std::vector<std::size_t>& group,
                            std::size_t num_groups);

}  // namespace storey::detail
