// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

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

}  // namespace storey::io
