// SPDX-License-Identifier: BSD-3-Clause
#include <geos_c.h>
#include <storey/surface/detail/plan_arrangement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace storey {
namespace detail {
namespace {

// One GEOS context and what it owns; the reentrant interface keeps threads apart.
class Geos {
 public:
  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

  Geos() : context_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(context_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  GEOSContextHandle_t context() const { return context_; }
  Geometry own(GEOSGeometry* geometry) const { return Geometry(geometry, Destroy{context_}); }

  Geometry lines(const std::vector<GridSegment>& segments) const {
    std::vector<GEOSGeometry*> parts;
    for (const GridSegment& s : segments) {
      const std::array<double, 4> xy = {
          static_cast<double>(s.first.x), static_cast<double>(s.first.y),
          static_cast<double>(s.second.x), static_cast<double>(s.second.y)};
      parts.push_back(GEOSGeom_createLineString_r(
          context_, GEOSCoordSeq_copyFromBuffer_r(context_, xy.data(), 2, 0, 0)));
    }
    return own(GEOSGeom_createCollection_r(context_, GEOS_MULTILINESTRING, parts.data(),
                                           static_cast<unsigned>(parts.size())));
  }

  std::vector<GridPoint> points(const GEOSGeometry* line) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, line);
    unsigned size = 0;
    GEOSCoordSeq_getSize_r(context_, sequence, &size);
    std::vector<double> xy(2 * std::size_t{size});
    GEOSCoordSeq_copyToBuffer_r(context_, sequence, xy.data(), 0, 0);
    std::vector<GridPoint> points(size);
    for (std::size_t i = 0; i < size; ++i) {
      points[i] = {std::llround(xy[2 * i]), std::llround(xy[2 * i + 1])};
    }
    return points;
  }

  Eigen::Vector2d pointInside(const GEOSGeometry* polygon) const {
    const Geometry point = own(GEOSPointOnSurface_r(context_, polygon));
    Eigen::Vector2d xy = Eigen::Vector2d::Constant(std::nan(""));
    if (point) {
      GEOSGeomGetX_r(context_, point.get(), &xy.x());
      GEOSGeomGetY_r(context_, point.get(), &xy.y());
    }
    return xy;
  }

 private:
  GEOSContextHandle_t context_;
};

// An edge on the boundary of a cell; forward: the cell is on the left of low -> high.
struct Side {
  GridPoint low;
  GridPoint high;
  bool forward;
  int cell;
};

Wide twiceArea(const std::vector<GridPoint>& ring) {
  Wide sum = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) sum += cross(ring[i], ring[i + 1]);
  return sum;
}

// GEOS does not promise a sense for rings: the sides are turned so that the cell is on the left.
void appendSides(const std::vector<GridPoint>& ring, bool hole, int cell,
                 std::vector<Side>& sides) {
  const bool cell_on_left = (twiceArea(ring) > 0) != hole;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const bool ascending = ring[i] < ring[i + 1];
    const auto [low, high] = std::minmax(ring[i], ring[i + 1]);
    sides.push_back({low, high, ascending == cell_on_left, cell});
  }
}

void sortUnique(std::vector<GridSegment>& segments) {
  for (GridSegment& s : segments) {
    if (s.second < s.first) std::swap(s.first, s.second);
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
}

std::vector<GridSegment> readSegments(const Geos& geos, const GEOSGeometry* lines) {
  std::vector<GridSegment> segments;
  const int num_lines = GEOSGetNumGeometries_r(geos.context(), lines);
  for (int i = 0; i < num_lines; ++i) {
    const std::vector<GridPoint> line = geos.points(GEOSGetGeometryN_r(geos.context(), lines, i));
    for (std::size_t k = 0; k + 1 < line.size(); ++k) segments.emplace_back(line[k], line[k + 1]);
  }
  sortUnique(segments);
  return segments;
}

// The vertices within half a unit of the segment, but its ends, in its order.
std::vector<GridPoint> verticesOn(const GridSegment& s, const std::vector<GridPoint>& vertices) {
  std::vector<GridPoint> on;
  const GridPoint d = s.second - s.first;
  const auto [bottom, top] = std::minmax({s.first.y, s.second.y});
  auto it = std::lower_bound(vertices.begin(), vertices.end(), GridPoint{s.first.x, bottom});
  for (; it != vertices.end() && it->x <= s.second.x; ++it) {
    if (it->y < bottom || it->y > top || *it == s.first || *it == s.second) continue;
    const Wide area = orient(s.first, s.second, *it);
    if (4 * area * area < dot(d, d)) on.push_back(*it);
  }
  std::sort(on.begin(), on.end(), [&](const GridPoint& a, const GridPoint& b) {
    return dot(d, a - s.first) < dot(d, b - s.first);
  });
  return on;
}

// Snap rounding can move an edge close to a vertex that it was far from: such an edge is bent to
// run through it. Whether there was one.
bool splitAtNearVertices(std::vector<GridSegment>& segments) {
  std::vector<GridPoint> vertices;
  for (const GridSegment& s : segments) {
    vertices.push_back(s.first);
    vertices.push_back(s.second);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<GridSegment> split;
  for (const GridSegment& s : segments) {
    GridPoint from = s.first;
    for (const GridPoint& p : verticesOn(s, vertices)) {
      split.emplace_back(from, p);
      from = p;
    }
    split.emplace_back(from, s.second);
  }
  const bool changed = split.size() != segments.size();
  segments = std::move(split);
  return changed;
}

// Lines that meet at ends only, and keep half a unit away from each other's ends.
Geos::Geometry node(const Geos& geos, std::vector<GridSegment> segments) {
  constexpr int kMaxRounds = 16;  // each splits edges, two are the rule
  Geos::Geometry noded = geos.own(nullptr);
  for (int round = 0; round < kMaxRounds; ++round) {
    sortUnique(segments);
    const Geos::Geometry lines = geos.lines(segments);
    noded = geos.own(GEOSUnaryUnionPrec_r(geos.context(), lines.get(), 1.0));
    if (!noded) break;
    segments = readSegments(geos, noded.get());
    if (!splitAtNearVertices(segments)) break;
  }
  return noded;
}

std::vector<Side> findSides(const Geos& geos, std::vector<GridSegment> segments,
                            std::vector<Eigen::Vector2d>& interior) {
  const Geos::Geometry noded = node(geos, std::move(segments));
  if (!noded) return {};
  const GEOSGeometry* input[] = {noded.get()};
  const Geos::Geometry cells = geos.own(GEOSPolygonize_r(geos.context(), input, 1));
  if (!cells) return {};
  std::vector<Side> sides;
  const int num_cells = GEOSGetNumGeometries_r(geos.context(), cells.get());
  for (int c = 0; c < num_cells; ++c) {
    const GEOSGeometry* polygon = GEOSGetGeometryN_r(geos.context(), cells.get(), c);
    appendSides(geos.points(GEOSGetExteriorRing_r(geos.context(), polygon)), false, c, sides);
    const int num_holes = GEOSGetNumInteriorRings_r(geos.context(), polygon);
    for (int h = 0; h < num_holes; ++h) {
      appendSides(geos.points(GEOSGetInteriorRingN_r(geos.context(), polygon, h)), true, c, sides);
    }
    interior.push_back(geos.pointInside(polygon));
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, b.forward) < std::tie(b.low, b.high, a.forward);
  });
  return sides;
}

// Numbers the cells in the order of their first half-edge, which GEOS does not do.
void renumberCells(PlanArrangement& plan, const std::vector<Eigen::Vector2d>& interior) {
  std::vector<int> number(interior.size(), -1);
  for (int& cell : plan.cell) {
    if (cell < 0) continue;
    int& n = number[static_cast<std::size_t>(cell)];
    if (n < 0) {
      n = static_cast<int>(plan.interior.size());
      plan.interior.push_back(interior[static_cast<std::size_t>(cell)]);
    }
    cell = n;
  }
}

void addEdges(const std::vector<Side>& sides, PlanArrangement& plan) {
  for (const Side& s : sides) {
    plan.vertices.push_back(s.low);
    plan.vertices.push_back(s.high);
  }
  std::sort(plan.vertices.begin(), plan.vertices.end());
  plan.vertices.erase(std::unique(plan.vertices.begin(), plan.vertices.end()), plan.vertices.end());
  const auto index = [&](const GridPoint& p) {
    return static_cast<int>(std::lower_bound(plan.vertices.begin(), plan.vertices.end(), p) -
                            plan.vertices.begin());
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& s = sides[i];
    const bool known = i > 0 && sides[i - 1].low == s.low && sides[i - 1].high == s.high;
    if (!known) {
      plan.origin.push_back(index(s.low));
      plan.origin.push_back(index(s.high));
      plan.cell.insert(plan.cell.end(), 2, -1);
    }
    plan.cell[plan.cell.size() - (s.forward ? 2 : 1)] = s.cell;
  }
}

// Counter-clockwise from the direction +x.
bool angleLess(const GridPoint& a, const GridPoint& b) {
  const auto upper = [](const GridPoint& d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
  if (upper(a) != upper(b)) return upper(a);
  return cross(a, b) > 0;
}

void linkHalfEdges(PlanArrangement& plan) {
  plan.outgoing.resize(plan.vertices.size());
  for (int h = 0; h < static_cast<int>(plan.origin.size()); ++h) {
    plan.outgoing[static_cast<std::size_t>(plan.origin[static_cast<std::size_t>(h)])].push_back(h);
  }
  plan.next.resize(plan.origin.size());
  for (std::vector<int>& star : plan.outgoing) {
    std::sort(star.begin(), star.end(), [&](int g, int h) {
      return angleLess(plan.to(g) - plan.from(g), plan.to(h) - plan.from(h));
    });
    for (std::size_t i = 0; i < star.size(); ++i) {
      const int after = star[(i + 1) % star.size()];  // the cell between lies left of star[i]
      plan.next[static_cast<std::size_t>(after ^ 1)] = star[i];
    }
  }
}

}  // namespace

PlanArrangement arrangeSegments(std::vector<GridSegment> segments) {
  PlanArrangement plan;
  if (segments.empty()) return plan;
  const Geos geos;
  std::vector<Eigen::Vector2d> interior;
  const std::vector<Side> sides = findSides(geos, std::move(segments), interior);
  addEdges(sides, plan);
  renumberCells(plan, interior);
  linkHalfEdges(plan);
  return plan;
}

}  // namespace detail
}  // namespace storey
