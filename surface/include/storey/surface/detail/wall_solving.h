// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/points_by_wall.h>
#include <storey/surface/detail/wall_panes.h>
#include <storey/surface/floorplan_fitting.h>

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

namespace storey::detail {

constexpr std::size_t kMinWallSupport = 8;  // points

/// Weighted moments of the points of a wall along (s) and across (d) it, about its reference point.
struct WallMoments {
  double w = 0.0, s = 0.0, d = 0.0, ss = 0.0, sd = 0.0, dd = 0.0;
  std::size_t support = 0;

  void add(double along, double across, double weight) {
    w += weight;
    s += weight * along;
    d += weight * across;
    ss += weight * along * along;
    sd += weight * along * across;
    dd += weight * across * across;
    ++support;
  }
  WallMoments& operator+=(const WallMoments& m) {
    w += m.w, s += m.s, d += m.d, ss += m.ss, sd += m.sd, dd += m.dd, support += m.support;
    return *this;
  }
};

/// A wall while it is fitted.
struct FittedWall {
  int id = -1;
  Eigen::Vector2d reference;
  Eigen::Vector2d normal;
  WallMoments sums = {};
  WallPanes panes = {};

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double spread() const { return sums.ss - sums.s * sums.s / sums.w; }  // of the points along it
  // Of the middle of the points. Panes beyond the gate count there, the moments do not.
  double across(double noise) const {
    return panes.in_use ? panes.offset * noise : sums.d / sums.w;
  }
  double residual(double slope) const;
};

using FittedWalls = std::vector<FittedWall>;

/// The lines by which the points were given to the walls.
FittedWalls wallsOf(const std::vector<WallFrame>& frames);

/// The weight of a point at a distance across from its wall, in noise deviations: Tukey's.
double tukeyWeight(double across);

/// Solves each wall: d = a + b s, or d = a where the points are too few to tell b.
std::map<int, WallFit> solveWalls(FittedWalls& walls, double noise);

/// Walls whose directions agree share the weighted mean; each turns about the centre of its points,
/// so that its offset stays the least-squares one.
void shareDirections(FittedWalls& walls, std::map<int, WallFit>& fits);

}  // namespace storey::detail
