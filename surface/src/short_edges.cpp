// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/short_edges.h>
#include <storey/surface/detail/wall_corners.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace storey::detail {
namespace {

Eigen::Vector2d alongOf(const FloorplanRing& ring, std::size_t edge) {
  return ring.vertices[(edge + 1) % ring.size()] - ring.vertices[edge];
}

double distanceTo(const FloorplanRing& ring, const Eigen::Vector2d& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d along = alongOf(ring, i);
    const Eigen::Vector2d to_place = place - ring.vertices[i];
    const double squared = along.squaredNorm();
    const double share = squared > 0.0 ? std::clamp(to_place.dot(along) / squared, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (to_place - share * along).norm());
  }
  return nearest;
}

bool cornersAreNear(const FloorplanRing& ring, const FloorplanRing& other, double reach) {
  return std::all_of(ring.vertices.begin(), ring.vertices.end(),
                     [&](const Eigen::Vector2d& at) { return distanceTo(other, at) <= reach; });
}

bool areParallel(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x()) < std::sin(kMinTurn) * a.norm() * b.norm();
}

FloorplanRing without(const FloorplanRing& ring, std::size_t edge, std::size_t other) {
  FloorplanRing rest;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (i == edge || i == other) continue;
    rest.vertices.push_back(ring.vertices[i]);
    rest.edges.push_back(ring.edges[i]);
  }
  return rest;
}

bool drop(std::size_t edge, const std::map<int, WallFit>& fits, double least, FloorplanRing& ring) {
  const std::size_t n = ring.size();
  const std::size_t before = (edge + n - 1) % n;
  const std::size_t after = (edge + 1) % n;
  std::size_t other = edge;
  if (areParallel(alongOf(ring, before), alongOf(ring, after))) {
    other = alongOf(ring, before).norm() < alongOf(ring, after).norm() ? before : after;
  }
  FloorplanRing rest = without(ring, edge, other);
  if (rest.size() < 3 || !moveCorners(rest, fits)) return false;
  if (!cornersAreNear(ring, rest, least) || !cornersAreNear(rest, ring, least)) return false;
  ring = std::move(rest);
  return true;
}

// The shortest one that can go.
bool dropOne(const std::map<int, WallFit>& fits, double least, FloorplanRing& ring) {
  std::vector<std::size_t> doubtful;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring.edges[i].wall < 0 || alongOf(ring, i).norm() < least) doubtful.push_back(i);
  }
  std::stable_sort(doubtful.begin(), doubtful.end(), [&](std::size_t a, std::size_t b) {
    return alongOf(ring, a).norm() < alongOf(ring, b).norm();
  });
  return std::any_of(doubtful.begin(), doubtful.end(),
                     [&](std::size_t edge) { return drop(edge, fits, least, ring); });
}

}  // namespace

void dropShortEdges(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits,
                    double least) {
  const auto simplify = [&](FloorplanRing& ring) {
    while (dropOne(fits, least, ring)) {
    }
  };
  for (FloorplanLayer& layer : layers) {
    for (FloorplanComponent& component : layer.plan.components) {
      simplify(component.outer);
      for (FloorplanRing& hole : component.holes) simplify(hole);
    }
  }
}

}  // namespace storey::detail
