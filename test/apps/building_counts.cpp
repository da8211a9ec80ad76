// SPDX-License-Identifier: BSD-3-Clause
#include "apps/building_counts.h"

#include <geos_c.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace {

using Eigen::Vector2d;
using storey::FloorplanComponent;
using storey::FloorplanLayer;
using storey::FloorplanRing;

constexpr double kGrid = 1e-6;    // GEOS nodes on it: collinear walls leave no slivers
constexpr double kSliver = 1e-3;  // smaller areas are rounding

GEOSContextHandle_t geos() {
  static const std::unique_ptr<GEOSContextHandle_HS, void (*)(GEOSContextHandle_t)> kHandle(
      GEOS_init_r(), GEOS_finish_r);
  return kHandle.get();
}

struct Destroy {
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(geos(), geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

GEOSGeometry* toRing(const FloorplanRing& ring) {
  const auto n = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* points = GEOSCoordSeq_create_r(geos(), n + 1, 2);
  for (unsigned i = 0; i <= n; ++i) {
    GEOSCoordSeq_setXY_r(geos(), points, i, ring.vertices[i % n].x(), ring.vertices[i % n].y());
  }
  return GEOSGeom_createLinearRing_r(geos(), points);
}

Geometry toPolygon(const FloorplanComponent& component) {
  std::vector<GEOSGeometry*> holes;
  for (const FloorplanRing& hole : component.holes) {
    holes.push_back(toRing(hole));
  }
  return Geometry(GEOSGeom_createPolygon_r(geos(), toRing(component.outer), holes.data(),
                                           static_cast<unsigned>(holes.size())));
}

Geometry toMultiPolygon(const storey::Floorplan& plan) {
  std::vector<GEOSGeometry*> parts;
  for (const FloorplanComponent& component : plan.components) {
    parts.push_back(toPolygon(component).release());
  }
  return Geometry(GEOSGeom_createCollection_r(geos(), GEOS_MULTIPOLYGON, parts.data(),
                                              static_cast<unsigned>(parts.size())));
}

double areaOf(const GEOSGeometry* geometry) {
  double area = 0.0;
  GEOSArea_r(geos(), geometry, &area);
  return area;
}

/// Connected parts of a \ b.
std::size_t countParts(const storey::Floorplan& a, const storey::Floorplan& b) {
  const Geometry first = toMultiPolygon(a);
  const Geometry second = toMultiPolygon(b);
  const Geometry rest(GEOSDifferencePrec_r(geos(), first.get(), second.get(), kGrid));
  std::size_t count = 0;
  for (int i = 0; i < GEOSGetNumGeometries_r(geos(), rest.get()); ++i) {
    count += areaOf(GEOSGetGeometryN_r(geos(), rest.get(), i)) > kSliver ? 1 : 0;
  }
  return count;
}

/// A wall of one layer in the frame of its plane.
struct Stretch {
  double start, end;
  std::size_t layer;
};

template <typename Use>
void forEachEdge(const FloorplanLayer& layer, const Use& use) {
  const auto walk = [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      use(ring.vertices[i], ring.vertices[(i + 1) % ring.size()], ring.edges[i].wall);
    }
  };
  for (const FloorplanComponent& component : layer.plan.components) {
    walk(component.outer);
    std::for_each(component.holes.begin(), component.holes.end(), walk);
  }
}

std::size_t countConnected(const std::vector<Stretch>& stretches) {
  std::vector<std::size_t> parent(stretches.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::size_t count = stretches.size();
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Stretch& a = stretches[i];
      const Stretch& b = stretches[j];
      const double overlap = std::min(a.end, b.end) - std::max(a.start, b.start);
      const bool stacked = a.layer == b.layer + 1 || b.layer == a.layer + 1;
      if (stacked && overlap > 1e-5 && root(i) != root(j)) {
        parent[root(i)] = root(j);
        --count;
      }
    }
  }
  return count;
}

}  // namespace

std::size_t countPolygons(const std::vector<FloorplanLayer>& layers) {
  std::map<int, Vector2d> directions;
  std::map<std::pair<int, bool>, std::vector<Stretch>> walls;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    forEachEdge(layers[i], [&](const Vector2d& from, const Vector2d& to, int wall) {
      const Vector2d along = directions.emplace(wall, (to - from).normalized()).first->second;
      const double start = along.dot(from);
      const double end = along.dot(to);
      walls[{wall, end > start}].push_back({std::min(start, end), std::max(start, end), i});
    });
  }
  std::size_t count = 0;
  for (const auto& [plane, stretches] : walls) {
    count += countConnected(stretches);
  }
  const storey::Floorplan nothing;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    count += countParts(layers[i].plan, i + 1 < layers.size() ? layers[i + 1].plan : nothing);
    count += countParts(layers[i].plan, i > 0 ? layers[i - 1].plan : nothing);
  }
  return count;
}

std::string whyInvalid(const std::vector<FloorplanLayer>& layers) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& components = layers[i].plan.components;
    if (layers[i].z_max <= layers[i].z_min || (i > 0 && layers[i].z_min != layers[i - 1].z_max)) {
      return "heights";
    }
    for (std::size_t j = 0; j < components.size(); ++j) {
      const Geometry polygon = toPolygon(components[j]);
      if (GEOSisValid_r(geos(), polygon.get()) != 1) {
        return "ring not simple or courtyard not inside";
      }
      bool senses = signedArea(components[j].outer) > 0.0;
      for (const FloorplanRing& hole : components[j].holes) {
        senses = senses && signedArea(hole) < 0.0;
      }
      if (!senses) {
        return "sense of a ring";
      }
      for (std::size_t k = 0; k < j; ++k) {
        double distance = 0.0;
        GEOSDistance_r(geos(), polygon.get(), toPolygon(components[k]).get(), &distance);
        if (distance < 1.0) {
          return "components too close";
        }
      }
      if (i > 0) {
        const Geometry below = toMultiPolygon(layers[i - 1].plan);
        const Geometry shared(GEOSIntersection_r(geos(), polygon.get(), below.get()));
        if (areaOf(shared.get()) < 1.0) {
          return "a component above nothing";
        }
      }
    }
  }
  return layers.empty() ? "no layer" : "";
}

double smallestPlaneDistance(const std::vector<FloorplanLayer>& layers) {
  struct Edge {
    Vector2d from, along;
    int wall;
  };
  std::vector<Edge> edges;
  for (const FloorplanLayer& layer : layers) {
    forEachEdge(layer, [&](const Vector2d& from, const Vector2d& to, int wall) {
      edges.push_back({from, (to - from).normalized(), wall});
    });
  }
  double smallest = INFINITY;
  for (const Edge& a : edges) {
    for (const Edge& b : edges) {
      const double sine = a.along.x() * b.along.y() - a.along.y() * b.along.x();
      if (a.wall != b.wall && std::abs(sine) < 1e-6) {
        const Vector2d normal(a.along.y(), -a.along.x());
        smallest = std::min(smallest, std::abs(normal.dot(b.from - a.from)));
      }
    }
  }
  return smallest;
}
