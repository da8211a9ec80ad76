// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/grid_cells.h>

namespace storey::detail {
namespace {

constexpr std::size_t kFirstSlots = 1024;  // a power of 2, as all numbers of slots

std::uint64_t hashOf(const GridCell& cell) {
  std::uint64_t hash = 0;
  for (const std::int64_t along : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(along)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

// Inline, where the operator of arrays calls a function.
bool areSame(const GridCell& a, const GridCell& b) {
  return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

}  // namespace

std::size_t GridCells::add(const GridCell& cell) {
  if (!cells_.empty() && areSame(cells_[last_], cell)) return last_;
  if (2 * (cells_.size() + 1) > slots_.size()) grow();
  const std::size_t slot = slotOf(cell);
  if (slots_[slot] == 0) {
    cells_.push_back(cell);
    slots_[slot] = static_cast<std::uint32_t>(cells_.size());
  }
  last_ = slots_[slot] - 1;
  return last_;
}

std::size_t GridCells::find(const GridCell& cell) const {
  if (cells_.empty()) return kNone;
  const std::uint32_t number = slots_[slotOf(cell)];
  return number == 0 ? kNone : number - 1;
}

// Where the cell is, or the free slot where it would be.
std::size_t GridCells::slotOf(const GridCell& cell) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hashOf(cell) & mask;
  while (slots_[slot] != 0 && !areSame(cells_[slots_[slot] - 1], cell)) slot = (slot + 1) & mask;
  return slot;
}

void GridCells::grow() {
  slots_.assign(slots_.empty() ? kFirstSlots : 2 * slots_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    slots_[slotOf(cells_[c])] = static_cast<std::uint32_t>(c + 1);
  }
}

}  // namespace storey::detail
