// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace storey {
namespace detail {

/// Lattice coordinates are kept below 2^30, so that a product of two differences fits into 63
/// bits and a square of such a product into a `Wide`.
__extension__ typedef __int128 Wide;

constexpr std::int64_t kMaxLatticeExtent = std::int64_t{1} << 30;  // grid units

/// A point of the plan in grid units.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend bool operator==(const GridPoint& a, const GridPoint& b) {
    return a.x == b.x && a.y == b.y;
  }
  friend bool operator!=(const GridPoint& a, const GridPoint& b) { return !(a == b); }
  friend bool operator<(const GridPoint& a, const GridPoint& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  }
  friend GridPoint operator+(const GridPoint& a, const GridPoint& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend GridPoint operator-(const GridPoint& a, const GridPoint& b) {
    return {a.x - b.x, a.y - b.y};
  }
};

inline std::int64_t cross(const GridPoint& a, const GridPoint& b) { return a.x * b.y - a.y * b.x; }
inline std::int64_t dot(const GridPoint& a, const GridPoint& b) { return a.x * b.x + a.y * b.y; }

/// Whether c lies left (> 0), right (< 0) or on (0) the line from a to b: twice the area of the
/// triangle.
inline std::int64_t orient(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return cross(b - a, c - a);
}

/// From one to the other of the two points that are furthest apart in x, or in y if the points
/// spread more in y.
std::pair<GridPoint, GridPoint> findChord(const std::vector<GridPoint>& points);

/// Whether all points lie in a strip of the given width (grid units) along their chord.
bool withinStrip(const std::vector<GridPoint>& points, std::int64_t width);

/// Which points of the cloud's frame the integers stand for: (origin + integer) * grid.
struct Lattice {
  double grid = 0.0;
  std::int64_t origin[3] = {0, 0, 0};  ///< grid units

  double toDouble(std::int64_t value, int axis) const {
    return static_cast<double>(origin[axis] + value) * grid;
  }
};

}  // namespace detail
}  // namespace storey
