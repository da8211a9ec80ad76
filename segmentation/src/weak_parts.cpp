// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/segmentation/detail/weak_parts.h>

#include <algorithm>
#include <iterator>

namespace storey::detail {
namespace {

// Support of a component: area of its walls that points confirm.
double supportOf(const FloorplanComponent& component) {
  double seen = 0.0;
  const auto add = [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring.edges[i].hypothetical) continue;
      seen += (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm();
    }
  };
  add(component.outer);
  for (const FloorplanRing& hole : component.holes) add(hole);
  return seen;
}

Eigen::Vector2d innerPoint(const PlanCell& cell) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : cell.corners) sum += corner;
  return sum / static_cast<double>(cell.corners.size());
}

}  // namespace

void dropWeakParts(const LineArrangement& plan, double keep, std::vector<FloorplanLayer>& layers) {
  struct Part {
    std::size_t layer;
    std::size_t component;
    double support;
  };
  std::vector<Part> parts;
  std::vector<std::vector<std::size_t>> cells_of;  // of each part
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const double height = layers[l].z_max - layers[l].z_min;
    for (std::size_t k = 0; k < layers[l].plan.components.size(); ++k) {
      const FloorplanComponent& component = layers[l].plan.components[k];
      parts.push_back({l, k, height * supportOf(component)});
      std::vector<std::size_t> cells;
      const Floorplan alone{{component}};
      for (std::size_t c = 0; c < plan.cells.size(); ++c) {
        if (contains(alone, innerPoint(plan.cells[c]))) cells.push_back(c);
      }
      cells_of.push_back(std::move(cells));
    }
  }
  UnionFind<> solids(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (parts[j].layer != parts[i].layer + 1) continue;
      std::vector<std::size_t> shared;
      std::set_intersection(cells_of[i].begin(), cells_of[i].end(), cells_of[j].begin(),
                            cells_of[j].end(), std::back_inserter(shared));
      if (!shared.empty()) solids.unite(i, j);
    }
  }
  std::vector<double> support(parts.size(), 0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) support[solids.find(i)] += parts[i].support;
  const double best = parts.empty() ? 0.0 : *std::max_element(support.begin(), support.end());
  std::vector<FloorplanLayer> kept;
  std::size_t i = 0;
  for (FloorplanLayer& layer : layers) {
    std::vector<FloorplanComponent> components;
    for (FloorplanComponent& component : layer.plan.components) {
      if (support[solids.find(i)] >= keep * best) components.push_back(std::move(component));
      ++i;
    }
    layer.plan.components = std::move(components);
    if (!layer.plan.empty()) kept.push_back(std::move(layer));
  }
  layers = std::move(kept);
}

}  // namespace storey::detail
