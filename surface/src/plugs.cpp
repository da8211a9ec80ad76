// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/plugs.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace detail {
namespace {

constexpr std::int64_t kLargestPlug = 256;     // grid units, half a diagonal
constexpr std::int64_t kSmallestPlug = 4;      // wider than a sliver
constexpr std::int64_t kExtentPerPlug = 4096;  // the building's extent in plugs

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Small against the building and the edges that end in the vertex.
std::int64_t plugRadius(const PlanArrangement& plan, int vertex) {
  const auto [low, high] = std::minmax_element(plan.vertices.begin(), plan.vertices.end());
  std::int64_t radius = std::min(kLargestPlug, (high->x - low->x) / kExtentPerPlug);
  for (const int h : plan.outgoing[at(vertex)]) {
    const GridPoint d = plan.to(h) - plan.from(h);
    const double length = std::sqrt(static_cast<double>(dot(d, d)));
    radius = std::min(radius, static_cast<std::int64_t>(length / 3.0));
  }
  return std::max(radius, kSmallestPlug);
}

// Counter-clockwise.
std::vector<GridPoint> convexHull(std::vector<GridPoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<GridPoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = hull.size();
    for (const GridPoint& p : points) {
      while (hull.size() >= begin + 2 && orient(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<Wide> cellAreas(const PlanArrangement& plan) {
  std::vector<Wide> areas(plan.interior.size(), 0);
  for (int h = 0; h < static_cast<int>(plan.cell.size()); ++h) {
    if (plan.cell[at(h)] >= 0) areas[at(plan.cell[at(h)])] += cross(plan.from(h), plan.to(h));
  }
  return areas;
}

// The cells that end in the contact: on both sides of an edge, all around a vertex.
std::vector<int> cellsAt(const PlanArrangement& plan, const Pinch& pinch) {
  std::vector<int> cells;
  for (const int h : plan.outgoing[at(pinch.a)]) {
    if (pinch.a == pinch.b) cells.push_back(plan.cell[at(h)]);
    if (plan.target(h) == pinch.b) {
      cells.insert(cells.end(), {plan.cell[at(h)], plan.cell[at(h ^ 1)]});
    }
  }
  return cells;
}

}  // namespace

void Plugger::plug(const PlanArrangement& plan, const SlabLabels& labels,
                   const std::vector<Pinch>& pinches, std::vector<GridLayer>& layers) {
  for (const Pinch& pinch : pinches) {
    GridLayer plug;
    plug.z_min = labels.levels[at(pinch.slab)];
    plug.z_max = labels.levels[at(pinch.slab) + 1];
    const std::vector<GridPoint> hull = convexHull(diamonds(plan, pinch));
    for (std::size_t i = 0; i < hull.size(); ++i) {
      plug.edges.push_back({hull[i], hull[(i + 1) % hull.size()], {-1, true}});
    }
    layers.push_back(std::move(plug));
  }
}

std::vector<GridPoint> Plugger::diamonds(const PlanArrangement& plan, const Pinch& pinch) {
  std::vector<GridPoint> corners;
  for (const int v : {pinch.a, pinch.b}) {
    const GridPoint& p = plan.vertices[at(v)];
    // The first plug shortens the edges: later ones in the same place must have its size.
    const std::int64_t r = radii_.emplace(p, plugRadius(plan, v)).first->second;
    corners.insert(corners.end(), {{p.x + r, p.y}, {p.x, p.y + r}, {p.x - r, p.y}, {p.x, p.y - r}});
  }
  return corners;
}

void fillCells(const PlanArrangement& plan, const std::vector<Pinch>& pinches, SlabLabels& labels) {
  const std::vector<Wide> areas = cellAreas(plan);
  for (const Pinch& pinch : pinches) {
    int smallest = -1;
    int slab = -1;
    // At an edge or a point between two slabs the one below will do as well.
    for (const int k : {pinch.slab, pinch.slab - 1}) {
      for (const int cell : cellsAt(plan, pinch)) {
        if (cell < 0 || k < 0 || labels.solid(cell, k)) continue;
        if (smallest >= 0 && areas[at(cell)] >= areas[at(smallest)]) continue;
        smallest = cell;
        slab = k;
      }
      if (pinch.upright) break;
    }
    if (smallest >= 0) labels.inside[at(slab)][at(smallest)] = 1;
  }
}

}  // namespace detail
}  // namespace storey
