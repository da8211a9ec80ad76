// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace storey::io {

/// A bijection of 64-bit numbers that spreads every input bit over the output (the finaliser of
/// splitmix64, Steele, Lea and Flood 2014).
inline std::uint64_t mixBits(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// Of the position at these three numbers, as good as random.
inline std::uint64_t hashPosition(const double* position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, position + axis, sizeof bits);
    hash = mixBits(hash ^ bits);
  }
  return hash;
}

/// Numbers distinct positions 0, 1, 2, ... in the order of their first coming: an open hash table,
/// O(1) a point however many share a place.
class PointIndex {
 public:
  using Position = std::array<float, 3>;

  /// \param capacity at least the number of distinct positions, below 2^31
  explicit PointIndex(std::uint64_t capacity) {
    std::uint64_t slots = 16;
    while (slots < 2 * capacity) slots *= 2;
    slots_.assign(slots, kEmpty);
    positions_.reserve(capacity);
  }

  /// Has the table ready for a position that will be asked for soon: it lies all over memory.
  void prefetch(const Position& position) const {
    __builtin_prefetch(&slots_[hash(position) & (slots_.size() - 1)]);
  }

  /// The number of this position; a new one is added. Positions must be finite, and zeros positive.
  std::uint32_t findOrAdd(const Position& position) {
    const std::uint64_t mask = slots_.size() - 1;
    for (std::uint64_t slot = hash(position) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kEmpty) {
        slots_[slot] = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(position);
        return slots_[slot];
      }
      if (positions_[slots_[slot]] == position) return slots_[slot];
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  static std::uint64_t hash(const Position& position) {
    std::uint32_t bits[3];
    std::memcpy(bits, position.data(), sizeof bits);
    return mixBits(mixBits(std::uint64_t{bits[0]} << 32 | bits[1]) ^ bits[2]);
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Position> positions_;
};

}  // namespace storey::io
