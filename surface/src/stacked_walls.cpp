// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/detail/plan_rings.h>
#include <storey/surface/detail/stacked_walls.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

struct Edge {
  std::size_t layer;
  Eigen::Vector2d from, to;
};

struct Stretches {
  const WallFit* fit;
  std::vector<Edge> edges;
};

// The walls that points were seen of.
std::map<int, Stretches> stretchesOf(const std::vector<FloorplanLayer>& layers,
                                     const std::map<int, WallFit>& fits) {
  std::map<int, Stretches> walls;
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    forEachRing(layers[layer].plan, [&](const FloorplanRing& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto fit = fits.find(ring.edges[i].wall);
        if (fit == fits.end() || fit->second.support == 0) continue;
        Stretches& wall = walls[fit->first];
        wall.fit = &fit->second;
        wall.edges.push_back({layer, ring.vertices[i], ring.vertices[(i + 1) % ring.size()]});
      }
    });
  }
  return walls;
}

bool areNear(const WallFit& line, const std::vector<Edge>& edges, double apart) {
  const auto isNear = [&](const Eigen::Vector2d& place) {
    return std::abs(line.normal.dot(place) - line.offset) < apart;
  };
  return std::all_of(edges.begin(), edges.end(),
                     [&](const Edge& edge) { return isNear(edge.from) && isNear(edge.to); });
}

// Whether all edges of the one with fewer points, whose direction is known less well, lie on the
// line of the other.
bool areOne(const Stretches& a, const Stretches& b, double apart) {
  if (!(a.fit->normal.dot(b.fit->normal) > 0.0)) return false;
  return a.fit->support < b.fit->support ? areNear(*b.fit, a.edges, apart)
                                         : areNear(*a.fit, b.edges, apart);
}

std::pair<double, double> rangeAlong(const Eigen::Vector2d& tangent, const Edge& edge) {
  return std::minmax(tangent.dot(edge.from), tangent.dot(edge.to));
}

bool doTouch(const Stretches& a, const Stretches& b) {
  const Eigen::Vector2d tangent(-a.fit->normal.y(), a.fit->normal.x());
  for (const Edge& p : a.edges) {
    const std::pair<double, double> one = rangeAlong(tangent, p);
    for (const Edge& q : b.edges) {
      const std::pair<double, double> other = rangeAlong(tangent, q);
      if (std::max(one.first, other.first) < std::min(one.second, other.second)) return true;
    }
  }
  return false;
}

}  // namespace

bool uniteStackedWalls(const std::map<int, WallFit>& fits, double apart,
                       std::vector<FloorplanLayer>& layers) {
  const std::map<int, Stretches> walls = stretchesOf(layers, fits);
  if (walls.empty()) return false;
  UnionFind<int> united(static_cast<std::size_t>(walls.rbegin()->first) + 1);
  for (auto a = walls.begin(); a != walls.end(); ++a) {
    for (auto b = std::next(a); b != walls.end(); ++b) {
      if (areOne(a->second, b->second, apart) && doTouch(a->second, b->second)) {
        united.unite(a->first, b->first);
      }
    }
  }
  bool any = false;
  for (FloorplanLayer& layer : layers) {
    forEachRing(layer.plan, [&](FloorplanRing& ring) {
      for (FloorplanEdge& edge : ring.edges) {
        if (walls.count(edge.wall) == 0) continue;
        any = any || united.find(edge.wall) != edge.wall;
        edge.wall = united.find(edge.wall);
      }
    });
  }
  return any;
}

}  // namespace storey::detail
