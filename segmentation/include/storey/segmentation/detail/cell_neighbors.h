// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace storey::detail {

/// The cells across the edges of each cell of a plan, together in memory.
class CellNeighbors {
 public:
  explicit CellNeighbors(const LineArrangement& plan) : first_(plan.cells.size() + 1, 0) {
    for (const PlanEdge& edge : plan.edges) {
      ++first_[static_cast<std::size_t>(edge.behind) + 1];
      ++first_[static_cast<std::size_t>(edge.ahead) + 1];
    }
    for (std::size_t c = 0; c < size(); ++c) first_[c + 1] += first_[c];
    cells_.resize(first_.back());
    std::vector<std::uint32_t> next = first_;
    for (const PlanEdge& edge : plan.edges) {
      const auto behind = static_cast<std::size_t>(edge.behind);
      const auto ahead = static_cast<std::size_t>(edge.ahead);
      cells_[next[behind]++] = static_cast<std::uint32_t>(ahead);
      cells_[next[ahead]++] = static_cast<std::uint32_t>(behind);
    }
  }

  /// Number of cells.
  std::size_t size() const { return first_.size() - 1; }

  /// Calls `visit(neighbor)` for each edge of the cell.
  template <typename Visit>
  void forEach(std::size_t cell, const Visit& visit) const {
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      visit(static_cast<std::size_t>(cells_[i]));
    }
  }

 private:
  std::vector<std::uint32_t> first_;  // of each cell's
  std::vector<std::uint32_t> cells_;
};

}  // namespace storey::detail
