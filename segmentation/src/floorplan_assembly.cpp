// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <cmath>

#include "geos_polygon.h"

namespace storey::detail {
namespace {

struct SourceEdge {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  FloorplanEdge edge;
};

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double t =
      d.squaredNorm() > 0.0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

// The source edge that runs along a -> b in the same sense; a plane of its own if there is none.
FloorplanEdge attributesOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const std::vector<SourceEdge>& sources) {
  constexpr double kSameLine = 1e-6;  // of the edge's length
  const double length = (b - a).norm();
  double nearest = kSameLine * length;
  FloorplanEdge found{-1, true};
  for (const SourceEdge& source : sources) {
    if ((source.to - source.from).dot(b - a) <= 0.0) continue;
    const double distance = std::max(distanceToSegment(a, source.from, source.to),
                                     distanceToSegment(b, source.from, source.to));
    if (distance < nearest) {
      nearest = distance;
      found = source.edge;
    }
  }
  return found;
}

FloorplanRing toRing(std::vector<Eigen::Vector2d> vertices, bool counter_clockwise,
                     const std::vector<SourceEdge>& sources) {
  FloorplanRing ring;
  ring.vertices = std::move(vertices);
  if ((signedArea(ring) > 0.0) != counter_clockwise) {
    std::reverse(ring.vertices.begin(), ring.vertices.end());
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    ring.edges.push_back(
        attributesOf(ring.vertices[i], ring.vertices[(i + 1) % ring.size()], sources));
  }
  return ring;
}

// The polygon of one ring, made valid where it crosses itself.
GeosGeometry toPolygon(const GeosContext& context, const FloorplanRing& ring) {
  GeosGeometry line = makeLinearRing(context, ring.vertices);
  if (!line) return line;
  GeosGeometry polygon =
      own(context, GEOSGeom_createPolygon_r(context.get(), line.release(), nullptr, 0));
  if (!polygon || GEOSisValid_r(context.get(), polygon.get()) == 1) return polygon;
  return own(context, GEOSMakeValid_r(context.get(), polygon.get()));
}

using Overlay = GEOSGeometry* (*)(GEOSContextHandle_t, const GEOSGeometry*, const GEOSGeometry*);

void combine(const GeosContext& context, Overlay overlay, const FloorplanRing& ring,
             GeosGeometry& region) {
  const GeosGeometry polygon = toPolygon(context, ring);
  if (!polygon) return;
  GeosGeometry result = own(context, overlay(context.get(), region.get(), polygon.get()));
  if (result) region = std::move(result);
}

void appendPolygons(const GeosContext& context, const GEOSGeometry* geometry, double min_area,
                    const std::vector<SourceEdge>& sources, Floorplan& plan) {
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
  for (int i = 0; i < GEOSGetNumInteriorRings_r(h, geometry); ++i) {
    FloorplanRing hole =
        toRing(ringVertices(context, GEOSGetInteriorRingN_r(h, geometry, i)), false, sources);
    if (-signedArea(hole) >= min_area) component.holes.push_back(std::move(hole));
  }
  plan.components.push_back(std::move(component));
}

}  // namespace

Floorplan assembleFloorplan(const std::vector<FloorplanRing>& rings, double min_area) {
  const GeosContext context;
  std::vector<SourceEdge> sources;
  for (const FloorplanRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      sources.push_back({ring.vertices[i], ring.vertices[(i + 1) % ring.size()], ring.edges[i]});
    }
  }
  GeosGeometry region = own(context, GEOSGeom_createEmptyPolygon_r(context.get()));
  for (const FloorplanRing& ring : rings) {
    if (ring.size() >= 3 && signedArea(ring) > 0.0) combine(context, GEOSUnion_r, ring, region);
  }
  for (const FloorplanRing& ring : rings) {
    if (ring.size() >= 3 && signedArea(ring) < 0.0)
      combine(context, GEOSDifference_r, ring, region);
  }
  Floorplan plan;
  appendPolygons(context, region.get(), min_area, sources, plan);
  const auto before = [](const FloorplanComponent& a, const FloorplanComponent& b) {
    return signedArea(a.outer) > signedArea(b.outer);
  };
  std::stable_sort(plan.components.begin(), plan.components.end(), before);
  return plan;
}

}  // namespace storey::detail
