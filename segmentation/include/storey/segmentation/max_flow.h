// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey {

/// Maximum flow, and with it a minimum cut, between two terminals (the method of Boykov and
/// Kolmogorov). Capacities are integers, so that sums are exact and a result can be repeated; the
/// sum of all of them must fit into `Capacity`. Nodes are numbered 0 .. n-1; the terminals have no
/// numbers.
class MaxFlow {
 public:
  using Capacity = std::int64_t;

  explicit MaxFlow(std::size_t num_nodes);

  /// Adds to the capacities of the arcs source -> node and node -> sink (both >= 0). In terms of
  /// a cut: the node pays `from_source` when it is on the sink's side, `to_sink` otherwise.
  void addTerminalCapacities(std::size_t node, Capacity from_source, Capacity to_sink);

  /// Adds the arcs i -> j and j -> i (capacities >= 0). Repeated arcs add up. The cut pays
  /// `capacity` when i is on the source's side and j on the sink's, `reverse_capacity` the other
  /// way round.
  void addEdge(std::size_t i, std::size_t j, Capacity capacity, Capacity reverse_capacity);

  /// The value of the maximum flow = the capacity of the minimum cut.
  Capacity solve();

  /// Where the node is in the minimum cut that `solve` found. Among several minimum cuts that with
  /// the fewest nodes on the source's side.
  bool inSourceSide(std::size_t node) const { return in_source_side_[node]; }

 private:
  struct Edge {
    std::size_t from;
    std::size_t to;
    Capacity capacity;
    Capacity reverse_capacity;
  };
  std::vector<Edge> edges_;
  std::vector<Capacity> from_source_;
  std::vector<Capacity> to_sink_;
  std::vector<bool> in_source_side_;
};

}  // namespace storey
