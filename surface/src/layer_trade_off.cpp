// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "layer_branch_and_bound.h"
#include "layer_chain.h"

namespace storey {
namespace {

using detail::branchAndBound;
using detail::countLabels;

std::size_t difference(std::size_t a, std::size_t b) { return a > b ? a - b : 0; }

// The price of a label at which the least energy with it, less the price of the labels that are
// allowed, is greatest: the Lagrangian bound of the limit on their number. It is the slope of the
// trade-off's convex hull over the limit: the chord of two labelings, one within and one beyond the
// limit, while others lie below it.
class PriceSearch {
 public:
  PriceSearch(const LayerEnergy& energy, std::size_t max_work)
      : energy_(energy), max_work_(max_work), limit_(detail::labelLimit(energy)) {
    for (std::size_t t = 0; t < energy_.num_labels; ++t) {
      keepIfBest(std::vector<int>(energy_.num_nodes, static_cast<int>(t)));
    }
  }

  /// The best labelling within the limit that was met, and the bound.
  const LayerLabeling& within() const { return within_; }

  double run() {
    if (limit_ == 1) {  // all of them were tried
      within_.lower_bound = within_.energy;
      within_.optimal = true;
      return 0.0;
    }
    double price = 0.0;
    std::vector<int> beyond = solve(price);
    while (countLabels(beyond) > limit_) {
      const double excess = static_cast<double>(countLabels(beyond)) -
                            static_cast<double>(countLabels(within_.labels));
      const double slope = (within_.energy - energy_.evaluate(beyond)) / excess;
      if (!(slope > 0.0)) break;  // `beyond` is no minimum: the work ran out
      price = slope;
      std::vector<int> below = solve(price);
      const double gain = pricedEnergy(within_.labels, price) - pricedEnergy(below, price);
      if (gain <= detail::roundingOf(energy_)) break;
      if (countLabels(below) > limit_) {
        beyond = std::move(below);
      } else if (!keepIfBest(below)) {
        break;
      }
    }
    keepIfBest(beyond);
    within_.optimal = within_.energy - within_.lower_bound <= detail::roundingOf(energy_);
    return price;
  }

 private:
  std::vector<int> solve(double price) {
    LayerEnergy priced = energy_;
    priced.max_labels = 0;
    for (double& cost : priced.label_cost) cost += price;
    const LayerLabeling solution = branchAndBound(priced, difference(max_work_, within_.work));
    within_.work += solution.work;
    within_.lower_bound =
        std::max(within_.lower_bound, solution.lower_bound - price * static_cast<double>(limit_));
    return solution.labels;
  }

  double pricedEnergy(const std::vector<int>& labels, double price) const {
    return energy_.evaluate(labels) + price * static_cast<double>(countLabels(labels));
  }

  bool keepIfBest(const std::vector<int>& labels) {
    const double value = energy_.evaluate(labels);
    if (countLabels(labels) > limit_ || (!within_.labels.empty() && value >= within_.energy)) {
      return false;
    }
    within_.energy = value;
    within_.labels = labels;
    return true;
  }

  const LayerEnergy& energy_;
  std::size_t max_work_;
  std::size_t limit_;
  LayerLabeling within_;
};

}  // namespace

LayerLabeling minimizeLayerEnergy(const LayerEnergy& energy, std::size_t max_work) {
  if (energy.num_nodes == 0 || energy.num_labels == 0 || !detail::isConsistent(energy)) return {};
  max_work = detail::workLimit(energy, max_work);
  if (detail::labelLimit(energy) == energy.num_labels) return branchAndBound(energy, max_work);
  PriceSearch search(energy, max_work);
  const double price = search.run();
  const LayerLabeling& within = search.within();
  if (within.optimal) return within;
  LayerLabeling best =
      branchAndBound(energy, difference(max_work, within.work), price, within.labels);
  best.work += within.work;
  best.lower_bound = std::min(best.energy, std::max(best.lower_bound, within.lower_bound));
  best.optimal = best.energy - best.lower_bound <= detail::roundingOf(energy);
  return best;
}

std::vector<LayerTradeOff> tradeOffLabels(const LayerEnergy& energy, std::size_t max_work) {
  std::vector<LayerTradeOff> front;
  if (energy.num_nodes == 0 || energy.num_labels == 0 || !detail::isConsistent(energy))
    return front;
  LayerEnergy free = energy;
  free.label_cost.assign(energy.num_labels, 0.0);
  const double rounding = detail::roundingOf(free);
  const double least = detail::solveChain(free, free.data).energy;
  max_work = detail::workLimit(energy, max_work);
  std::size_t work = 0;
  double reached = detail::kInfinity;
  for (free.max_labels = 1; free.max_labels <= detail::labelLimit(energy) &&
                            reached > least + rounding && work < max_work;
       ++free.max_labels) {
    LayerLabeling labeling = minimizeLayerEnergy(free, max_work - work);
    work += labeling.work;
    if (labeling.energy >= reached - rounding) continue;
    reached = labeling.energy;
    front.push_back({countLabels(labeling.labels), std::move(labeling)});
  }
  return front;
}

}  // namespace storey
