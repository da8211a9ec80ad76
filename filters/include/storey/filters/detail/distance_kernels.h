// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// The inner loops of the search for neighbours, over plain arrays, compiled for several
// instruction sets and chosen at run time. All give the same bytes: no sum depends on the width of
// a register.
namespace storey::detail {

/// Arrays are padded to a multiple of this.
constexpr std::size_t kLanes = 16;

/// Squared distances from q to n positions, n a multiple of `kLanes`.
void squaredDistances(const float* x, const float* y, const float* z, std::size_t n, const float* q,
                      float* squared);

/// Squared distances to n positions from the box between two corners, 0 inside.
void squaredDistancesToBox(const float* x, const float* y, const float* z, std::size_t n,
                           const float* low, const float* high, float* squared);

/// How many of n values, n a multiple of `kLanes`, are at most `limit`.
std::size_t countWithin(const float* values, std::size_t n, float limit);

/// Writes the places of the values that are at most `limit`, ascending, and returns their number;
/// `places` has room for n + 8.
std::size_t placesWithin(const float* values, std::size_t n, float limit, std::uint32_t* places);

/// First and second moments of positions about some point.
struct Moments {
  double count = 0.0;
  std::array<double, 3> sum{};       ///< x, y, z
  std::array<double, 6> products{};  ///< xx, xy, xz, yy, yz, zz
};

/// Moments of n positions about q; n is padded with copies of q to a multiple of `kLanes`, which
/// add nothing but to the count, so that is given.
Moments momentsAbout(const float* x, const float* y, const float* z, std::size_t n, const float* q,
                     std::size_t count);

}  // namespace storey::detail
