// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cassert>
#include <utility>

namespace storey {
namespace {

using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
using Arc = Graph::edge_descriptor;
using Vertex = Graph::vertex_descriptor;

// The arcs of the graph in the order of their start, each with its reverse.
class ArcTable {
 public:
  explicit ArcTable(std::size_t num_vertices) : num_vertices_(num_vertices) {}

  void add(Vertex from, Vertex to, MaxFlow::Capacity capacity, MaxFlow::Capacity reverse) {
    added_.push_back({from, to, capacity});
    added_.push_back({to, from, reverse});  // the reverse of arc 2i is 2i + 1
  }

  Graph build() {
    std::vector<std::size_t> next(num_vertices_ + 1, 0);
    for (const Added& arc : added_) {
      ++next[arc.from + 1];
    }
    for (std::size_t v = 0; v < num_vertices_; ++v) {
      next[v + 1] += next[v];
    }
    std::vector<std::size_t> place(added_.size());
    for (std::size_t a = 0; a < added_.size(); ++a) {
      place[a] = next[added_[a].from]++;
    }
    std::vector<std::pair<Vertex, Vertex>> ends(added_.size());
    capacity_.resize(added_.size());
    reverse_.resize(added_.size());
    for (std::size_t a = 0; a < added_.size(); ++a) {
      ends[place[a]] = {added_[a].from, added_[a].to};
      capacity_[place[a]] = added_[a].capacity;
      reverse_[place[a]] = Arc(added_[a].to, place[a ^ 1U]);
    }
    return Graph(boost::edges_are_sorted, ends.begin(), ends.end(), num_vertices_);
  }

  const std::vector<MaxFlow::Capacity>& capacities() const { return capacity_; }
  const std::vector<Arc>& reverses() const { return reverse_; }

 private:
  struct Added {
    Vertex from;
    Vertex to;
    MaxFlow::Capacity capacity;
  };
  std::size_t num_vertices_;
  std::vector<Added> added_;
  std::vector<MaxFlow::Capacity> capacity_;
  std::vector<Arc> reverse_;
};

}  // namespace

MaxFlow::MaxFlow(std::size_t num_nodes)
    : from_source_(num_nodes, 0), to_sink_(num_nodes, 0), in_source_side_(num_nodes, false) {}

void MaxFlow::addTerminalCapacities(std::size_t node, Capacity from_source, Capacity to_sink) {
  assert(node < from_source_.size() && from_source >= 0 && to_sink >= 0);
  from_source_[node] += from_source;
  to_sink_[node] += to_sink;
}

void MaxFlow::addEdge(std::size_t i, std::size_t j, Capacity capacity, Capacity reverse_capacity) {
  assert(i < from_source_.size() && j < from_source_.size());
  assert(capacity >= 0 && reverse_capacity >= 0);
  if (i != j) {
    edges_.push_back({i, j, capacity, reverse_capacity});
  }
}

MaxFlow::Capacity MaxFlow::solve() {
  const std::size_t num_nodes = from_source_.size();
  const Vertex source = num_nodes;
  const Vertex sink = num_nodes + 1;
  ArcTable arcs(num_nodes + 2);
  Capacity direct_flow = 0;  // straight through a node; then only one terminal is left to it
  for (std::size_t v = 0; v < num_nodes; ++v) {
    const Capacity direct = std::min(from_source_[v], to_sink_[v]);
    direct_flow += direct;
    if (from_source_[v] > direct) {
      arcs.add(source, v, from_source_[v] - direct, 0);
    } else if (to_sink_[v] > direct) {
      arcs.add(v, sink, to_sink_[v] - direct, 0);
    }
  }
  for (const Edge& edge : edges_) {
    arcs.add(edge.from, edge.to, edge.capacity, edge.reverse_capacity);
  }
  Graph graph = arcs.build();
  const auto arc_id = get(boost::edge_index, graph);
  const auto node_id = get(boost::vertex_index, graph);
  std::vector<Capacity> residual(arcs.capacities().size());
  std::vector<Arc> parent(num_nodes + 2);
  std::vector<boost::default_color_type> color(num_nodes + 2);
  std::vector<std::size_t> distance(num_nodes + 2);
  const Capacity flow = boost::boykov_kolmogorov_max_flow(
      graph, boost::make_iterator_property_map(arcs.capacities().begin(), arc_id),
      boost::make_iterator_property_map(residual.begin(), arc_id),
      boost::make_iterator_property_map(arcs.reverses().begin(), arc_id),
      boost::make_iterator_property_map(parent.begin(), node_id),
      boost::make_iterator_property_map(color.begin(), node_id),
      boost::make_iterator_property_map(distance.begin(), node_id), node_id, source, sink);
  for (std::size_t v = 0; v < num_nodes; ++v) {
    in_source_side_[v] = color[v] == boost::black_color;  // gray = free: with the sink
  }
  return direct_flow + flow;
}

}  // namespace storey
