// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/alpha_expansion.h>
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace storey::detail {
namespace {

using Capacity = MaxFlow::Capacity;
constexpr int kEnergyBits = 51;  // room for sums of integer costs within an int64_t

// D: data costs, w: weights, l: present labels, x_i: whether node i switches to alpha.
class PottsSolver {
 public:
  PottsSolver(const PottsProblem& problem, std::vector<std::size_t> labels)
      : num_labels_(problem.num_labels),
        labels_(std::move(labels)),
        movable_(labels_.size(), false) {
    const double scale = integerScale(problem);
    costs_.reserve(problem.data_costs.size());
    for (std::size_t i = 0; i < problem.numNodes(); ++i) {
      const auto row = problem.data_costs.begin() + static_cast<std::ptrdiff_t>(i * num_labels_);
      const double least = *std::min_element(row, row + static_cast<std::ptrdiff_t>(num_labels_));
      for (std::size_t l = 0; l < num_labels_; ++l) {
        costs_.push_back(std::llround((row[static_cast<std::ptrdiff_t>(l)] - least) * scale));
      }
    }
    linkNeighbors(problem, scale);
  }

  const std::vector<std::size_t>& labels() const { return labels_; }

  void descend() {
    std::vector<Capacity> saved(num_labels_);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < labels_.size(); ++i) {
        changed |= takeBestLabel(i, saved);
      }
    }
  }

  // Expansions of all labels in turn, each over the nodes within `reach` links of it.
  void expandAll(std::size_t reach) {
    // done when as many labels as there are, one after the other, have changed nothing
    std::size_t idle = 0;
    for (std::size_t alpha = 0; idle < num_labels_; alpha = (alpha + 1) % num_labels_) {
      findCandidates(alpha, reach);
      findMovable(alpha);
      idle = expand(alpha) ? 0 : idle + 1;
    }
  }

 private:
  struct Link {
    std::size_t node;
    Capacity weight;
  };

  // A power of two, so that the scaling itself rounds nothing.
  static double integerScale(const PottsProblem& problem) {
    double total = 0.0;
    for (std::size_t i = 0; i < problem.numNodes(); ++i) {
      const auto row =
          problem.data_costs.begin() + static_cast<std::ptrdiff_t>(i * problem.num_labels);
      const auto ends =
          std::minmax_element(row, row + static_cast<std::ptrdiff_t>(problem.num_labels));
      total += *ends.second - *ends.first;
    }
    for (const PottsEdge& edge : problem.edges) {
      total += edge.weight;
    }
    return total > 0.0 ? std::exp2(kEnergyBits - std::ceil(std::log2(total))) : 1.0;
  }

  void linkNeighbors(const PottsProblem& problem, double scale) {
    first_link_.assign(labels_.size() + 1, 0);
    for (const PottsEdge& edge : problem.edges) {
      assert(edge.a != edge.b && edge.weight >= 0.0);
      ++first_link_[edge.a + 1];
      ++first_link_[edge.b + 1];
    }
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      first_link_[i + 1] += first_link_[i];
    }
    links_.resize(2 * problem.edges.size());
    std::vector<std::size_t> next(first_link_.begin(), first_link_.end() - 1);
    for (const PottsEdge& edge : problem.edges) {
      const Capacity weight = std::llround(edge.weight * scale);
      links_[next[edge.a]++] = {edge.b, weight};
      links_[next[edge.b]++] = {edge.a, weight};
    }
  }

  Capacity cost(std::size_t node, std::size_t label) const {
    return costs_[node * num_labels_ + label];
  }

  bool takeBestLabel(std::size_t i, std::vector<Capacity>& saved) {
    std::fill(saved.begin(), saved.end(), 0);
    for (std::size_t e = first_link_[i]; e < first_link_[i + 1]; ++e) {
      saved[labels_[links_[e].node]] += links_[e].weight;
    }
    std::size_t best = labels_[i];
    for (std::size_t l = 0; l < num_labels_; ++l) {
      if (cost(i, l) - saved[l] < cost(i, best) - saved[best]) {
        best = l;
      }
    }
    return std::exchange(labels_[i], best) != best;
  }

  void findCandidates(std::size_t alpha, std::size_t reach) {
    const std::size_t n = labels_.size();
    if (reach >= n) {
      for (std::size_t i = 0; i < n; ++i) {
        movable_[i] = labels_[i] != alpha;
      }
      return;
    }
    std::fill(movable_.begin(), movable_.end(), false);
    std::vector<std::size_t> ring;  // nodes at the same number of links from alpha
    for (std::size_t i = 0; i < n; ++i) {
      if (labels_[i] == alpha) {
        ring.push_back(i);
      }
    }
    for (std::size_t step = 0; step < reach; ++step) {
      std::vector<std::size_t> next;
      for (const std::size_t i : ring) {
        for (std::size_t e = first_link_[i]; e < first_link_[i + 1]; ++e) {
          const std::size_t j = links_[e].node;
          if (labels_[j] != alpha && !movable_[j]) {
            movable_[j] = true;
            next.push_back(j);
          }
        }
      }
      ring = std::move(next);
    }
  }

  // Leaves among the candidates those that may gain by a switch to alpha. gain bounds from above
  // what a switch of i saves: a neighbour that may switch too or has alpha already saves w, one
  // that stays saves nothing, and -w if it has the present label of i. A node with gain <= 0 stays
  // in some best expansion, and then its neighbours gain less.
  void findMovable(std::size_t alpha) {
    const std::size_t n = labels_.size();
    std::vector<Capacity> gain(n, 0);
    std::vector<std::size_t> fixed;
    for (std::size_t i = 0; i < n; ++i) {
      if (!movable_[i]) {
        continue;
      }
      gain[i] = cost(i, labels_[i]) - cost(i, alpha);
      for (std::size_t e = first_link_[i]; e < first_link_[i + 1]; ++e) {
        const std::size_t j = links_[e].node;
        const bool saves = movable_[j] || labels_[j] == alpha;
        gain[i] += saves ? links_[e].weight : labels_[j] == labels_[i] ? -links_[e].weight : 0;
      }
      if (gain[i] <= 0) {
        fixed.push_back(i);
      }
    }
    for (const std::size_t i : fixed) {
      movable_[i] = false;
    }
    while (!fixed.empty()) {
      const std::size_t i = fixed.back();
      fixed.pop_back();
      for (std::size_t e = first_link_[i]; e < first_link_[i + 1]; ++e) {
        const std::size_t j = links_[e].node;
        if (!movable_[j]) {
          continue;
        }
        gain[j] -= (labels_[i] == labels_[j] ? 2 : 1) * links_[e].weight;
        if (gain[j] <= 0) {
          movable_[j] = false;
          fixed.push_back(j);
        }
      }
    }
  }

  // The best of all labellings in which every node keeps its label or takes alpha; false if it is
  // no better than the present one. Source side = keep, sink side = switch.
  bool expand(std::size_t alpha) {
    std::vector<std::size_t> nodes;
    std::vector<std::size_t> number(labels_.size(), 0);
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (movable_[i]) {
        number[i] = nodes.size();
        nodes.push_back(i);
      }
    }
    if (nodes.empty()) {
      return false;
    }
    MaxFlow flow(nodes.size());
    Capacity present = 0;
    for (const std::size_t i : nodes) {
      present += addNode(i, alpha, number, flow);
    }
    if (flow.solve() >= present) {
      return false;
    }
    for (const std::size_t i : nodes) {
      if (!flow.inSourceSide(number[i])) {
        labels_[i] = alpha;
      }
    }
    return true;
  }

  // Returns what keeping the label costs, all others keeping theirs.
  Capacity addNode(std::size_t i, std::size_t alpha, const std::vector<std::size_t>& number,
                   MaxFlow& flow) const {
    Capacity keep = cost(i, labels_[i]);
    Capacity change = cost(i, alpha);
    for (std::size_t e = first_link_[i]; e < first_link_[i + 1]; ++e) {
      const std::size_t j = links_[e].node;
      const Capacity weight = links_[e].weight;
      if (!movable_[j]) {
        keep += labels_[j] != labels_[i] ? weight : 0;
        change += labels_[j] != alpha ? weight : 0;
      } else if (i > j) {
        continue;  // a link between movable nodes is entered once
      } else if (labels_[i] == labels_[j]) {
        flow.addEdge(number[i], number[j], weight, weight);
      } else {  // w (1 - x_i x_j) = w (1 - x_i) + w x_i (1 - x_j)
        keep += weight;
        flow.addEdge(number[i], number[j], 0, weight);
      }
    }
    flow.addTerminalCapacities(number[i], change, keep);
    return keep;
  }

  std::size_t num_labels_;
  std::vector<Capacity> costs_;  // n x num_labels_, smallest of a row is 0
  std::vector<std::size_t> first_link_;
  std::vector<Link> links_;
  std::vector<std::size_t> labels_;
  std::vector<bool> movable_;
};

}  // namespace

double pottsEnergy(const PottsProblem& problem, const std::vector<std::size_t>& labels) {
  double energy = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    energy += problem.data_costs[i * problem.num_labels + labels[i]];
  }
  for (const PottsEdge& edge : problem.edges) {
    energy += labels[edge.a] != labels[edge.b] ? edge.weight : 0.0;
  }
  return energy;
}

std::vector<std::size_t> cheapestLabels(const PottsProblem& problem) {
  std::vector<std::size_t> labels(problem.numNodes());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto row =
        problem.data_costs.begin() + static_cast<std::ptrdiff_t>(i * problem.num_labels);
    const auto end = row + static_cast<std::ptrdiff_t>(problem.num_labels);
    labels[i] = static_cast<std::size_t>(std::min_element(row, end) - row);
  }
  return labels;
}

void descendByNodes(const PottsProblem& problem, std::vector<std::size_t>& labels) {
  PottsSolver solver(problem, labels);
  solver.descend();
  labels = solver.labels();
}

void moveBoundaries(const PottsProblem& problem, std::size_t reach,
                    std::vector<std::size_t>& labels) {
  PottsSolver solver(problem, labels);
  solver.descend();
  solver.expandAll(reach);
  labels = solver.labels();
}

std::vector<std::size_t> minimizePotts(const PottsProblem& problem) {
  std::vector<std::size_t> labels = cheapestLabels(problem);
  moveBoundaries(problem, problem.numNodes(), labels);
  return labels;
}

PottsProblem aggregatePotts(const PottsProblem& problem, const std::vector<std::size_t>& group,
                            std::size_t num_groups) {
  PottsProblem result;
  result.num_labels = problem.num_labels;
  result.data_costs.assign(num_groups * problem.num_labels, 0.0);
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t l = 0; l < problem.num_labels; ++l) {
      result.data_costs[group[i] * problem.num_labels + l] +=
          problem.data_costs[i * problem.num_labels + l];
    }
  }
  std::vector<PottsEdge> between;
  for (const PottsEdge& edge : problem.edges) {
    const auto ends = std::minmax(group[edge.a], group[edge.b]);
    if (ends.first != ends.second) {
      between.push_back({ends.first, ends.second, edge.weight});
    }
  }
  std::sort(between.begin(), between.end(), [](const PottsEdge& e, const PottsEdge& f) {
    return std::make_pair(e.a, e.b) < std::make_pair(f.a, f.b);
  });
  for (const PottsEdge& edge : between) {
    if (!result.edges.empty() && result.edges.back().a == edge.a &&
        result.edges.back().b == edge.b) {
      result.edges.back().weight += edge.weight;
    } else {
      result.edges.push_back(edge);
    }
  }
  return result;
}

}  // namespace storey::detail
