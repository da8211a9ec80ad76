// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <storey/segmentation/floorplan.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

/// Floorplans for the tests of what makes them, and what must hold of every one.
namespace storey::test {

using Corners = std::vector<Eigen::Vector2d>;

inline FloorplanRing ringOf(const Corners& corners) {
  FloorplanRing ring;
  ring.vertices = corners;
  ring.edges.resize(corners.size());
  return ring;
}

inline Corners box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Corners clockwise(Corners corners) {
  std::reverse(corners.begin(), corners.end());
  return corners;
}

inline Corners moved(Corners corners, double yaw, const Eigen::Vector2d& shift) {
  for (Eigen::Vector2d& c : corners) c = Eigen::Rotation2Dd(yaw) * c + shift;
  return corners;
}

inline double crossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the segments cross by more than rounding.
inline bool segmentsCross(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  const double rounding = 1e-12 * (b - a).norm() * (d - c).norm();
  const auto sides = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                         const Eigen::Vector2d& r, const Eigen::Vector2d& s) {
    const double first = crossOf(q - p, r - p);
    const double second = crossOf(q - p, s - p);
    return std::min(first, second) < -rounding && std::max(first, second) > rounding;
  };
  return sides(a, b, c, d) && sides(c, d, a, b);
}

/// No two edges cross, no two corners are in one place.
inline bool isSimple(const FloorplanRing& ring) {
  const std::size_t n = ring.size();
  const auto at = [&](std::size_t i) { return ring.vertices[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (at(i) == at(j) || segmentsCross(at(i), at(i + 1), at(j), at(j + 1))) return false;
    }
  }
  return true;
}

inline void expectGoodRing(const FloorplanRing& ring, bool counter_clockwise) {
  ASSERT_GE(ring.size(), 3U);
  ASSERT_EQ(ring.edges.size(), ring.size());
  EXPECT_TRUE(isSimple(ring));
  EXPECT_EQ(signedArea(ring) > 0.0, counter_clockwise);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring.vertices[(i + 1) % ring.size()] - ring.vertices[i];
    const Eigen::Vector2d b =
        ring.vertices[(i + 2) % ring.size()] - ring.vertices[(i + 1) % ring.size()];
    EXPECT_GT(std::abs(crossOf(a, b)), 1e-7 * a.norm() * b.norm()) << "collinear at " << i + 1;
  }
}

/// Rings simple, without collinear vertices, outer counter-clockwise, holes clockwise.
inline void expectValid(const Floorplan& plan) {
  for (const FloorplanComponent& component : plan.components) {
    expectGoodRing(component.outer, true);
    double holes = 0.0;
    for (const FloorplanRing& hole : component.holes) {
      expectGoodRing(hole, false);
      holes -= signedArea(hole);
      Floorplan outer;
      outer.components.push_back({component.outer, {}});
      for (std::size_t i = 0; i < hole.size(); ++i) {  // middles: corners may touch the outer ring
        EXPECT_TRUE(
            contains(outer, 0.5 * (hole.vertices[i] + hole.vertices[(i + 1) % hole.size()])));
      }
    }
    EXPECT_LT(holes, signedArea(component.outer));
  }
}

/// Whether the corners are those of the ring, in the same order from whichever first one.
inline bool sameCorners(const FloorplanRing& ring, const Corners& corners, double tolerance) {
  const std::size_t n = corners.size();
  if (ring.size() != n) return false;
  for (std::size_t shift = 0; shift < n; ++shift) {
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      worst = std::max(worst, (ring.vertices[(i + shift) % n] - corners[i]).norm());
    }
    if (worst <= tolerance) return true;
  }
  return false;
}

inline std::size_t countHypothetical(const FloorplanRing& ring) {
  return static_cast<std::size_t>(
      std::count_if(ring.edges.begin(), ring.edges.end(),
                    [](const FloorplanEdge& edge) { return edge.hypothetical; }));
}

}  // namespace storey::test
