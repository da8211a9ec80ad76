// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/triangle_contact.h>

#include <algorithm>
#include <vector>

namespace storey {
namespace detail {
namespace {

using WideVector = std::array<Wide, 3>;

int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

WideVector cross(const LatticePoint& o, const LatticePoint& a, const LatticePoint& b) {
  const auto d = [&](const LatticePoint& p, std::size_t i) -> Wide { return p[i] - o[i]; };
  return {d(a, 1) * d(b, 2) - d(a, 2) * d(b, 1), d(a, 2) * d(b, 0) - d(a, 0) * d(b, 2),
          d(a, 0) * d(b, 1) - d(a, 1) * d(b, 0)};
}

// On which side of the plane through a, b, c the point is.
int side(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
         const LatticePoint& p) {
  const WideVector n = cross(a, b, c);
  return sign(n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]));
}

// The part of a triangle that a point lies on: corners 0-2, edges 3-5 (edge i from corner i),
// the interior 6, nothing -1; from the sides of the edges it lies on (same sign: inside).
constexpr int kInterior = 6;
int featureFromSides(const std::array<int, 3>& sides) {
  const int most = *std::max_element(sides.begin(), sides.end());
  const int least = *std::min_element(sides.begin(), sides.end());
  if (most > 0 && least < 0) return -1;
  for (int i = 0; i < 3; ++i) {
    const bool here = sides[static_cast<std::size_t>(i)] == 0;
    const bool before = sides[static_cast<std::size_t>((i + 2) % 3)] == 0;
    if (here && before) return i;
  }
  for (int i = 0; i < 3; ++i) {
    if (sides[static_cast<std::size_t>(i)] == 0) return 3 + i;
  }
  return kInterior;
}

// The plane's axes without the one that the normal points along most.
std::pair<std::size_t, std::size_t> flatAxes(const LatticeTriangle& t) {
  const WideVector n = cross(t[0], t[1], t[2]);
  const auto size = [&](std::size_t i) { return n[i] < 0 ? -n[i] : n[i]; };
  if (size(2) >= size(0) && size(2) >= size(1)) return {0, 1};
  return size(0) >= size(1) ? std::make_pair(std::size_t{1}, std::size_t{2})
                            : std::make_pair(std::size_t{2}, std::size_t{0});
}

int flatSide(const std::pair<std::size_t, std::size_t>& axes, const LatticePoint& a,
             const LatticePoint& b, const LatticePoint& p) {
  const auto [i, j] = axes;
  return sign(static_cast<Wide>(b[i] - a[i]) * (p[j] - a[j]) -
              static_cast<Wide>(b[j] - a[j]) * (p[i] - a[i]));
}

// Of a point in the triangle's plane.
int featureInPlane(const LatticeTriangle& t, const LatticePoint& p) {
  const auto axes = flatAxes(t);
  return featureFromSides({flatSide(axes, t[0], t[1], p), flatSide(axes, t[1], t[2], p),
                           flatSide(axes, t[2], t[0], p)});
}

// A point common to two triangles, by the smallest part of each that it lies on: different
// points have different parts.
using Event = std::pair<int, int>;

// Where corners and edges of the first triangle meet the second.
std::vector<Event> findEvents(const LatticeTriangle& first, const LatticeTriangle& second) {
  std::vector<Event> events;
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = side(second[0], second[1], second[2], first[i]);
    if (sides[i] != 0) continue;
    const int feature = featureInPlane(second, first[i]);
    if (feature >= 0) events.emplace_back(static_cast<int>(i), feature);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    const int feature = featureFromSides({side(first[i], first[j], second[0], second[1]),
                                          side(first[i], first[j], second[1], second[2]),
                                          side(first[i], first[j], second[2], second[0])});
    if (feature >= 0) events.emplace_back(3 + static_cast<int>(i), feature);
  }
  return events;
}

// The edge that two points on the border of a triangle have in common, -1 if none.
int commonEdge(int p, int q) {
  for (int i = 0; i < 3; ++i) {
    const auto on_edge = [&](int f) { return f == i || f == (i + 1) % 3 || f == 3 + i; };
    if (on_edge(p) && on_edge(q)) return i;
  }
  return -1;
}

bool interiorsOverlap(const LatticeTriangle& first, const LatticeTriangle& second) {
  const auto axes = flatAxes(first);
  const auto separates = [&](const LatticeTriangle& t, const LatticeTriangle& other) {
    const int inner = flatSide(axes, t[0], t[1], t[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::all_of(other.begin(), other.end(), [&](const LatticePoint& p) {
            return flatSide(axes, t[i], t[(i + 1) % 3], p) * inner <= 0;
          })) {
        return true;
      }
    }
    return false;
  };
  return !separates(first, second) && !separates(second, first);
}

}  // namespace

TriangleContact findContact(const LatticeTriangle& first, const LatticeTriangle& second) {
  TriangleContact contact;
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) sides[i] = side(second[0], second[1], second[2], first[i]);
  if (sides == std::array<int, 3>{0, 0, 0}) {
    if (interiorsOverlap(first, second)) contact.kind = TriangleContact::Area;
    return contact;
  }
  std::vector<Event> events = findEvents(first, second);
  for (const Event& e : findEvents(second, first)) events.emplace_back(e.second, e.first);
  std::sort(events.begin(), events.end());
  events.erase(std::unique(events.begin(), events.end()), events.end());
  if (events.empty()) return contact;
  contact.kind = events.size() == 1 ? TriangleContact::Point : TriangleContact::Segment;
  if (events.size() == 1) return contact;
  contact.edge_of_first = commonEdge(events.front().first, events.back().first);
  contact.edge_of_second = commonEdge(events.front().second, events.back().second);
  return contact;
}

}  // namespace detail
}  // namespace storey
