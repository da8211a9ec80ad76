// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/lattice.h>

#include <algorithm>

namespace storey {
namespace detail {

std::pair<GridPoint, GridPoint> findChord(const std::vector<GridPoint>& points) {
  const auto by_y = [](const GridPoint& a, const GridPoint& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  };
  const auto x_ends = std::minmax_element(points.begin(), points.end());
  const auto y_ends = std::minmax_element(points.begin(), points.end(), by_y);
  const bool along_x = x_ends.second->x - x_ends.first->x >= y_ends.second->y - y_ends.first->y;
  const auto& ends = along_x ? x_ends : y_ends;
  return {*ends.first, *ends.second};
}

bool withinStrip(const std::vector<GridPoint>& points, std::int64_t width) {
  if (points.size() < 3) return true;
  const auto [a, b] = findChord(points);
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (const GridPoint& p : points) {
    const std::int64_t area = orient(a, b, p);
    low = std::min(low, area);
    high = std::max(high, area);
  }
  const Wide spread = static_cast<Wide>(high) - low;
  return spread * spread <= static_cast<Wide>(dot(b - a, b - a)) * width * width;
}

}  // namespace detail
}  // namespace storey
