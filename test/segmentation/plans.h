// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <storey/segmentation/detail/line_arrangement.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "floorplans.h"

/// Lines and arrangements of them, for the tests of the kernels that label their cells.
namespace storey::test {

using detail::LineArrangement;
using detail::PlanCell;
using detail::PlanEdge;
using detail::PlanLine;
using PlanLines = std::vector<PlanLine>;

inline PlanLine lineAt(double angle, double offset) {
  return {{std::cos(angle), std::sin(angle)}, offset};
}

inline PlanLine lineThrough(const Eigen::Vector2d& p, double angle) {
  PlanLine line = lineAt(angle, 0.0);
  line.offset = line.normal.dot(p);
  return line;
}

/// Lines x = each of `xs`, then y = each of `ys`.
inline PlanLines gridLines(const std::vector<double>& xs, const std::vector<double>& ys) {
  PlanLines lines;
  for (const double x : xs) lines.push_back({{1.0, 0.0}, x});
  for (const double y : ys) lines.push_back({{0.0, 1.0}, y});
  return lines;
}

inline std::optional<Eigen::Vector2d> crossingOf(const PlanLine& a, const PlanLine& b) {
  const double det = crossOf(a.normal, b.normal);
  if (std::abs(det) < 1e-12) return std::nullopt;
  return Eigen::Vector2d(a.offset * b.normal.y() - b.offset * a.normal.y(),
                         a.normal.x() * b.offset - b.normal.x() * a.offset) /
         det;
}

/// The stretch of the line within the box, by the slab method; empty if first >= second.
inline std::pair<double, double> stretchWithin(const PlanLine& line, const Eigen::Vector2d& low,
                                               const Eigen::Vector2d& high) {
  const Eigen::Vector2d foot = line.offset * line.normal;
  const Eigen::Vector2d t = line.tangent();
  double from = -1e300;
  double to = 1e300;
  for (int axis = 0; axis < 2; ++axis) {
    if (t[axis] == 0.0) {
      if (foot[axis] < low[axis] || foot[axis] > high[axis]) return {0.0, 0.0};
      continue;
    }
    const double a = (low[axis] - foot[axis]) / t[axis];
    const double b = (high[axis] - foot[axis]) / t[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return {from, to};
}

inline Eigen::Vector2d middleOf(const PlanCell& cell) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : cell.corners) sum += corner;
  return sum / static_cast<double>(cell.corners.size());
}

inline std::size_t cellAt(const LineArrangement& plan, const Eigen::Vector2d& p) {
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const Corners& corners = plan.cells[c].corners;
    bool inside = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d& a = corners[i];
      inside = inside && crossOf(corners[(i + 1) % corners.size()] - a, p - a) >= 0.0;
    }
    if (inside) return c;
  }
  ADD_FAILURE() << "no cell at " << p.transpose();
  return 0;
}

}  // namespace storey::test
