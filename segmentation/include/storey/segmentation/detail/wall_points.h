// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// A point of a wall: its place in plan, its height, and the outward normal in plan (unit).
struct WallPoint {
  Eigen::Vector2d position;
  double z = 0.0;
  Eigen::Vector2d normal;
};

/// What is known of the points beforehand.
struct WallScale {
  double noise = 0.0;    ///< standard deviation across a wall, > 0
  double density = 0.0;  ///< points per unit of wall area, > 0
};

/// Length by which the planar points of walls end short of corners and level faces: the reach of
/// the neighbours by which `PlanarConfidenceFilter` leaves out edges.
inline double cornerGap(double density) {
  constexpr double kPlanarNeighbors = 30.0;
  return std::sqrt(kPlanarNeighbors / (M_PI * density));
}

/// The line of a wall in plan and the part of it that points support.
///
/// Coordinates on a wall: s along it (tangent = normal turned by +90 degrees, the building on the
/// left), z up, d = normal . x - offset across it. Support is counted in square cells of (s, z).
struct WallLine {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
  double offset = 0.0;
  double s_min = 0.0;  ///< ends of the support
  double s_max = 0.0;
  double z_min = 0.0;  ///< heights of the support, without 3 % of it at either end
  double z_max = 0.0;
  double support_area = 0.0;     ///< of the cells that hold points
  std::size_t support = 0;       ///< points
  double residual = 0.0;         ///< standard deviation of those points across
  double angle_deviation = 0.0;  ///< standard deviation of the direction, rad
  /// Runs of the support along s, ascending and disjoint: where the wall was seen.
  std::vector<std::pair<double, double>> runs;

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double across(const Eigen::Vector2d& p) const { return normal.dot(p) - offset; }
  double along(const Eigen::Vector2d& p) const { return tangent().dot(p); }
};

/// A point votes for lines within this angle of its normal: three deviations of 15 degrees.
constexpr double kVoteAngle = 0.7853981633974483;  // rad, 45 degrees

/// Least cosine between the normals of a point and of the wall that it is given to: 60 degrees,
/// four deviations of 15.
constexpr double kMinAgreement = 0.5;

}  // namespace storey::detail
