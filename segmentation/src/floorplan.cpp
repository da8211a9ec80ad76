// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/floorplan.h>

namespace storey {
namespace {

template <typename Visit>
void forEachRing(const Floorplan& plan, Visit visit) {
  for (const FloorplanComponent& component : plan.components) {
    visit(component.outer);
    for (const FloorplanRing& hole : component.holes) visit(hole);
  }
}

// Whether a horizontal ray from the point to +x crosses the ring an odd number of times.
bool crossesOddly(const FloorplanRing& ring, const Eigen::Vector2d& point) {
  bool odd = false;
  const std::size_t n = ring.size();
  for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
    const Eigen::Vector2d& a = ring.vertices[j];
    const Eigen::Vector2d& b = ring.vertices[i];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) odd = !odd;
  }
  return odd;
}

}  // namespace

double signedArea(const FloorplanRing& ring) {
  if (ring.size() < 3) return 0.0;
  const Eigen::Vector2d origin = ring.vertices.front();  // far coordinates would cancel otherwise
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Eigen::Vector2d a = ring.vertices[i] - origin;
    const Eigen::Vector2d b = ring.vertices[i + 1] - origin;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double area(const Floorplan& plan) {
  double sum = 0.0;
  forEachRing(plan, [&](const FloorplanRing& ring) { sum += signedArea(ring); });
  return sum;
}

double perimeter(const Floorplan& plan) {
  double sum = 0.0;
  forEachRing(plan, [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      sum += (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm();
    }
  });
  return sum;
}

bool contains(const Floorplan& plan, const Eigen::Vector2d& point) {
  bool inside = false;
  forEachRing(plan, [&](const FloorplanRing& ring) {
    if (crossesOddly(ring, point)) inside = !inside;
  });
  return inside;
}

std::size_t countEdges(const Floorplan& plan) {
  std::size_t count = 0;
  forEachRing(plan, [&](const FloorplanRing& ring) { count += ring.size(); });
  return count;
}

}  // namespace storey
