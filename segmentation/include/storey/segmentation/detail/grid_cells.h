// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// The how-manieth cell of a regular grid along each axis; 0 along those that it does not have.
using GridCell = std::array<std::int64_t, 3>;

/// floor(place / side)
inline std::int64_t cellAlong(double place, double side) {
  const double at = place / side;
  const auto whole = static_cast<std::int64_t>(at);
  return static_cast<double>(whole) > at ? whole - 1 : whole;
}

/// The cells of a grid that something lies in, numbered as they come.
class GridCells {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// The number of the cell, a new one if it has none yet.
  std::size_t add(const GridCell& cell);
  /// The number of the cell, or `kNone`.
  std::size_t find(const GridCell& cell) const;

  std::size_t size() const { return cells_.size(); }
  const GridCell& operator[](std::size_t number) const { return cells_[number]; }

 private:
  std::size_t slotOf(const GridCell& cell) const;
  void grow();

  std::vector<GridCell> cells_;
  std::size_t last_ = 0;              // of those added: neighbours often follow each other
  std::vector<std::uint32_t> slots_;  // number + 1 of the cell there, 0: free
};

}  // namespace storey::detail
