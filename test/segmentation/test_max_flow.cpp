// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/detail/alpha_expansion.h>
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/edmonds_karp_max_flow.hpp>
#include <boost/range/iterator_range.hpp>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace {

using storey::MaxFlow;
using storey::detail::PottsEdge;
using storey::detail::PottsProblem;
using Capacity = MaxFlow::Capacity;
using Labels = std::vector<std::size_t>;

int uniform(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

// A graph as a table, whose cuts can be priced one by one.
struct SmallGraph {
  std::size_t n;
  std::vector<Capacity> from_source, to_sink;
  std::vector<std::vector<Capacity>> arc;

  Capacity cutOf(const std::vector<bool>& in_source) const {
    Capacity sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += in_source[i] ? to_sink[i] : from_source[i];
      for (std::size_t j = 0; j < n; ++j) {
        sum += in_source[i] && !in_source[j] ? arc[i][j] : 0;
      }
    }
    return sum;
  }

  Capacity minCut() const {
    Capacity least = std::numeric_limits<Capacity>::max();
    for (unsigned int subset = 0; subset < 1U << n; ++subset) {
      std::vector<bool> in_source(n);
      for (std::size_t i = 0; i < n; ++i) {
        in_source[i] = (subset >> i & 1U) != 0;
      }
      least = std::min(least, cutOf(in_source));
    }
    return least;
  }
};

SmallGraph randomGraph(std::mt19937& random) {
  SmallGraph graph;
  graph.n = static_cast<std::size_t>(uniform(random, 1, 9));
  graph.arc.assign(graph.n, std::vector<Capacity>(graph.n, 0));
  for (std::size_t i = 0; i < graph.n; ++i) {
    // zero terminals and terminals of equal capacity are the corner cases of the method
    graph.from_source.push_back(std::max(0, uniform(random, -3, 6)));
    graph.to_sink.push_back(std::max(0, uniform(random, -3, 6)));
    for (std::size_t j = 0; j < graph.n; ++j) {
      graph.arc[i][j] = i == j ? 0 : std::max(0, uniform(random, -4, 5));
    }
  }
  return graph;
}

struct GridEdge {
  std::size_t i, j;
  Capacity capacity, reverse;
};

TEST(MaxFlow, EqualsTheCheapestOfAllCuts) {
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    const SmallGraph graph = randomGraph(random);
    MaxFlow flow(graph.n);
    for (std::size_t i = 0; i < graph.n; ++i) {
      flow.addTerminalCapacities(i, graph.from_source[i], graph.to_sink[i]);
      for (std::size_t j = i + 1; j < graph.n; ++j) {
        flow.addEdge(i, j, graph.arc[i][j], graph.arc[j][i]);
      }
    }
    const Capacity value = flow.solve();
    std::vector<bool> in_source(graph.n);
    for (std::size_t i = 0; i < graph.n; ++i) {
      in_source[i] = flow.inSourceSide(i);
    }
    EXPECT_EQ(value, graph.minCut());
    EXPECT_EQ(value, graph.cutOf(in_source));
  }
}

// Boost's flow over a grid of the size of a plan, whose paths are long; capacities repeat, so that
// there are many minimum cuts.
std::pair<Capacity, std::vector<bool>> flowByBoost(std::size_t nodes,
                                                   const std::vector<GridEdge>& edges,
                                                   const std::vector<Capacity>& terminal) {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::directedS, boost::no_property,
      boost::property<
          boost::edge_capacity_t, Capacity,
          boost::property<boost::edge_residual_capacity_t, Capacity,
                          boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;
  Graph graph(nodes + 2);
  const auto add = [&graph](std::size_t i, std::size_t j, Capacity capacity, Capacity reverse) {
    const auto arc = boost::add_edge(i, j, capacity, graph).first;
    const auto back = boost::add_edge(j, i, reverse, graph).first;
    put(boost::edge_reverse, graph, arc, back);
    put(boost::edge_reverse, graph, back, arc);
  };
  for (const GridEdge& edge : edges) add(edge.i, edge.j, edge.capacity, edge.reverse);
  for (std::size_t v = 0; v < nodes; ++v) {
    if (terminal[v] > 0) add(nodes, v, terminal[v], 0);
    if (terminal[v] < 0) add(v, nodes + 1, -terminal[v], 0);
  }
  const Capacity value = boost::edmonds_karp_max_flow(graph, nodes, nodes + 1);
  std::vector<bool> reached(nodes + 2, false);  // from the source: the smallest minimum cut
  std::vector<std::size_t> open = {nodes};
  reached[nodes] = true;
  while (!open.empty()) {
    const std::size_t v = open.back();
    open.pop_back();
    for (const auto& arc : boost::make_iterator_range(out_edges(v, graph))) {
      if (get(boost::edge_residual_capacity, graph, arc) == 0 || reached[target(arc, graph)]) {
        continue;
      }
      reached[target(arc, graph)] = true;
      open.push_back(target(arc, graph));
    }
  }
  return {value, reached};
}

TEST(MaxFlow, EqualsEdmondsKarpOnGridsAndContinuesWhenCapacitiesRise) {
  std::mt19937 random(9);
  for (int round = 0; round < 40; ++round) {
    const auto side = static_cast<std::size_t>(uniform(random, 2, 24));
    const std::size_t nodes = side * side;
    MaxFlow flow(nodes);
    std::vector<GridEdge> edges;
    std::vector<Capacity> terminal(nodes, 0);
    const auto addEdge = [&](std::size_t i, std::size_t j) {
      edges.push_back({i, j, uniform(random, 0, 5), uniform(random, 0, 5)});
      flow.addEdge(i, j, edges.back().capacity, edges.back().reverse);
    };
    for (std::size_t v = 0; v < nodes; ++v) {
      if (v % side != 0) addEdge(v - 1, v);
      if (v >= side) addEdge(v - side, v);
    }
    Capacity direct = 0;
    for (int step = 0; step < 4; ++step) {
      for (std::size_t k = 0; k < nodes / 2; ++k) {
        const auto v = static_cast<std::size_t>(uniform(random, 0, static_cast<int>(nodes) - 1));
        const Capacity more = uniform(random, -20, 20);
        flow.addTerminalCapacities(v, std::max<Capacity>(more, 0), std::max<Capacity>(-more, 0));
        if (terminal[v] * more < 0) direct += std::min(std::abs(terminal[v]), std::abs(more));
        terminal[v] += more;
      }
      const auto i = static_cast<std::size_t>(uniform(random, 0, static_cast<int>(nodes) - 1));
      addEdge(i, (i * 7 + 3) % nodes);
      const auto [value, reached] = flowByBoost(nodes, edges, terminal);
      EXPECT_EQ(flow.solve(), value + direct);
      for (std::size_t v = 0; v < nodes; ++v) ASSERT_EQ(flow.inSourceSide(v), reached[v]);
    }
  }
}

TEST(MaxFlow, RepeatedCapacitiesAddUp) {
  MaxFlow flow(2);  // source -(3+4)-> 0 -(2+3)-> 1 -(9)-> sink
  flow.addTerminalCapacities(0, 3, 0);
  flow.addTerminalCapacities(0, 4, 0);
  flow.addEdge(0, 1, 2, 0);
  flow.addEdge(1, 0, 0, 3);
  flow.addTerminalCapacities(1, 0, 9);
  EXPECT_EQ(flow.solve(), 5);
  EXPECT_TRUE(flow.inSourceSide(0));
  EXPECT_FALSE(flow.inSourceSide(1));
}

TEST(MaxFlow, NoNodesNoFlowAndFreeNodesGoWithTheSink) {
  EXPECT_EQ(MaxFlow(0).solve(), 0);
  MaxFlow isolated(1);
  EXPECT_EQ(isolated.solve(), 0);
  EXPECT_FALSE(isolated.inSourceSide(0));
}

TEST(MaxFlow, LargeCapacitiesAreExact) {
  const Capacity large = (Capacity{1} << 52) + 1;  // not a double's neighbour
  MaxFlow flow(2);
  flow.addTerminalCapacities(0, large, 1);
  flow.addEdge(0, 1, large, 0);
  flow.addTerminalCapacities(1, 0, large);
  EXPECT_EQ(flow.solve(), large);
}

PottsProblem randomProblem(std::mt19937& random, std::size_t nodes, std::size_t labels,
                           double weight) {
  std::uniform_real_distribution<double> real(0.0, 1.0);
  PottsProblem problem;
  problem.num_labels = labels;
  for (std::size_t i = 0; i < nodes * labels; ++i) {
    problem.data_costs.push_back(real(random));
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t j = i + 1; j < nodes; ++j) {
      if (real(random) < 0.5) {
        problem.edges.push_back({i, j, weight * real(random)});
      }
    }
  }
  return problem;
}

// Counts through all labellings.
double optimum(const PottsProblem& problem) {
  Labels labels(problem.numNodes(), 0);
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    least = std::min(least, pottsEnergy(problem, labels));
    std::size_t i = 0;
    while (i < labels.size() && ++labels[i] == problem.num_labels) {
      labels[i++] = 0;
    }
    if (i == labels.size()) {
      return least;
    }
  }
}

constexpr double kRounding = 1e-12;  // of the costs to integers, and of sums of doubles

TEST(AlphaExpansion, TwoLabelsReachTheOptimum) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const PottsProblem problem = randomProblem(random, 8, 2, 0.8);
    EXPECT_NEAR(pottsEnergy(problem, minimizePotts(problem)), optimum(problem), kRounding);
  }
}

TEST(AlphaExpansion, WithinTheBoundAndMostlyOptimal) {
  std::mt19937 random(3);
  int optimal = 0;
  for (int round = 0; round < 100; ++round) {
    const PottsProblem problem = randomProblem(random, 7, 4, 0.5);
    const double least = optimum(problem);
    const double energy = pottsEnergy(problem, minimizePotts(problem));
    EXPECT_GE(energy, least - kRounding);
    EXPECT_LE(energy, 2.0 * least + kRounding);
    optimal += energy <= least + kRounding ? 1 : 0;
  }
  EXPECT_GT(optimal, 50);  // an expansion that did nothing would leave the result of single nodes
}

TEST(AlphaExpansion, NoExpansionOfAnyLabelIsBetter) {
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round) {
    const PottsProblem problem = randomProblem(random, 10, 3, 0.6);
    const Labels labels = minimizePotts(problem);
    const double energy = pottsEnergy(problem, labels);
    for (std::size_t alpha = 0; alpha < 3; ++alpha) {
      for (unsigned int subset = 0; subset < 1U << 10; ++subset) {
        Labels expanded = labels;
        for (std::size_t i = 0; i < 10; ++i) {
          expanded[i] = (subset >> i & 1U) != 0 ? alpha : labels[i];
        }
        EXPECT_GE(pottsEnergy(problem, expanded), energy - kRounding);
      }
    }
  }
}

TEST(AlphaExpansion, NeverAboveTheNodesAlone) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    const PottsProblem problem = randomProblem(random, 60, 5, 0.1);
    Labels labels = cheapestLabels(problem);
    const double start = pottsEnergy(problem, labels);
    descendByNodes(problem, labels);
    const double descended = pottsEnergy(problem, labels);
    EXPECT_LE(descended, start + kRounding);
    EXPECT_LE(pottsEnergy(problem, minimizePotts(problem)), descended + kRounding);
  }
}

TEST(AlphaExpansion, MovingBoundariesNeverRaisesTheEnergy) {
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    const PottsProblem problem = randomProblem(random, 60, 5, 0.1);
    Labels labels(60);
    for (std::size_t& label : labels) {
      label = static_cast<std::size_t>(uniform(random, 0, 4));
    }
    double energy = pottsEnergy(problem, labels);
    for (const std::size_t reach : {0U, 1U, 2U, 60U}) {
      moveBoundaries(problem, reach, labels);
      EXPECT_LE(pottsEnergy(problem, labels), energy + kRounding);
      energy = pottsEnergy(problem, labels);
    }
  }
}

TEST(AlphaExpansion, ABoundaryMovesThroughNodesThatDoNotCare) {
  // a row of 8: the left end wants label 0, a weak link lies in the middle, and the boundary
  // starts at the right end, where single nodes gain nothing by a change
  PottsProblem problem;
  problem.num_labels = 2;
  problem.data_costs.assign(16, 0.0);
  problem.data_costs[1] = 9.0;   // node 0 pays 9 for label 1
  problem.data_costs[14] = 9.0;  // node 7 pays 9 for label 0
  for (std::size_t i = 0; i + 1 < 8; ++i) {
    problem.edges.push_back({i, i + 1, i == 3 ? 0.5 : 1.0});
  }
  Labels labels = {0, 0, 0, 0, 0, 0, 0, 1};
  descendByNodes(problem, labels);
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 0, 0, 0, 1}));
  moveBoundaries(problem, 2, labels);  // two nodes further there is nothing to gain
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 0, 0, 0, 1}));
  moveBoundaries(problem, 3, labels);
  EXPECT_EQ(labels, (Labels{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(AlphaExpansion, PermutedNodesOfAChainHaveTheSameEnergy) {
  // weights so small that the optimum is found whatever the order of visits
  std::mt19937 random(6);
  PottsProblem problem = randomProblem(random, 40, 4, 0.02);
  Labels place(40);
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::shuffle(place.begin(), place.end(), random);
  PottsProblem permuted = problem;
  for (std::size_t i = 0; i < 40; ++i) {
    std::copy_n(problem.data_costs.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                permuted.data_costs.begin() + static_cast<std::ptrdiff_t>(4 * place[i]));
  }
  for (PottsEdge& edge : permuted.edges) {
    edge.a = place[edge.a];
    edge.b = place[edge.b];
  }
  EXPECT_NEAR(pottsEnergy(problem, minimizePotts(problem)),
              pottsEnergy(permuted, minimizePotts(permuted)), 40 * kRounding);
}

TEST(AlphaExpansion, GroupsKeepTheEnergyOfTheirLabellings) {
  std::mt19937 random(7);
  const PottsProblem problem = randomProblem(random, 12, 3, 0.5);
  Labels group(12);
  for (std::size_t& g : group) {
    g = static_cast<std::size_t>(uniform(random, 0, 3));
  }
  const PottsProblem grouped = aggregatePotts(problem, group, 4);
  EXPECT_LE(grouped.edges.size(), 6U);  // pairs among four groups, each once
  for (int round = 0; round < 20; ++round) {
    Labels label_of_group(4);
    for (std::size_t& l : label_of_group) {
      l = static_cast<std::size_t>(uniform(random, 0, 2));
    }
    Labels labels;
    for (const std::size_t g : group) {
      labels.push_back(label_of_group[g]);
    }
    EXPECT_NEAR(pottsEnergy(grouped, label_of_group), pottsEnergy(problem, labels), kRounding);
  }
}

TEST(AlphaExpansion, NothingAndOneLabel) {
  EXPECT_TRUE(minimizePotts(PottsProblem()).empty());
  PottsProblem one;
  one.num_labels = 1;
  one.data_costs = {3.0, 4.0};
  one.edges = {{0, 1, 1.0}};
  EXPECT_EQ(minimizePotts(one), (Labels{0, 0}));
}

}  // namespace
