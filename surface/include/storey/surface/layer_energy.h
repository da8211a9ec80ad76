// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace storey {

/// The energy (11)-(15) of [Sui et al. 2016] as plain numbers: a chain of nodes (the floorplans
/// along gravity), the same labels (floorplan types) for each, and a cost for every label that is
/// used at all.
///
///     E(Z) = sum_i data(i, Z_i) + sum_i pair(Z_i, Z_i+1) + sum_T label_cost(T) [T is used]
struct LayerEnergy {
  std::size_t num_nodes = 0;
  std::size_t num_labels = 0;
  std::vector<double> data;        ///< num_nodes x num_labels, row-major, >= 0
  std::vector<double> pair;        ///< num_labels x num_labels, row-major, >= 0, 0 on the diagonal
  std::vector<double> label_cost;  ///< num_labels, >= 0
  std::size_t max_labels = 0;      ///< labelings with more labels in use are none; 0: no limit

  double evaluate(const std::vector<int>& labels) const;
};

struct LayerLabeling {
  std::vector<int> labels;  ///< num_nodes
  double energy = 0.0;
  double lower_bound = 0.0;  ///< no labelling is cheaper
  bool optimal = false;      ///< energy == lower_bound; false if the work limit was hit
  std::size_t work = 0;      ///< dynamic programs solved
};

/// Minimises the energy globally. For a given set of labels the chain is solved exactly by dynamic
/// programming; branch and bound goes over the sets, with bounds by Lagrangian relaxation of the
/// label costs (a label's cost is spread over the nodes that use it). A limit on the number of
/// labels is relaxed too: one price for every label, paid back as often as labels are allowed.
/// \note Deviation: the paper uses alpha-expansion, which is not guaranteed here, for its pairwise
/// term with k2 = 3 k1 is no metric.
/// \param max_work limit of dynamic programs, each O(num_nodes num_labels^2) at worst and mostly
/// O(num_nodes num_labels log num_labels); a count, not a time, so that the result does not depend
/// on the machine. 0: from 200 for large problems to 20000 for small ones. It is looked at between
/// branches, of 122 programs at the most; a limit on the labels takes a few searches of one branch
/// or more each
/// \return no labels, after a PCL_ERROR, if a size is wrong or a cost negative or not finite
LayerLabeling minimizeLayerEnergy(const LayerEnergy& energy, std::size_t max_work = 0);

/// A point of the trade-off between how many labels are used and how well they fit.
struct LayerTradeOff {
  std::size_t num_labels = 0;
  LayerLabeling labeling;  ///< its energy, and its bound, are without label costs
};

/// The Pareto front of the energy without label costs against the number of labels in use: the
/// least energy for each number of labels, as far as one more label lowers it, by
/// `minimizeLayerEnergy` with `max_labels` = 1, 2, ... up to the energy's own limit. What label
/// costs choose among are the points on its convex hull, if all labels cost the same.
/// \param max_work of all numbers of labels together, as there; the front ends where it does
/// \return ascending in number, descending in energy
std::vector<LayerTradeOff> tradeOffLabels(const LayerEnergy& energy, std::size_t max_work = 0);

/// Alpha-expansion with label costs on the same chain, for comparison: from the best single label,
/// each expansion move is a binary chain, solved by dynamic programming without the label costs and
/// taken if the energy with them falls. A local minimum.
LayerLabeling expandLayerLabels(const LayerEnergy& energy);

}  // namespace storey
