// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "floorplans.h"

/// Points of walls as the kernels of the building-wide core take them, and how well a line through
/// them can be known.
namespace storey::test {

using detail::WallLine;
using detail::WallPoint;
using detail::WallScale;

struct WallSampling {
  double noise = 0.05;
  double density = 40.0;  // points per unit of wall area
  double z_min = 0.0;
  double z_max = 4.0;
  double normal_noise = 0.2;  // rad
};

/// Adds a wall from a to b with the building on its left.
inline void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    const WallSampling& sampling, std::mt19937& random,
                    std::vector<WallPoint>& points) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  const Eigen::Vector2d t = (b - a).normalized();
  const Eigen::Vector2d out(t.y(), -t.x());
  const double height = sampling.z_max - sampling.z_min;
  const auto count = static_cast<int>(sampling.density * height * (b - a).norm());
  for (int i = 0; i < count; ++i) {
    const double turn = std::atan2(out.y(), out.x()) + sampling.normal_noise * normal(random);
    points.push_back({a + unit(random) * (b - a) + sampling.noise * normal(random) * out,
                      sampling.z_min + unit(random) * height,
                      {std::cos(turn), std::sin(turn)}});
  }
}

inline std::vector<WallPoint> wallsOf(const Corners& ring, const WallSampling& sampling,
                                      unsigned seed) {
  std::mt19937 random(seed);
  std::vector<WallPoint> points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    addWall(ring[i], ring[(i + 1) % ring.size()], sampling, random, points);
  }
  return points;
}

inline WallScale scaleOf(const WallSampling& sampling) {
  return {sampling.noise, sampling.density};
}

inline std::vector<int> allOf(const std::vector<WallPoint>& points) {
  std::vector<int> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

/// Standard deviations of the least-squares line through the points of a wall: of its offset at the
/// middle, and of its direction.
struct LineDeviation {
  double offset;
  double angle;
};

inline LineDeviation deviationOf(double length, const WallSampling& sampling) {
  const double count = sampling.density * length * (sampling.z_max - sampling.z_min);
  const double offset = sampling.noise / std::sqrt(count);
  return {offset, offset * std::sqrt(12.0) / length};
}

/// Signed angle from the true normal to the line's.
inline double angleError(const WallLine& line, const Eigen::Vector2d& normal) {
  return std::atan2(crossOf(normal, line.normal), normal.dot(line.normal));
}

}  // namespace storey::test
