// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace storey {
namespace detail {
namespace {

struct FlatEdge {
  FlatVertex a;
  FlatVertex b;
  std::int64_t u_min;
  std::int64_t u_max;
};

int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// Whether p, known to be on the line through a and b, lies between them (ends included).
bool between(const FlatVertex& a, const FlatVertex& b, const FlatVertex& p) {
  return std::min(a.u, b.u) <= p.u && p.u <= std::max(a.u, b.u) && std::min(a.v, b.v) <= p.v &&
         p.v <= std::max(a.v, b.v);
}

// Whether two edges have a point in common that is not an end of both.
bool collide(const FlatEdge& e, const FlatEdge& f) {
  const int fa = sign(orient(e.a, e.b, f.a));
  const int fb = sign(orient(e.a, e.b, f.b));
  const int ea = sign(orient(f.a, f.b, e.a));
  const int eb = sign(orient(f.a, f.b, e.b));
  if (fa * fb < 0 && ea * eb < 0) return true;
  const auto inside = [](const FlatEdge& edge, const FlatVertex& p) {
    return between(edge.a, edge.b, p) && !p.at(edge.a) && !p.at(edge.b);
  };
  if ((fa == 0 && inside(e, f.a)) || (fb == 0 && inside(e, f.b))) return true;
  if ((ea == 0 && inside(f, e.a)) || (eb == 0 && inside(f, e.b))) return true;
  return (e.a.at(f.a) && e.b.at(f.b)) || (e.a.at(f.b) && e.b.at(f.a));
}

std::vector<FlatEdge> sortedEdges(const std::vector<FlatRing>& rings) {
  std::vector<FlatEdge> edges;
  for (const FlatRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const FlatVertex& a = ring[i];
      const FlatVertex& b = ring[(i + 1) % ring.size()];
      edges.push_back({a, b, std::min(a.u, b.u), std::max(a.u, b.u)});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const FlatEdge& e, const FlatEdge& f) { return e.u_min < f.u_min; });
  return edges;
}

bool edgesCollide(const std::vector<FlatRing>& rings) {
  const std::vector<FlatEdge> edges = sortedEdges(rings);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].a.at(edges[i].b)) return true;
    for (std::size_t j = i + 1; j < edges.size() && edges[j].u_min <= edges[i].u_max; ++j) {
      if (collide(edges[i], edges[j])) return true;
    }
  }
  return false;
}

// Whether most is inside: rings that do not cross are judged by a corner that is not on the other.
bool ringInside(const FlatRing& inner, const FlatRing& outer) {
  for (const FlatVertex& p : inner) {
    const auto same = [&](const FlatVertex& q) { return p.at(q); };
    if (std::any_of(outer.begin(), outer.end(), same)) continue;
    bool odd = false;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const FlatVertex& a = outer[i];
      const FlatVertex& b = outer[(i + 1) % outer.size()];
      if ((a.v > p.v) == (b.v > p.v)) continue;
      if ((orient(a, b, p) > 0) == (b.v > a.v)) odd = !odd;
    }
    return odd;
  }
  return true;
}

// Integers along the plane's axes: x and y for a cap, along the chord and z for a wall.
FlatVertex flatten(int index, const LatticePoint& p, bool cap, const GridPoint& chord) {
  if (cap) return {index, p[0], p[1]};
  return {index, dot(chord, {p[0], p[1]}), p[2]};
}

// The rings' vertices relative to the first one.
bool readPoints(const PolyhedralModel& model, const std::vector<std::vector<int>>& indices,
                std::vector<std::vector<LatticePoint>>& points) {
  LatticePoint origin{};
  bool first = true;
  for (const std::vector<int>& ring : indices) {
    points.emplace_back();
    for (const int i : ring) {
      if (i < 0 || static_cast<std::size_t>(i) >= model.vertices.size()) return false;
      const Eigen::Vector3d& vertex = model.vertices[static_cast<std::size_t>(i)];
      if (first) {
        const std::optional<LatticePoint> index = latticeIndex(vertex, model.grid);
        if (!index) return false;
        origin = *index;
        first = false;
      }
      const std::optional<LatticePoint> p = toLattice(vertex, model.grid, origin);
      if (!p) return false;
      points.back().push_back(*p);
    }
  }
  return !points[0].empty();
}

}  // namespace

std::optional<LatticePoint> latticeIndex(const Eigen::Vector3d& vertex, double grid) {
  constexpr double kMaxIndex = 9.0e15;  // 2^53: integers are exact in a double
  LatticePoint point{};
  for (int i = 0; i < 3; ++i) {
    const double index = vertex[i] / grid;
    if (!(std::abs(index) < kMaxIndex)) return std::nullopt;
    point[static_cast<std::size_t>(i)] = std::llround(index);
  }
  return point;
}

std::optional<LatticePoint> toLattice(const Eigen::Vector3d& vertex, double grid,
                                      const LatticePoint& origin) {
  std::optional<LatticePoint> point = latticeIndex(vertex, grid);
  for (std::size_t i = 0; point && i < 3; ++i) {
    (*point)[i] -= origin[i];
    if (std::abs((*point)[i]) >= kMaxLatticeExtent) return std::nullopt;
  }
  return point;
}

Wide orient(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c) {
  return static_cast<Wide>(b.u - a.u) * (c.v - a.v) - static_cast<Wide>(b.v - a.v) * (c.u - a.u);
}

Wide twiceArea(const FlatRing& ring) {
  Wide sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += orient(ring[0], ring[i], ring[i + 1]);
  return sum;
}

std::vector<FlatRing> flattenFace(const PolyhedralModel& model, const PolyhedralFace& face) {
  std::vector<std::vector<int>> indices = {face.outer};
  indices.insert(indices.end(), face.inner.begin(), face.inner.end());
  std::vector<std::vector<LatticePoint>> points;
  if (!readPoints(model, indices, points)) return {};
  const bool cap = face.label != FaceLabel::Wall;
  std::vector<GridPoint> plan;
  for (const std::vector<LatticePoint>& ring : points) {
    for (const LatticePoint& p : ring) plan.push_back({p[0], p[1]});
  }
  const auto [from, to] = findChord(plan);
  const GridPoint chord = to - from;
  if (std::max(std::abs(chord.x), std::abs(chord.y)) >= kMaxLatticeExtent) return {};
  std::vector<FlatRing> rings(indices.size());
  for (std::size_t r = 0; r < indices.size(); ++r) {
    for (std::size_t i = 0; i < indices[r].size(); ++i) {
      rings[r].push_back(flatten(indices[r][i], points[r][i], cap, chord));
    }
  }
  const Wide area = twiceArea(rings[0]);
  if (area == 0) return {};
  if (area < 0) {  // seen from the other side: mirror
    for (FlatRing& ring : rings) {
      for (FlatVertex& p : ring) p.u = -p.u;
    }
  }
  return rings;
}

bool isPolygon(const std::vector<FlatRing>& rings) {
  if (rings.empty()) return false;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (rings[r].size() < 3 || (twiceArea(rings[r]) > 0) != (r == 0)) return false;
    if (r > 0 && twiceArea(rings[r]) == 0) return false;
  }
  if (edgesCollide(rings)) return false;
  for (std::size_t r = 1; r < rings.size(); ++r) {
    if (!ringInside(rings[r], rings[0])) return false;
    for (std::size_t s = 1; s < rings.size(); ++s) {
      if (s != r && ringInside(rings[r], rings[s])) return false;
    }
  }
  return true;
}

}  // namespace detail
}  // namespace storey
