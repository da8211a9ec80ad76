// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/wall_corners.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kMinTurn = 0.03;  // rad; lines that cross at less have no stable corner

struct Line {
  Eigen::Vector2d normal;
  double offset;
};

Line lineOf(const FloorplanRing& ring, std::size_t i, const std::map<int, WallFit>& fits) {
  const auto fit = fits.find(ring.edges[i].wall);
  if (fit != fits.end()) return {fit->second.normal, fit->second.offset};
  const Eigen::Vector2d along = ring.vertices[(i + 1) % ring.size()] - ring.vertices[i];
  const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  return {normal, normal.dot(ring.vertices[i])};
}

// Corners to the intersections of the edges' lines; false if some of them have none.
bool intersect(const FloorplanRing& ring, const std::vector<Line>& lines, FloorplanRing& moved) {
  const std::size_t n = ring.size();
  moved = ring;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [n1, d1] = lines[(i + n - 1) % n];
    const auto& [n2, d2] = lines[i];
    const double det = n1.x() * n2.y() - n1.y() * n2.x();
    if (std::abs(det) < std::sin(kMinTurn)) return false;
    moved.vertices[i] = {(d1 * n2.y() - d2 * n1.y()) / det, (n1.x() * d2 - n2.x() * d1) / det};
  }
  return true;
}

double lengthOf(const FloorplanRing& ring, std::size_t i) {
  return (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm();
}

// The shortest edge that runs the other way in the moved ring; the number of edges if there is
// none.
std::size_t shortestTurned(const FloorplanRing& ring, const FloorplanRing& moved) {
  const std::size_t n = ring.size();
  std::size_t shortest = n;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const bool turned =
        (moved.vertices[j] - moved.vertices[i]).dot(ring.vertices[j] - ring.vertices[i]) <= 0.0;
    if (turned && (shortest == n || lengthOf(ring, i) < lengthOf(ring, shortest))) shortest = i;
  }
  return shortest;
}

// Takes the edge away: its neighbours meet, wherever their lines do.
void remove(std::size_t edge, FloorplanRing& ring, std::vector<Line>& lines) {
  const auto i = static_cast<std::ptrdiff_t>(edge);
  ring.vertices.erase(ring.vertices.begin() + i);
  ring.edges.erase(ring.edges.begin() + i);
  lines.erase(lines.begin() + i);
}

// Without the shorter of two edges that go on from each other in nearly the same line: what crosses
// so flatly has no stable corner.
void straighten(FloorplanRing& ring, std::vector<Line>& lines) {
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const std::size_t before = (i + ring.size() - 1) % ring.size();
    const Eigen::Vector2d& a = lines[before].normal;
    const Eigen::Vector2d& b = lines[i].normal;
    const bool flat = std::abs(a.x() * b.y() - a.y() * b.x()) < std::sin(kMinTurn);
    if (!flat || a.dot(b) < 0.0) {
      ++i;
      continue;
    }
    remove(lengthOf(ring, before) < lengthOf(ring, i) ? before : i, ring, lines);
    i = 0;
  }
}

// \return false if there is no such ring
bool moveCorners(FloorplanRing& ring, const std::map<int, WallFit>& fits) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < ring.size(); ++i) lines.push_back(lineOf(ring, i, fits));
  FloorplanRing tried = ring;
  straighten(tried, lines);
  FloorplanRing moved;
  while (intersect(tried, lines, moved)) {
    const std::size_t n = tried.size();
    const std::size_t edge = shortestTurned(tried, moved);
    if (edge == n) {
      ring = std::move(moved);
      return true;
    }
    const double neighbours =
        std::min(lengthOf(tried, (edge + 1) % n), lengthOf(tried, (edge + n - 1) % n));
    if (n <= 3 || lengthOf(tried, edge) > neighbours) return false;
    remove(edge, tried, lines);
  }
  return false;
}

void moveOrRelease(FloorplanRing& ring, const std::map<int, WallFit>& fits) {
  if (moveCorners(ring, fits)) return;
  for (FloorplanEdge& edge : ring.edges) edge.wall = -1;
}

}  // namespace

void moveCorners(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits) {
  for (FloorplanLayer& layer : layers) {
    for (FloorplanComponent& component : layer.plan.components) {
      moveOrRelease(component.outer, fits);
      for (FloorplanRing& hole : component.holes) moveOrRelease(hole, fits);
    }
  }
}

}  // namespace storey::detail
