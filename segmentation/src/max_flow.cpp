// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/max_flow.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>

namespace storey {
namespace {

constexpr auto kFar = std::numeric_limits<std::int32_t>::max();

}  // namespace

MaxFlow::MaxFlow(std::size_t num_nodes) : nodes_(num_nodes) {}

void MaxFlow::addTerminalCapacities(std::size_t node, Capacity from_source, Capacity to_sink) {
  assert(node < nodes_.size() && from_source >= 0 && to_sink >= 0);
  Capacity& residual = nodes_[node].terminal;
  (residual > 0 ? from_source : to_sink) += std::abs(residual);
  flow_ += std::min(from_source, to_sink);  // straight through the node
  residual = from_source - to_sink;
  changed_.push_back(static_cast<Index>(node));
}

std::size_t MaxFlow::addEdge(std::size_t i, std::size_t j, Capacity capacity,
                             Capacity reverse_capacity) {
  assert(i < nodes_.size() && j < nodes_.size());
  addArc(i, j, 0);
  addArc(j, i, 0);
  const std::size_t edge = arcs_.size() / 2 - 1;
  if (i != j) raiseEdge(edge, capacity, reverse_capacity);  // an edge to itself is never cut
  return edge;
}

void MaxFlow::raiseEdge(std::size_t edge, Capacity capacity, Capacity reverse_capacity) {
  assert(2 * edge + 1 < arcs_.size() && capacity >= 0 && reverse_capacity >= 0);
  const auto a = static_cast<Index>(2 * edge);
  raiseArc(a, capacity);
  raiseArc(a ^ 1, reverse_capacity);
}

void MaxFlow::raiseArc(Index index, Capacity more) {
  arc(index).residual += more;
  const Index tail = arc(index ^ 1).head;
  if (more > 0 && at(tail).tree != Tree::kFree) activate(tail);
  const Index head = arc(index).head;  // of the sink's tree, it may hold the tail now
  if (more > 0 && at(head).tree != Tree::kFree) activate(head);
}

void MaxFlow::addArc(std::size_t tail, std::size_t head, Capacity capacity) {
  arcs_.push_back({capacity, static_cast<Index>(head), nodes_[tail].first});
  nodes_[tail].first = static_cast<Index>(arcs_.size() - 1);
}

void MaxFlow::add(const MaxFlow& other) {
  assert(nodes_.size() == other.nodes_.size() && arcs_.size() == other.arcs_.size());
  flow_ += other.flow_;
  for (std::size_t a = 0; a < arcs_.size(); ++a) arcs_[a].residual += other.arcs_[a].residual;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Capacity more = other.nodes_[n].terminal;
    addTerminalCapacities(n, std::max<Capacity>(more, 0), std::max<Capacity>(-more, 0));
    if (nodes_[n].tree != Tree::kFree) activate(static_cast<Index>(n));
  }
}

MaxFlow::Capacity MaxFlow::solve() {
  ++time_;
  for (const Index node : changed_) plant(node);
  changed_.clear();
  adoptAll();
  for (std::size_t next = 0; next < active_.size(); ++next) {
    const Index node = active_[next];
    at(node).active = false;
    // The path found may leave the node in its tree, with arcs not looked at yet.
    for (Index middle = grow(node); middle != kNone; middle = grow(node)) augment(middle);
  }
  active_.clear();
  return flow_;
}

// A node that a terminal can still reach by itself is the root of a tree, and one that it cannot
// is none.
void MaxFlow::plant(Index node) {
  Node& own = at(node);
  if (own.terminal == 0) {
    if (own.parent == kTerminal) orphan(node);
    return;
  }
  const Tree tree = own.terminal > 0 ? Tree::kSource : Tree::kSink;
  if (own.tree != tree && own.tree != Tree::kFree) abandon(node);
  own.tree = tree;
  own.parent = kTerminal;
  own.distance = 1;
  own.time = time_;
  activate(node);
}

void MaxFlow::activate(Index node) {
  if (at(node).active) return;
  at(node).active = true;
  active_.push_back(node);
}

// Takes free neighbours of the node into its tree.
// \return the arc from the source's tree to the sink's, if it meets the other tree
MaxFlow::Index MaxFlow::grow(Index node) {
  const Node& own = at(node);
  if (own.tree == Tree::kFree) return kNone;
  for (Index a = own.first; a != kNone; a = arc(a).next) {
    if (outwards(a, own.tree) == 0) continue;
    Node& other = at(arc(a).head);
    if (other.tree == Tree::kFree) {
      other.tree = own.tree;
      other.parent = a ^ 1;
      other.distance = own.distance + 1;
      other.time = own.time;
      activate(arc(a).head);
    } else if (other.tree != own.tree) {
      return own.tree == Tree::kSource ? a : a ^ 1;
    } else if (other.time <= own.time && other.distance > own.distance + 1) {
      other.parent = a ^ 1;  // a shorter way to the terminal
      other.distance = own.distance + 1;
      other.time = own.time;
    }
  }
  return kNone;
}

// Sends as much flow as fits along the path of both trees through the arc, and mends the trees.
void MaxFlow::augment(Index middle) {
  const Capacity flow = narrowest(middle);
  flow_ += flow;
  ++time_;
  arc(middle).residual -= flow;
  arc(middle ^ 1).residual += flow;
  push(arc(middle ^ 1).head, 1, flow);
  push(arc(middle).head, 0, flow);
  adoptAll();
}

void MaxFlow::adoptAll() {
  while (!orphans_.empty()) {
    const Index node = orphans_.back();
    orphans_.pop_back();
    if (at(node).parent == kNone) adopt(node);  // or else it was planted meanwhile
  }
}

MaxFlow::Capacity MaxFlow::narrowest(Index middle) const {
  Capacity least = arc(middle).residual;
  for (const Index end : {middle ^ 1, middle}) {  // towards the source, towards the sink
    Index node = arc(end).head;
    for (Index up = at(node).parent; up != kTerminal; up = at(node).parent) {
      least = std::min(least, arc(end == middle ? up : up ^ 1).residual);
      node = arc(up).head;
    }
    least = std::min(least, std::abs(at(node).terminal));
  }
  return least;
}

// Sends flow between the node and its terminal. \param reverse 1: it comes from the parent, that
// is, from the source; 0: it goes there
void MaxFlow::push(Index node, Index reverse, Capacity flow) {
  for (Index up = at(node).parent; up != kTerminal; up = at(node).parent) {
    const Index used = up ^ reverse;
    arc(used).residual -= flow;
    arc(used ^ 1).residual += flow;
    if (arc(used).residual == 0) orphan(node);
    node = arc(up).head;
  }
  Capacity& terminal = at(node).terminal;
  terminal += reverse != 0 ? -flow : flow;
  if (terminal == 0) orphan(node);
}

void MaxFlow::orphan(Index node) {
  at(node).parent = kNone;
  orphans_.push_back(node);
}

// Finds the orphan the nearest new parent in its tree, or sets it free.
void MaxFlow::adopt(Index node) {
  Node& own = at(node);
  Index nearest = kFar;
  Index parent = kNone;
  for (Index a = own.first; a != kNone; a = arc(a).next) {
    if (at(arc(a).head).tree != own.tree || outwards(a ^ 1, own.tree) == 0) continue;
    const Index distance = rootDistance(arc(a).head);
    if (distance >= nearest) continue;
    nearest = distance;
    parent = a;
  }
  if (parent == kNone) {
    abandon(node);
    return;
  }
  own.parent = parent;
  own.distance = nearest + 1;
  own.time = time_;
}

// Takes the node out of its tree. Its children become orphans, and its neighbours there look at it
// again.
void MaxFlow::abandon(Index node) {
  Node& own = at(node);
  for (Index a = own.first; a != kNone; a = arc(a).next) {
    const Index other = arc(a).head;
    if (at(other).tree != own.tree) continue;
    if (outwards(a ^ 1, own.tree) != 0) activate(other);
    if (at(other).parent == (a ^ 1)) orphan(other);
  }
  own.tree = Tree::kFree;
}

// Number of arcs from the node to its terminal, marked on the way so that no way is walked twice
// between two augmentations; far if it ends at an orphan.
MaxFlow::Index MaxFlow::rootDistance(Index node) {
  Index steps = 0;
  Index end = node;
  while (at(end).time != time_ && at(end).parent != kTerminal) {
    if (at(end).parent == kNone) return kFar;
    end = arc(at(end).parent).head;
    ++steps;
  }
  const Index distance = steps + (at(end).time == time_ ? at(end).distance : 1);
  Index left = distance;
  for (Index v = node;; v = arc(at(v).parent).head) {
    at(v).time = time_;
    at(v).distance = left--;
    if (v == end) return distance;
  }
}

}  // namespace storey
