// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/slab_labels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace storey {
namespace detail {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Noding moves a piece of an edge by less than one unit in x and in y.
constexpr double kSourceDistance = 1.5;   // grid units
constexpr std::int64_t kSliverStrip = 2;  // grid units, as for planar walls

// Cells by ascending y of their interior points, for a sweep along x.
std::vector<int> sortByY(const PlanArrangement& plan) {
  std::vector<int> order(plan.interior.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(plan.interior[at(a)].y(), a) <
           std::make_pair(plan.interior[at(b)].y(), b);
  });
  return order;
}

// Flips the cells from whose interior point a ray to +x crosses the edge.
void flipLeftOf(const GridEdge& edge, const PlanArrangement& plan, const std::vector<int>& by_y,
                std::vector<char>& inside) {
  const bool upwards = edge.a.y < edge.b.y;
  const GridPoint& low = upwards ? edge.a : edge.b;
  const GridPoint& high = upwards ? edge.b : edge.a;
  const auto y_of = [&](int cell, std::int64_t y) {
    return plan.interior[at(cell)].y() <= static_cast<double>(y);
  };
  auto it = std::lower_bound(by_y.begin(), by_y.end(), low.y, y_of);
  const auto end = std::lower_bound(it, by_y.end(), high.y, y_of);
  const Eigen::Vector2d from(static_cast<double>(low.x), static_cast<double>(low.y));
  const Eigen::Vector2d along(static_cast<double>(high.x - low.x),
                              static_cast<double>(high.y - low.y));
  for (; it != end; ++it) {
    const Eigen::Vector2d p = plan.interior[at(*it)] - from;
    if (along.x() * p.y() - along.y() * p.x() > 0.0) inside[at(*it)] ^= 1;
  }
}

// Squared distance of a point to the edge's line, twice the coordinates; infinite beyond its ends.
double distanceToPiece(const GridPoint& u, const GridPoint& v, const GridEdge& edge) {
  const GridPoint d = edge.b - edge.a;
  const double length = std::sqrt(static_cast<double>(dot(d, d)));
  double distance = 0.0;
  for (const GridPoint& p : {u, v}) {
    const double along = static_cast<double>(dot(d, p - edge.a)) / length;
    if (along < -kSourceDistance || along > length + kSourceDistance) {
      return std::numeric_limits<double>::infinity();
    }
    distance += std::abs(static_cast<double>(orient(edge.a, edge.b, p))) / length;
  }
  return distance;
}

class SourceFinder {
 public:
  explicit SourceFinder(const std::vector<GridEdge>& edges) : edges_(edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) by_ends_.push_back(i);
    std::sort(by_ends_.begin(), by_ends_.end(),
              [&](std::size_t a, std::size_t b) { return key(edges_[a]) < key(edges_[b]); });
  }

  // The edge that runs from u to v or back; the nearest if noding has moved it.
  const GridEdge* find(const GridPoint& u, const GridPoint& v) const {
    const std::pair<GridPoint, GridPoint> ends = std::minmax(u, v);
    const auto it = std::lower_bound(by_ends_.begin(), by_ends_.end(), ends,
                                     [&](std::size_t i, const std::pair<GridPoint, GridPoint>& k) {
                                       return key(edges_[i]) < k;
                                     });
    if (it != by_ends_.end() && key(edges_[*it]) == ends) return &edges_[*it];
    const GridEdge* nearest = nullptr;
    double smallest = 2.0 * kSourceDistance;
    for (const std::size_t i : by_ends_) {
      if (key(edges_[i]).first.x > std::max(u.x, v.x) + 2) break;  // ascending x
      const double distance = distanceToPiece(u, v, edges_[i]);
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = &edges_[i];
    }
    return nearest;
  }

 private:
  static std::pair<GridPoint, GridPoint> key(const GridEdge& edge) {
    return std::minmax(edge.a, edge.b);
  }

  const std::vector<GridEdge>& edges_;
  std::vector<std::size_t> by_ends_;
};

// A cell that is a strip no wider than the noise of the lattice goes with the neighbour that it has
// the longest border with, in all slabs: no cap that is thinner than its wall is flat.
class SliverMerger {
 public:
  SliverMerger(const PlanArrangement& plan, SlabLabels& labels) : plan_(plan), labels_(labels) {}

  void merge() {
    std::vector<std::vector<int>> sides(plan_.interior.size());
    for (int h = 0; h < static_cast<int>(plan_.cell.size()); ++h) {
      if (plan_.cell[at(h)] >= 0) sides[at(plan_.cell[at(h)])].push_back(h);
    }
    is_sliver_.assign(sides.size(), 0);
    std::vector<int> open;
    for (std::size_t c = 0; c < sides.size(); ++c) {
      std::vector<GridPoint> corners;
      for (const int h : sides[c]) corners.push_back(plan_.from(h));
      is_sliver_[c] = withinStrip(corners, kSliverStrip);
      if (is_sliver_[c] != 0) open.push_back(static_cast<int>(c));
    }
    // From the outside of a cluster of slivers inwards.
    while (!open.empty()) {
      std::vector<int> left;
      for (const int c : open) {
        if (!join(c, sides[at(c)])) left.push_back(c);
      }
      if (left.size() == open.size()) break;
      open = std::move(left);
    }
  }

 private:
  bool join(int cell, const std::vector<int>& sides) {
    std::map<int, double> border;  // neighbour -> length
    for (const int h : sides) {
      const int neighbour = plan_.cell[at(h ^ 1)];
      if (neighbour >= 0 && is_sliver_[at(neighbour)] != 0) continue;
      const GridPoint d = plan_.to(h) - plan_.from(h);
      border[neighbour] += std::sqrt(static_cast<double>(dot(d, d)));
    }
    if (border.empty()) return false;
    const auto longest =
        std::max_element(border.begin(), border.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    for (int k = 0; k < labels_.numSlabs(); ++k) {
      labels_.inside[at(k)][at(cell)] = labels_.solid(longest->first, k) ? 1 : 0;
    }
    is_sliver_[at(cell)] = 0;
    return true;
  }

  const PlanArrangement& plan_;
  SlabLabels& labels_;
  std::vector<char> is_sliver_;
};

int levelIndex(const std::vector<std::int64_t>& levels, std::int64_t z) {
  return static_cast<int>(std::lower_bound(levels.begin(), levels.end(), z) - levels.begin());
}

}  // namespace

std::vector<std::int64_t> collectLevels(const std::vector<GridLayer>& layers) {
  std::vector<std::int64_t> levels;
  for (const GridLayer& layer : layers) {
    levels.push_back(layer.z_min);
    levels.push_back(layer.z_max);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

SlabLabels labelCells(const PlanArrangement& plan, const std::vector<GridLayer>& layers) {
  SlabLabels labels;
  labels.levels = collectLevels(layers);
  labels.inside.assign(labels.levels.size() - 1, std::vector<char>(plan.interior.size(), 0));
  const std::vector<int> by_y = sortByY(plan);
  for (const GridLayer& layer : layers) {
    std::vector<char> inside(plan.interior.size(), 0);
    for (const GridEdge& edge : layer.edges) flipLeftOf(edge, plan, by_y, inside);
    const int last = levelIndex(labels.levels, layer.z_max);
    for (int k = levelIndex(labels.levels, layer.z_min); k < last; ++k) {
      for (std::size_t c = 0; c < inside.size(); ++c) labels.inside[at(k)][c] |= inside[c];
    }
  }
  SliverMerger(plan, labels).merge();
  return labels;
}

std::vector<FloorplanEdge> findSources(const PlanArrangement& plan, const SlabLabels& labels,
                                       const BoundaryComplex& boundary,
                                       const std::vector<GridLayer>& layers) {
  std::vector<std::vector<int>> walls(labels.inside.size());  // slab -> its walls
  for (std::size_t i = 0; i < boundary.elements.size(); ++i) {
    const Element& element = boundary.elements[i];
    if (element.kind == ElementKind::Wall) walls[at(element.z)].push_back(static_cast<int>(i));
  }
  std::vector<FloorplanEdge> sources(boundary.elements.size());
  std::vector<char> known(boundary.elements.size(), 0);
  for (const GridLayer& layer : layers) {
    const SourceFinder finder(layer.edges);
    const int last = levelIndex(labels.levels, layer.z_max);
    for (int k = levelIndex(labels.levels, layer.z_min); k < last; ++k) {
      for (const int wall : walls[at(k)]) {
        if (known[at(wall)] != 0) continue;
        const int h = boundary.elements[at(wall)].plan;
        const GridEdge* edge = finder.find(plan.from(h), plan.to(h));
        if (edge == nullptr) continue;
        sources[at(wall)] = edge->source;
        known[at(wall)] = 1;
      }
    }
  }
  return sources;
}

}  // namespace detail
}  // namespace storey
