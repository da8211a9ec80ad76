// SPDX-License-Identifier: BSD-3-Clause
#include "layer_branch_and_bound.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <utility>

#include "layer_chain.h"

namespace storey {
namespace {

using detail::ChainSolution;
using detail::kInfinity;
using detail::solveChain;

constexpr int kSubgradientSteps = 60;

enum class Choice : char { Open, In, Out };

// A set of labelings: those that use no label that is out. Their bound is Lagrangian: every label
// costs `price` more than its own cost, and the `limit` labels that are allowed are paid back; the
// cost of an open label is spread over the nodes by `multipliers`, that of one that is in is paid.
struct Branch {
  std::vector<Choice> choices;
  std::vector<double> multipliers;  // num_nodes x num_labels, sums over nodes <= cost + price
  double price = 0.0;               // of each label; 0 without a limit or with none open
  double bound = -kInfinity;

  std::size_t count(Choice choice) const {
    return static_cast<std::size_t>(std::count(choices.begin(), choices.end(), choice));
  }
};

struct LaterBound {
  bool operator()(const Branch& a, const Branch& b) const { return a.bound > b.bound; }
};

class BranchAndBound {
 public:
  BranchAndBound(const LayerEnergy& energy, std::size_t max_work, double price,
                 const std::vector<int>& known)
      : energy_(energy),
        max_work_(max_work),
        limit_(detail::labelLimit(energy)),
        price_(limit_ < energy.num_labels ? price : 0.0),
        rounding_(detail::roundingOf(energy)) {
    best_.energy = kInfinity;
    if (!known.empty()) keepIfBest(known);
  }

  LayerLabeling run() {
    relax(makeRoot());
    double bound = kInfinity;  // of what was left unexplored
    while (!open_.empty()) {
      if (open_.top().bound >= best_.energy - rounding_) break;
      if (best_.work >= max_work_) {
        bound = open_.top().bound;
        break;
      }
      const Branch branch = open_.top();
      open_.pop();
      const std::size_t label = branchingLabel(branch);
      for (const Choice choice : {Choice::In, Choice::Out}) {
        Branch child = branch;
        child.choices[label] = choice;
        relax(std::move(child));
      }
    }
    best_.lower_bound = std::min(best_.energy, bound);
    best_.optimal = best_.energy - best_.lower_bound <= rounding_;
    return best_;
  }

 private:
  Branch makeRoot() const {
    Branch root;
    root.choices.assign(energy_.num_labels, Choice::Open);
    root.price = price_;
    root.multipliers.assign(energy_.num_nodes * energy_.num_labels, 0.0);
    for (std::size_t k = 0; k < root.multipliers.size(); ++k) {
      root.multipliers[k] = (energy_.label_cost[k % energy_.num_labels] + price_) /
                            static_cast<double>(energy_.num_nodes);
    }
    return root;
  }

  std::vector<double> unary(const Branch& branch) const {
    const std::size_t m = energy_.num_labels;
    std::vector<double> u = energy_.data;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Choice choice = branch.choices[k % m];
      if (choice == Choice::Out) u[k] = kInfinity;
      if (choice == Choice::Open) u[k] += branch.multipliers[k];
    }
    return u;
  }

  // What a branch pays whatever its labelling: the labels that are in, less the price paid back.
  double constantOf(const Branch& branch) const {
    double paid = 0.0;
    for (std::size_t t = 0; t < energy_.num_labels; ++t) {
      if (branch.choices[t] == Choice::In) paid += energy_.label_cost[t];
    }
    return paid - branch.price * static_cast<double>(limit_ - branch.count(Choice::In));
  }

  // Once as many labels are in as are allowed the others are out; with none open there is nothing
  // to price.
  void closeIfDecided(Branch& branch) const {
    if (branch.count(Choice::In) >= limit_) {
      std::replace(branch.choices.begin(), branch.choices.end(), Choice::Open, Choice::Out);
    }
    if (branch.count(Choice::Open) == 0) branch.price = 0.0;
  }

  // Raises the branch's bound by subgradient steps on the multipliers, keeps each labelling that
  // is seen on the way if it is the best so far, and puts the branch into the queue if open.
  void relax(Branch branch) {
    closeIfDecided(branch);
    Branch best = branch;
    best.bound = -kInfinity;
    std::vector<int> labels;
    for (int step = 0; step < kSubgradientSteps; ++step) {
      const ChainSolution solution = solveChain(energy_, unary(branch));
      ++best_.work;
      if (solution.energy == kInfinity) return;  // everything is out
      keepIfBest(solution.labels);
      labels = solution.labels;
      const double bound = solution.energy + constantOf(branch);
      if (bound > best.bound) {
        best = branch;
        best.bound = bound;
      }
      if (best.bound >= best_.energy - rounding_) return;
      if (!shiftMultipliers(branch, labels, 1.0 / (1.0 + 0.3 * step))) break;
    }
    keepMostUsed(best, labels);
    open_.push(std::move(best));
  }

  void keepIfBest(const std::vector<int>& labels) {
    if (detail::countLabels(labels) > limit_) return;
    const double value = energy_.evaluate(labels);
    if (value < best_.energy) {
      best_.energy = value;
      best_.labels = labels;
    }
  }

  // A labelling with too many labels, mended: the labels that are in and those used most remain.
  void keepMostUsed(const Branch& branch, const std::vector<int>& labels) {
    if (detail::countLabels(labels) <= limit_) return;
    const std::size_t m = energy_.num_labels;
    std::vector<std::size_t> users(m, 0);
    for (const int label : labels) ++users[static_cast<std::size_t>(label)];
    std::vector<std::size_t> order(m);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t t) {
      return std::make_pair(branch.choices[t] == Choice::In, users[t]);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
    std::vector<double> u(energy_.data.size(), kInfinity);
    for (std::size_t place = 0; place < limit_; ++place) {
      for (std::size_t k = order[place]; k < u.size(); k += m) u[k] = energy_.data[k];
    }
    keepIfBest(solveChain(energy_, u).labels);
    ++best_.work;
  }

  // A used open label should pay its whole cost over the nodes that use it, an unused one pays
  // nothing: move the multipliers towards the users. False if every open label pays already.
  bool shiftMultipliers(Branch& branch, const std::vector<int>& labels, double rate) const {
    const std::size_t n = energy_.num_nodes;
    const std::size_t m = energy_.num_labels;
    bool moved = false;
    for (std::size_t t = 0; t < m; ++t) {
      const double cost = energy_.label_cost[t] + branch.price;
      if (branch.choices[t] != Choice::Open || cost <= 0.0) continue;
      std::vector<std::size_t> users;
      double at_users = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        if (labels[i] != static_cast<int>(t)) continue;
        users.push_back(i);
        at_users += branch.multipliers[i * m + t];
      }
      if (users.empty() || cost - at_users <= rounding_) continue;
      moved = true;
      for (std::size_t i = 0; i < n; ++i) branch.multipliers[i * m + t] *= 1.0 - rate;
      const double target = rate * cost / static_cast<double>(users.size());
      for (const std::size_t i : users) branch.multipliers[i * m + t] += target;
    }
    return moved;
  }

  // The open label whose use in the relaxed labelling is furthest from being paid for. There is
  // one: with all labels decided the relaxation is exact, and its branch was closed.
  std::size_t branchingLabel(const Branch& branch) {
    const std::size_t m = energy_.num_labels;
    const ChainSolution solution = solveChain(energy_, unary(branch));
    ++best_.work;
    std::vector<double> unpaid(m, -1.0);
    for (std::size_t i = 0; i < energy_.num_nodes; ++i) {
      const auto t = static_cast<std::size_t>(solution.labels[i]);
      if (branch.choices[t] != Choice::Open) continue;
      if (unpaid[t] < 0.0) unpaid[t] = energy_.label_cost[t] + branch.price;
      unpaid[t] = std::max(0.0, unpaid[t] - branch.multipliers[i * m + t]);
    }
    std::size_t chosen = m;
    for (std::size_t t = 0; t < m; ++t) {
      if (branch.choices[t] == Choice::Open && (chosen == m || unpaid[t] > unpaid[chosen])) {
        chosen = t;
      }
    }
    return chosen;
  }

  const LayerEnergy& energy_;
  std::size_t max_work_;
  std::size_t limit_;  // of labels in use
  double price_;
  double rounding_;
  std::priority_queue<Branch, std::vector<Branch>, LaterBound> open_;
  LayerLabeling best_;
};

}  // namespace

LayerLabeling detail::branchAndBound(const LayerEnergy& energy, std::size_t max_work, double price,
                                     const std::vector<int>& known) {
  return BranchAndBound(energy, max_work, price, known).run();
}

}  // namespace storey
