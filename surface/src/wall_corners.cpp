// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/wall_corners.h>

#include <cmath>

namespace storey::detail {
namespace {

constexpr double kMinTurn = 0.03;  // rad; lines that cross at less have no stable corner

// Corners to the intersections of the lines; false if an edge would turn around.
bool moveCorners(FloorplanRing& ring, const std::map<int, WallFit>& fits) {
  const std::size_t n = ring.size();
  FloorplanRing moved = ring;
  const auto line = [&](std::size_t i, Eigen::Vector2d& normal, double& offset) {
    const auto fit = fits.find(ring.edges[i].wall);
    if (fit != fits.end()) {
      normal = fit->second.normal;
      offset = fit->second.offset;
      return;
    }
    const Eigen::Vector2d along = ring.vertices[(i + 1) % n] - ring.vertices[i];
    normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    offset = normal.dot(ring.vertices[i]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector2d n1, n2;
    double d1 = 0.0, d2 = 0.0;
    line((i + n - 1) % n, n1, d1);
    line(i, n2, d2);
    const double det = n1.x() * n2.y() - n1.y() * n2.x();
    if (std::abs(det) < std::sin(kMinTurn)) return false;
    moved.vertices[i] = {(d1 * n2.y() - d2 * n1.y()) / det, (n1.x() * d2 - n2.x() * d1) / det};
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if ((moved.vertices[j] - moved.vertices[i]).dot(ring.vertices[j] - ring.vertices[i]) <= 0.0) {
      return false;
    }
  }
  ring = std::move(moved);
  return true;
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
