// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey {

/// Maximum flow, and with it a minimum cut, between two terminals (the method of Boykov and
/// Kolmogorov). Capacities are integers, so that sums are exact and a result can be repeated; the
/// sum of all of them must fit into `Capacity`. Nodes are numbered 0 .. n-1; the terminals have no
/// numbers. Capacities may be added after `solve`, too: the next one continues from the flow and
/// the trees found, and looks only at what changed (Kohli and Torr). So does one after `add`: flows
/// through two networks are one through their sum.
class MaxFlow {
 public:
  using Capacity = std::int64_t;

  explicit MaxFlow(std::size_t num_nodes);

  /// Makes room for so many edges.
  void reserve(std::size_t num_edges) { arcs_.reserve(2 * num_edges); }

  /// Adds to the capacities of the arcs source -> node and node -> sink (both >= 0). In terms of
  /// a cut: the node pays `from_source` when it is on the sink's side, `to_sink` otherwise.
  void addTerminalCapacities(std::size_t node, Capacity from_source, Capacity to_sink);

  /// Adds the arcs i -> j and j -> i (capacities >= 0). Repeated arcs add up. The cut pays
  /// `capacity` when i is on the source's side and j on the sink's, `reverse_capacity` the other
  /// way round. \return the number of the edge: 0, 1, ... in the order in which they are added
  std::size_t addEdge(std::size_t i, std::size_t j, Capacity capacity, Capacity reverse_capacity);

  /// Adds to the capacities of an edge (both >= 0).
  void raiseEdge(std::size_t edge, Capacity capacity, Capacity reverse_capacity);

  /// Adds the capacities of a network with the same nodes and edges, and the flow found through it.
  void add(const MaxFlow& other);

  /// The value of the maximum flow = the capacity of the minimum cut.
  Capacity solve();

  /// Where the node is in the minimum cut that `solve` found. Among several minimum cuts that with
  /// the fewest nodes on the source's side.
  bool inSourceSide(std::size_t node) const { return nodes_[node].tree == Tree::kSource; }

 private:
  using Index = std::int32_t;
  static constexpr Index kNone = -1;  // no arc
  static constexpr Index kTerminal =
      -2;  // in place of the arc to the parent: child of the terminal

  enum class Tree : std::int8_t { kFree, kSource, kSink };

  struct Node {
    Capacity terminal = 0;  // residual, > 0: from the source, < 0: to the sink
    Index first = kNone;    // of its arcs
    Index parent = kNone;   // arc to the parent
    Index distance = 0;     // from the terminal, at most, as of the time below
    std::uint32_t time = 0;
    Tree tree = Tree::kFree;
    bool active = false;
  };
  struct Arc {
    Capacity residual;
    Index head;
    Index next;  // of the same tail
  };

  void addArc(std::size_t tail, std::size_t head, Capacity capacity);
  void raiseArc(Index index, Capacity more);
  void plant(Index node);
  void adoptAll();
  void activate(Index node);
  Index grow(Index node);
  void augment(Index middle);
  Capacity narrowest(Index middle) const;
  void push(Index node, Index towards, Capacity flow);
  void orphan(Index node);
  void adopt(Index node);
  void abandon(Index node);
  Index rootDistance(Index node);

  // Residual capacity between a node of a tree and the head of one of its arcs, in the direction
  // away from the source or towards the sink.
  Capacity outwards(Index arc, Tree tree) const {
    return arcs_[static_cast<std::size_t>(tree == Tree::kSource ? arc : arc ^ 1)].residual;
  }
  Node& at(Index node) { return nodes_[static_cast<std::size_t>(node)]; }
  const Node& at(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }
  Arc& arc(Index index) { return arcs_[static_cast<std::size_t>(index)]; }
  const Arc& arc(Index index) const { return arcs_[static_cast<std::size_t>(index)]; }

  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;       // the reverse of arc a is a ^ 1
  std::vector<Index> changed_;  // nodes whose terminal has changed
  std::vector<Index> active_;
  std::vector<Index> orphans_;
  std::uint32_t time_ = 0;  // number of augmentations
  Capacity flow_ = 0;
};

}  // namespace storey
