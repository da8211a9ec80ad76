// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <vector>

/// Triangles as files without shared vertices hold them.
namespace storey::test {

using TriangleSoup = std::vector<std::array<Eigen::Vector3d, 3>>;

/// About the first corner: far from the origin nothing is left of the products.
inline double volumeOf(const TriangleSoup& soup) {
  double volume = 0.0;
  for (const auto& [a, b, c] : soup) {
    const Eigen::Vector3d& o = soup[0][0];
    volume += (a - o).dot((b - o).cross(c - o)) / 6.0;
  }
  return volume;
}

/// Whether each edge is run as often in one sense as in the other, where corners are the same only
/// if all their digits are.
inline bool isClosed(const TriangleSoup& soup) {
  using Corner = std::array<double, 3>;
  const auto key = [](const Eigen::Vector3d& v) { return Corner{v.x(), v.y(), v.z()}; };
  std::map<std::pair<Corner, Corner>, int> balance;
  for (const auto& triangle : soup) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner a = key(triangle[i]);
      const Corner b = key(triangle[(i + 1) % 3]);
      if (a == b) return false;  // an edge that has fallen to a point
      balance[{a, b}] += 1;
      balance[{b, a}] -= 1;
    }
  }
  for (const auto& [edge, count] : balance) {
    if (count != 0) return false;
  }
  return !soup.empty();
}

}  // namespace storey::test
