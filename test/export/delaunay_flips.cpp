// SPDX-License-Identifier: BSD-3-Clause
#include "export/delaunay_flips.h"

#include <map>

namespace storey::test {
namespace {

using detail::GridPoint;
using detail::Wide;
using Triangle = std::array<int, 3>;

// > 0 if d lies inside the circle through a, b, c, which run counter-clockwise.
Wide inCircle(GridPoint a, GridPoint b, GridPoint c, const GridPoint& d) {
  a = a - d;
  b = b - d;
  c = c - d;
  return static_cast<Wide>(dot(a, a)) * cross(b, c) + static_cast<Wide>(dot(b, b)) * cross(c, a) +
         static_cast<Wide>(dot(c, c)) * cross(a, b);
}

// Flips one edge that is not Delaunay; false if there is none.
bool flipOne(std::vector<Triangle>& triangles, const std::vector<GridPoint>& points) {
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  std::map<std::pair<int, int>, std::pair<std::size_t, int>> darts;  // to triangle and far corner
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      darts[{triangles[t][i], triangles[t][(i + 1) % 3]}] = {t, triangles[t][(i + 2) % 3]};
    }
  }
  for (const auto& [edge, left] : darts) {
    const auto right = darts.find({edge.second, edge.first});
    if (right == darts.end()) continue;
    const auto [a, b] = edge;
    const int c = left.second;
    const int d = right->second.second;
    if (orient(at(a), at(d), at(c)) <= 0 || orient(at(d), at(b), at(c)) <= 0) continue;
    if (inCircle(at(a), at(b), at(c), at(d)) <= 0) continue;
    triangles[left.first] = {a, d, c};
    triangles[right->second.first] = {d, b, c};
    return true;
  }
  return false;
}

}  // namespace

void flipToDelaunay(std::vector<Triangle>& triangles, const std::vector<GridPoint>& points) {
  while (flipOne(triangles, points)) {
  }
}

}  // namespace storey::test
