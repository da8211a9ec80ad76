// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace storey::detail {

/// normal . x = offset, unit normal; both sides of it are alike.
struct PlanLine {
  Eigen::Vector2d normal;
  double offset = 0.0;
  bool hypothetical = false;  ///< no wall was found there

  Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
  double across(const Eigen::Vector2d& p) const { return normal.dot(p) - offset; }
};

/// A convex cell of the plan. Side i runs from corner i to corner i + 1, counter-clockwise.
struct PlanCell {
  std::vector<Eigen::Vector2d> corners;
  std::vector<int> sides;  ///< index of the line; -1: the border of the plan
  double area = 0.0;
};

/// A stretch of a line between two cells.
struct PlanEdge {
  int line = 0;
  int behind = -1;     ///< cell on the side that the normal points away from; -1: beyond the border
  int ahead = -1;      ///< cell on the side that the normal points to
  double s_min = 0.0;  ///< along the line's tangent
  double s_max = 0.0;

  double length() const { return s_max - s_min; }
};

/// The plan cut into convex cells by whole lines.
struct LineArrangement {
  std::vector<PlanLine> lines;
  std::vector<PlanCell> cells;
  std::vector<PlanEdge> edges;  ///< between two cells, by line and then along it
  std::vector<char> at_border;  ///< of each cell: whether it has a side on the border
};

/// Cuts the box by the lines. Corners within `tolerance` of a line lie on it.
LineArrangement arrangeLines(const std::vector<PlanLine>& lines, const Eigen::Vector2d& low,
                             const Eigen::Vector2d& high, double tolerance);

}  // namespace storey::detail
