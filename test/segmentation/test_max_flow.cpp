// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/edmonds_karp_max_flow.hpp>
#include <boost/range/iterator_range.hpp>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace {

using storey::MaxFlow;
using Capacity = MaxFlow::Capacity;

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

// A grid of the size of a plan, whose paths are long; capacities repeat, so that there are many
// minimum cuts.
class Grid {
 public:
  MaxFlow flow;

  Grid(std::size_t side, std::mt19937& random) : flow(side * side), terminal_(side * side, 0) {
    for (std::size_t v = 0; v < side * side; ++v) {
      if (v % side != 0) addEdge(v - 1, v, random);
      if (v >= side) addEdge(v - side, v, random);
    }
  }

  void addEdge(std::size_t i, std::size_t j, std::mt19937& random) {
    edges_.push_back({i, j, uniform(random, 0, 5), uniform(random, 0, 5)});
    flow.addEdge(i, j, edges_.back().capacity, edges_.back().reverse);
  }

  void addTerminals(std::size_t count, std::mt19937& random) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto last = static_cast<int>(terminal_.size()) - 1;
      const auto v = static_cast<std::size_t>(uniform(random, 0, last));
      const Capacity more = uniform(random, -20, 20);
      flow.addTerminalCapacities(v, std::max<Capacity>(more, 0), std::max<Capacity>(-more, 0));
      raiseTerminal(v, more);
    }
  }

  void add(const Grid& other) {
    flow.add(other.flow);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      edges_[e].capacity += other.edges_[e].capacity;
      edges_[e].reverse += other.edges_[e].reverse;
    }
    for (std::size_t v = 0; v < terminal_.size(); ++v) raiseTerminal(v, other.terminal_[v]);
    direct_ += other.direct_;
  }

  // By another method: the same flow, and the same nodes on the source's side.
  void check() {
    const auto [value, reached] = flowByBoost();
    EXPECT_EQ(flow.solve(), value + direct_);
    for (std::size_t v = 0; v < terminal_.size(); ++v) ASSERT_EQ(flow.inSourceSide(v), reached[v]);
  }

 private:
  struct Edge {
    std::size_t i, j;
    Capacity capacity, reverse;
  };

  void raiseTerminal(std::size_t v, Capacity more) {
    if (terminal_[v] * more < 0) direct_ += std::min(std::abs(terminal_[v]), std::abs(more));
    terminal_[v] += more;
  }

  std::pair<Capacity, std::vector<bool>> flowByBoost() const;

  std::vector<Edge> edges_;
  std::vector<Capacity> terminal_;  // > 0: from the source
  Capacity direct_ = 0;             // flow through one node alone
};

std::pair<Capacity, std::vector<bool>> Grid::flowByBoost() const {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::directedS, boost::no_property,
      boost::property<
          boost::edge_capacity_t, Capacity,
          boost::property<boost::edge_residual_capacity_t, Capacity,
                          boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;
  const std::size_t nodes = terminal_.size();
  Graph graph(nodes + 2);
  const auto add = [&graph](std::size_t i, std::size_t j, Capacity capacity, Capacity reverse) {
    const auto arc = boost::add_edge(i, j, capacity, graph).first;
    const auto back = boost::add_edge(j, i, reverse, graph).first;
    put(boost::edge_reverse, graph, arc, back);
    put(boost::edge_reverse, graph, back, arc);
  };
  for (const Edge& edge : edges_) add(edge.i, edge.j, edge.capacity, edge.reverse);
  for (std::size_t v = 0; v < nodes; ++v) {
    if (terminal_[v] > 0) add(nodes, v, terminal_[v], 0);
    if (terminal_[v] < 0) add(v, nodes + 1, -terminal_[v], 0);
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
    Grid grid(side, random);
    for (int step = 0; step < 4; ++step) {
      grid.addTerminals(nodes / 2, random);
      const auto i = static_cast<std::size_t>(uniform(random, 0, static_cast<int>(nodes) - 1));
      grid.addEdge(i, (i * 7 + 3) % nodes, random);
      grid.check();
    }
  }
}

TEST(MaxFlow, ASumOfNetworksContinuesFromTheFlowsThroughBoth) {
  std::mt19937 random(10);
  for (int round = 0; round < 40; ++round) {
    const auto side = static_cast<std::size_t>(uniform(random, 2, 24));
    Grid sum(side, random);
    for (int step = 0; step < 5; ++step) {
      Grid other(side, random);
      other.addTerminals(side * side, random);
      if (step != 3) other.flow.solve();
      sum.add(other);
      if (step != 1) sum.check();
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

}  // namespace
