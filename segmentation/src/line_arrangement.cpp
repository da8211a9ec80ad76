// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/line_arrangement.h>

#include <algorithm>

namespace storey::detail {
namespace {

double areaOf(const std::vector<Eigen::Vector2d>& corners) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Eigen::Vector2d a = corners[i] - corners[0];
    const Eigen::Vector2d b = corners[i + 1] - corners[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

// The part of the cell on one side of the line (sign +1 or -1); the cut side belongs to the line.
PlanCell halfOf(const PlanCell& cell, const PlanLine& line, int line_id, double sign,
                double tolerance) {
  PlanCell half;
  const std::size_t n = cell.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& a = cell.corners[i];
    const Eigen::Vector2d& b = cell.corners[(i + 1) % n];
    double da = sign * line.across(a);
    double db = sign * line.across(b);
    if (std::abs(da) <= tolerance) da = 0.0;
    if (std::abs(db) <= tolerance) db = 0.0;
    if (da >= 0.0) {
      half.corners.push_back(a);
      // Leaving at this very corner: what follows runs along the line.
      half.sides.push_back(da == 0.0 && db < 0.0 ? line_id : cell.sides[i]);
    }
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      half.corners.push_back(a + da / (da - db) * (b - a));
      half.sides.push_back(da > 0.0 ? line_id : cell.sides[i]);
    }
  }
  half.area = areaOf(half.corners);
  return half;
}

bool crosses(const PlanCell& cell, const PlanLine& line, double tolerance) {
  bool ahead = false;
  bool behind = false;
  for (const Eigen::Vector2d& corner : cell.corners) {
    const double d = line.across(corner);
    ahead = ahead || d > tolerance;
    behind = behind || d < -tolerance;
  }
  return ahead && behind;
}

struct SideInterval {
  double s_min;
  double s_max;
  int cell;
};

void appendEdges(std::vector<SideInterval>& behind, std::vector<SideInterval>& ahead, int line,
                 double tolerance, std::vector<PlanEdge>& edges) {
  const auto by_start = [](const SideInterval& a, const SideInterval& b) {
    return a.s_min < b.s_min;
  };
  std::sort(behind.begin(), behind.end(), by_start);
  std::sort(ahead.begin(), ahead.end(), by_start);
  for (std::size_t i = 0, j = 0; i < behind.size() && j < ahead.size();) {
    const double from = std::max(behind[i].s_min, ahead[j].s_min);
    const double to = std::min(behind[i].s_max, ahead[j].s_max);
    if (to - from > tolerance) edges.push_back({line, behind[i].cell, ahead[j].cell, from, to});
    (behind[i].s_max < ahead[j].s_max ? i : j) += 1;
  }
}

}  // namespace

LineArrangement arrangeLines(const std::vector<PlanLine>& lines, const Eigen::Vector2d& low,
                             const Eigen::Vector2d& high, double tolerance) {
  LineArrangement plan;
  plan.lines = lines;
  PlanCell box;
  box.corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  box.sides = {-1, -1, -1, -1};
  box.area = areaOf(box.corners);
  plan.cells.push_back(box);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::size_t count = plan.cells.size();
    for (std::size_t c = 0; c < count; ++c) {
      if (!crosses(plan.cells[c], lines[l], tolerance)) continue;
      const int id = static_cast<int>(l);
      PlanCell ahead = halfOf(plan.cells[c], lines[l], id, 1.0, tolerance);
      plan.cells[c] = halfOf(plan.cells[c], lines[l], id, -1.0, tolerance);
      plan.cells.push_back(std::move(ahead));
    }
  }
  std::vector<std::vector<SideInterval>> behind(lines.size());
  std::vector<std::vector<SideInterval>> ahead(lines.size());
  plan.at_border.assign(plan.cells.size(), 0);
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const PlanCell& cell = plan.cells[c];
    for (std::size_t i = 0; i < cell.corners.size(); ++i) {
      if (cell.sides[i] < 0) {
        plan.at_border[c] = 1;
        continue;
      }
      const auto l = static_cast<std::size_t>(cell.sides[i]);
      const double a = lines[l].tangent().dot(cell.corners[i]);
      const double b = lines[l].tangent().dot(cell.corners[(i + 1) % cell.corners.size()]);
      // A counter-clockwise cell behind the line runs along its tangent, one ahead against it.
      (b > a ? behind : ahead)[l].push_back({std::min(a, b), std::max(a, b), static_cast<int>(c)});
    }
  }
  for (std::size_t l = 0; l < lines.size(); ++l) {
    appendEdges(behind[l], ahead[l], static_cast<int>(l), tolerance, plan.edges);
  }
  return plan;
}

}  // namespace storey::detail
