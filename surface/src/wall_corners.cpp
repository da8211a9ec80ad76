// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/wall_corners.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

namespace storey::detail {
namespace {

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

double lengthOf(const FloorplanRing& ring, std::size_t i) {
  return (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm();
}

// Corners to the intersections of the edges' lines. Lines that hardly turn may cross anywhere:
// where that is further away than the shorter of the two edges is long, the corner stays beside the
// other one's line, and the shorter edge is of no wall any more.
FloorplanRing intersect(const FloorplanRing& ring, const std::vector<Line>& lines) {
  const std::size_t n = ring.size();
  FloorplanRing moved = ring;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const auto& [n1, d1] = lines[before];
    const auto& [n2, d2] = lines[i];
    const double det = n1.x() * n2.y() - n1.y() * n2.x();
    Eigen::Vector2d& corner = moved.vertices[i];
    corner = {(d1 * n2.y() - d2 * n1.y()) / det, (n1.x() * d2 - n2.x() * d1) / det};
    if (std::abs(det) > std::sin(kMinTurn)) continue;
    const Eigen::Vector2d& old = ring.vertices[i];
    const bool first_longer = lengthOf(ring, before) > lengthOf(ring, i);
    const std::size_t shorter = first_longer ? i : before;
    if ((corner - old).norm() < lengthOf(ring, shorter)) continue;
    const Line& longer = first_longer ? lines[before] : lines[i];
    corner = old - (longer.normal.dot(old) - longer.offset) * longer.normal;
    moved.edges[shorter].wall = -1;
  }
  return moved;
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

std::size_t shortestOf(const FloorplanRing& ring, std::initializer_list<std::size_t> edges) {
  return *std::min_element(edges.begin(), edges.end(), [&](std::size_t a, std::size_t b) {
    return lengthOf(ring, a) < lengthOf(ring, b);
  });
}

// Takes the edge away: its neighbours meet, wherever their lines do.
void remove(std::size_t edge, FloorplanRing& ring, std::vector<Line>& lines) {
  const auto i = static_cast<std::ptrdiff_t>(edge);
  ring.vertices.erase(ring.vertices.begin() + i);
  ring.edges.erase(ring.edges.begin() + i);
  lines.erase(lines.begin() + i);
}

// An edge of the wall that the one before it is of too; the number of edges if there is none.
std::size_t goingOn(const FloorplanRing& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const int wall = ring.edges[i].wall;
    if (wall >= 0 && wall == ring.edges[(i + n - 1) % n].wall) return i;
  }
  return n;
}

}  // namespace

bool moveCorners(FloorplanRing& ring, const std::map<int, WallFit>& fits) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < ring.size(); ++i) lines.push_back(lineOf(ring, i, fits));
  FloorplanRing tried = ring;
  while (true) {
    const std::size_t n = tried.size();
    const std::size_t more = goingOn(tried);
    if (more < n && n > 3) {
      remove(more, tried, lines);
      continue;
    }
    FloorplanRing moved = intersect(tried, lines);
    const std::size_t edge = shortestTurned(tried, moved);
    if (edge == n) {
      ring = std::move(moved);
      return true;
    }
    if (n <= 3) return false;
    remove(shortestOf(tried, {edge, (edge + 1) % n, (edge + n - 1) % n}), tried, lines);
  }
}

namespace {

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
