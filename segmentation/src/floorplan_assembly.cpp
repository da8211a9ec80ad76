// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <cmath>

#include "geos_polygon.h"

namespace storey::detail {
namespace {

// Of the extent: what the overlay's rounding may move a vertex by.
constexpr double kRounding = 1e-9;

struct SourceEdge {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  FloorplanEdge edge;
};

// The input, about an origin of its own: far coordinates would cost digits.
struct Sources {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double tolerance = 0.0;
  std::vector<SourceEdge> edges;
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Sources collectSources(const std::vector<FloorplanRing>& rings) {
  Sources sources;
  bool first = true;
  double extent = 0.0;
  for (const FloorplanRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (first) sources.origin = ring.vertices[i];
      first = false;
      const Eigen::Vector2d from = ring.vertices[i] - sources.origin;
      const Eigen::Vector2d to = ring.vertices[(i + 1) % ring.size()] - sources.origin;
      extent = std::max(extent, from.cwiseAbs().maxCoeff());
      sources.edges.push_back({from, to, ring.edges[i]});
    }
  }
  sources.tolerance = kRounding * extent;
  return sources;
}

// How often the rings run around the point, counter-clockwise.
int windingNumber(const Eigen::Vector2d& point, const Sources& sources) {
  int winding = 0;
  for (const SourceEdge& edge : sources.edges) {
    const bool up = edge.from.y() <= point.y() && edge.to.y() > point.y();
    const bool down = edge.from.y() > point.y() && edge.to.y() <= point.y();
    const double side = cross(edge.to - edge.from, point - edge.from);
    if (up && side > 0.0) ++winding;
    if (down && side < 0.0) --winding;
  }
  return winding;
}

// The input edge that a -> b runs along in the same sense, for the longest part of it; a
// hypothetical edge if there is none.
FloorplanEdge attributesOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Sources& sources) {
  const Eigen::Vector2d along = (b - a).normalized();
  double longest = 0.0;
  FloorplanEdge found{-1, true};
  for (const SourceEdge& source : sources.edges) {
    const Eigen::Vector2d tangent = (source.to - source.from).normalized();
    const double overlap = std::min(along.dot(source.to - a), (b - a).norm()) -
                           std::max(along.dot(source.from - a), 0.0);
    const bool on_line = std::abs(cross(tangent, a - source.from)) <= 2.0 * sources.tolerance &&
                         std::abs(cross(tangent, b - source.from)) <= 2.0 * sources.tolerance;
    if (on_line && tangent.dot(along) > 0.0 && overlap > longest) {
      longest = overlap;
      found = source.edge;
    }
  }
  return found;
}

// Noding leaves vertices where other rings met the edge: they go, with repeated ones and spikes.
void dropCollinear(std::vector<Eigen::Vector2d>& vertices, double tolerance) {
  for (std::size_t i = 0, kept = 0; kept < vertices.size() && vertices.size() > 2;) {
    const std::size_t n = vertices.size();
    const Eigen::Vector2d& before = vertices[(i + n - 1) % n];
    const Eigen::Vector2d& after = vertices[(i + 1) % n];
    const Eigen::Vector2d span = after - before;
    const double aside =
        span.norm() > tolerance ? std::abs(cross(span.normalized(), vertices[i] - before)) : 0.0;
    if (aside <= tolerance) {
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
      kept = 0;
    } else {
      i = (i + 1) % n;
      ++kept;
    }
  }
}

FloorplanRing toRing(std::vector<Eigen::Vector2d> vertices, bool counter_clockwise,
                     const Sources& sources) {
  dropCollinear(vertices, sources.tolerance);
  FloorplanRing ring;
  ring.vertices = std::move(vertices);
  if ((signedArea(ring) > 0.0) != counter_clockwise) {
    std::reverse(ring.vertices.begin(), ring.vertices.end());
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    ring.edges.push_back(
        attributesOf(ring.vertices[i], ring.vertices[(i + 1) % ring.size()], sources));
  }
  for (Eigen::Vector2d& v : ring.vertices) v += sources.origin;
  return ring;
}

// All edges, cut where they cross each other.
GeosGeometry nodeEdges(const GeosContext& context, const Sources& sources) {
  std::vector<GEOSGeometry*> lines;
  for (const SourceEdge& edge : sources.edges) {
    GeosGeometry line = makeLine(context, edge.from, edge.to);
    if (line) lines.push_back(line.release());
  }
  const GeosGeometry all =
      own(context, GEOSGeom_createCollection_r(context.get(), GEOS_MULTILINESTRING, lines.data(),
                                               static_cast<unsigned>(lines.size())));
  return own(context, all ? GEOSUnaryUnion_r(context.get(), all.get()) : nullptr);
}

// Whether the rings wind around the face.
bool isInside(const GeosContext& context, const GEOSGeometry* face, const Sources& sources) {
  const GeosGeometry point = own(context, GEOSPointOnSurface_r(context.get(), face));
  double x = 0.0;
  double y = 0.0;
  return point && GEOSGeomGetX_r(context.get(), point.get(), &x) == 1 &&
         GEOSGeomGetY_r(context.get(), point.get(), &y) == 1 && windingNumber({x, y}, sources) > 0;
}

// The union of the faces between the edges that the rings wind around.
GeosGeometry insideRegion(const GeosContext& context, const Sources& sources) {
  const GEOSContextHandle_t h = context.get();
  const GeosGeometry noded = nodeEdges(context, sources);
  if (!noded) return own(context, nullptr);
  const GEOSGeometry* const parts[] = {noded.get()};
  const GeosGeometry faces = own(context, GEOSPolygonize_r(h, parts, 1));
  if (!faces) return own(context, nullptr);
  std::vector<GEOSGeometry*> inside;
  for (int i = 0; i < GEOSGetNumGeometries_r(h, faces.get()); ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(h, faces.get(), i);
    if (isInside(context, face, sources)) inside.push_back(GEOSGeom_clone_r(h, face));
  }
  const GeosGeometry all =
      own(context, GEOSGeom_createCollection_r(h, GEOS_MULTIPOLYGON, inside.data(),
                                               static_cast<unsigned>(inside.size())));
  return own(context, all ? GEOSUnaryUnion_r(h, all.get()) : nullptr);
}

void appendPolygons(const GeosContext& context, const GEOSGeometry* geometry, double min_area,
                    const Sources& sources, Floorplan& plan) {
  const GEOSContextHandle_t h = context.get();
  if (GEOSGeomTypeId_r(h, geometry) != GEOS_POLYGON) {
    for (int i = 0; i < GEOSGetNumGeometries_r(h, geometry); ++i) {
      const GEOSGeometry* part = GEOSGetGeometryN_r(h, geometry, i);
      if (part != geometry) appendPolygons(context, part, min_area, sources, plan);
    }
    return;
  }
  double polygon_area = 0.0;
  if (GEOSisEmpty_r(h, geometry) != 0 || GEOSArea_r(h, geometry, &polygon_area) == 0 ||
      polygon_area < min_area) {
    return;
  }
  FloorplanComponent component;
  component.outer =
      toRing(ringVertices(context, GEOSGetExteriorRing_r(h, geometry)), true, sources);
  if (component.outer.size() < 3) return;
  for (int i = 0; i < GEOSGetNumInteriorRings_r(h, geometry); ++i) {
    FloorplanRing hole =
        toRing(ringVertices(context, GEOSGetInteriorRingN_r(h, geometry, i)), false, sources);
    if (hole.size() >= 3 && -signedArea(hole) >= min_area) {
      component.holes.push_back(std::move(hole));
    }
  }
  plan.components.push_back(std::move(component));
}

}  // namespace

Floorplan assembleFloorplan(const std::vector<FloorplanRing>& rings, double min_area) {
  Floorplan plan;
  const Sources sources = collectSources(rings);
  if (sources.edges.empty()) return plan;
  const GeosContext context;
  const GeosGeometry region = insideRegion(context, sources);
  if (!region) return plan;
  appendPolygons(context, region.get(), min_area, sources, plan);
  const auto before = [](const FloorplanComponent& a, const FloorplanComponent& b) {
    return signedArea(a.outer) > signedArea(b.outer);
  };
  std::stable_sort(plan.components.begin(), plan.components.end(), before);
  return plan;
}

}  // namespace storey::detail
