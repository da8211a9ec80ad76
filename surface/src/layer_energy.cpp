// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/layer_energy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace storey {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the energy's scale: differences below this are rounding of sums.
constexpr double kEpsilon = 1e-9;
constexpr int kSubgradientSteps = 60;

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

struct ChainSolution {
  std::vector<int> labels;
  double energy = kInfinity;
};

// Viterbi: the cheapest labelling under `unary` (num_nodes x num_labels) and the pairwise costs.
// Labels that are not allowed have an infinite unary.
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

enum class Choice : char { Open, In, Out };

struct Branch {
  std::vector<Choice> choices;
  std::vector<double> multipliers;  // num_nodes x num_labels, sums over nodes <= label_cost
  double bound = -kInfinity;
};

struct LaterBound {
  bool operator()(const Branch& a, const Branch& b) const { return a.bound > b.bound; }
};

class BranchAndBound {
 public:
  BranchAndBound(const LayerEnergy& energy, std::size_t max_work)
      : energy_(energy), max_work_(max_work), rounding_(roundingOf(energy)) {
    best_.energy = kInfinity;
  }

  LayerLabeling run() {
    Branch root;
    root.choices.assign(energy_.num_labels, Choice::Open);
    root.multipliers.assign(energy_.num_nodes * energy_.num_labels, 0.0);
    for (std::size_t k = 0; k < root.multipliers.size(); ++k) {
      root.multipliers[k] =
          energy_.label_cost[k % energy_.num_labels] / static_cast<double>(energy_.num_nodes);
    }
    std::priority_queue<Branch, std::vector<Branch>, LaterBound> open;
    relax(root, open);
    double bound = kInfinity;  // of what was left unexplored
    while (!open.empty()) {
      if (open.top().bound >= best_.energy - rounding_) break;
      if (best_.work >= max_work_) {
        bound = open.top().bound;
        break;
      }
      const Branch branch = open.top();
      open.pop();
      const std::size_t label = branchingLabel(branch);
      for (const Choice choice : {Choice::In, Choice::Out}) {
        Branch child = branch;
        child.choices[label] = choice;
        relax(child, open);
      }
    }
    best_.lower_bound = std::min(best_.energy, bound);
    best_.optimal = best_.energy - best_.lower_bound <= rounding_;
    return best_;
  }

 private:
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

  // Raises the branch's bound by subgradient steps on the multipliers, keeps each labelling that
  // is seen on the way if it is the best so far, and puts the branch into the queue if open.
  void relax(Branch& branch, std::priority_queue<Branch, std::vector<Branch>, LaterBound>& open) {
    const std::size_t m = energy_.num_labels;
    double paid = 0.0;
    for (std::size_t t = 0; t < m; ++t) {
      if (branch.choices[t] == Choice::In) paid += energy_.label_cost[t];
    }
    Branch best = branch;
    best.bound = -kInfinity;
    for (int step = 0; step < kSubgradientSteps; ++step) {
      const ChainSolution solution = solveChain(energy_, unary(branch));
      ++best_.work;
      if (solution.energy == kInfinity) return;  // everything is out
      keepIfBest(solution.labels);
      if (solution.energy + paid > best.bound) {
        best = branch;
        best.bound = solution.energy + paid;
      }
      if (best.bound >= best_.energy - rounding_) return;
      if (!shiftMultipliers(branch, solution.labels, step)) break;
    }
    open.push(std::move(best));
  }

  void keepIfBest(const std::vector<int>& labels) {
    const double value = energy_.evaluate(labels);
    if (value < best_.energy) {
      best_.energy = value;
      best_.labels = labels;
    }
  }

  // A used open label should pay its whole cost over the nodes that use it, an unused one pays
  // nothing: move the multipliers towards the users. False if every open label pays already.
  bool shiftMultipliers(Branch& branch, const std::vector<int>& labels, int step) const {
    const std::size_t n = energy_.num_nodes;
    const std::size_t m = energy_.num_labels;
    bool moved = false;
    const double rate = 1.0 / (1.0 + 0.3 * step);
    for (std::size_t t = 0; t < m; ++t) {
      if (branch.choices[t] != Choice::Open || energy_.label_cost[t] <= 0.0) continue;
      std::vector<std::size_t> users;
      double at_users = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        if (labels[i] != static_cast<int>(t)) continue;
        users.push_back(i);
        at_users += branch.multipliers[i * m + t];
      }
      const double missing = energy_.label_cost[t] - at_users;
      if (users.empty() || missing <= rounding_) continue;
      moved = true;
      for (std::size_t i = 0; i < n; ++i) branch.multipliers[i * m + t] *= 1.0 - rate;
      const double target = rate * energy_.label_cost[t] / static_cast<double>(users.size());
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
      if (unpaid[t] < 0.0) unpaid[t] = energy_.label_cost[t];
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
  double rounding_;
  LayerLabeling best_;
};

}  // namespace

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

LayerLabeling minimizeLayerEnergy(const LayerEnergy& energy, std::size_t max_work) {
  if (energy.num_nodes == 0 || energy.num_labels == 0 || !isConsistent(energy)) return {};
  return BranchAndBound(energy, max_work).run();
}

LayerLabeling expandLayerLabels(const LayerEnergy& energy) {
  LayerLabeling current;
  if (energy.num_nodes == 0 || energy.num_labels == 0 || !isConsistent(energy)) return current;
  current.energy = kInfinity;
  const double rounding = roundingOf(energy);
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
      std::vector<double> unary(energy.data.size(), kInfinity);
      for (std::size_t i = 0; i < energy.num_nodes; ++i) {
        const auto kept = static_cast<std::size_t>(current.labels[i]);
        unary[i * m + kept] = energy.data[i * m + kept];
        unary[i * m + alpha] = energy.data[i * m + alpha];
      }
      const ChainSolution move = solveChain(energy, unary);
      ++current.work;
      const double value = energy.evaluate(move.labels);
      if (value < current.energy - rounding) {
        current.energy = value;
        current.labels = move.labels;
        improved = true;
      }
    }
  }
  return current;
}

}  // namespace storey
