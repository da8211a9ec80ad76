// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>

namespace storey::detail {

/// A hash of an oriented point by value: points sorted by it are in a random order that does not
/// depend on the order they came in.
inline std::uint64_t hashOfPoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  std::uint64_t hash = 0;
  for (const Eigen::Vector3d* vector : {&position, &normal}) {
    for (const double value : *vector) {
      const double unsigned_zero = value + 0.0;  // -0 and 0 are one value
      std::uint64_t bits = 0;
      std::memcpy(&bits, &unsigned_zero, sizeof bits);
      hash ^= bits;  // then the finalizer of splitmix64
      hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9ULL;
      hash = (hash ^ hash >> 27) * 0x94d049bb133111ebULL;
      hash = (hash ^ hash >> 31) + 0x9e3779b97f4a7c15ULL;
    }
  }
  return hash;
}

}  // namespace storey::detail
