// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// The inner loops of the search for neighbours, over plain arrays, compiled for several
// instruction sets and chosen at run time. All give the same bytes: no sum depends on the width of
// a register.
namespace storey::detail {

/// Positions stand in blocks of so many; arrays are padded to a multiple of it.
constexpr std::size_t kLanes = 16;

/// One array for each coordinate; block b begins at b `kLanes`.
struct Coordinates {
  const float* x;
  const float* y;
  const float* z;
};

/// An axis-parallel box by its corners, or a position where both are the same.
struct Corners {
  const float* low;
  const float* high;
};

/// Writes the places of the boxes that come within a squared distance of another, ascending, and
/// returns their number; `places` has room for n + 8.
/// \param sides low x, y, z, then high x, y, z of n boxes, n a multiple of `kLanes`
std::size_t boxesWithin(const std::array<const float*, 6>& sides, std::size_t n, const Corners& box,
                        float squared_reach, std::uint32_t* places);

/// Copies the positions of some blocks that come within a squared distance of a box, in their
/// order, and returns their number. \param chosen x, y and z, with room for 8 more than there are
std::size_t positionsWithin(const Coordinates& positions, const std::uint32_t* blocks,
                            std::size_t num_blocks, const Corners& box, float squared_reach,
                            const std::array<float*, 3>& chosen);

/// Squared distances from q to all positions of some blocks.
void squaredDistances(const Coordinates& positions, const std::uint32_t* blocks,
                      std::size_t num_blocks, const float* q, float* squared);

/// A limit that exactly k of n values, a multiple of `kLanes`, do not exceed, found by counting;
/// NaN if there is none to be found, because of ties. \param guess > 0
float limitOf(const float* values, std::size_t n, std::size_t k, float guess);

/// Writes the places of the values that are at most `limit`, ascending, and returns their number;
/// `places` has room for n + 8.
std::size_t placesWithin(const float* values, std::size_t n, float limit, std::uint32_t* places);

/// A number for each of `kLanes` queries, in one line of the cache.
struct alignas(kLanes * sizeof(float)) Lanes {
  std::array<float, kLanes> of;
};

/// For each lane first and second moments of its neighbours about its query: of x, y, z, xx, xy,
/// xz, yy, yz and zz, added one neighbour after the other.
using MomentLanes = std::array<std::array<double, kLanes>, 9>;

/// Finds the k nearest among n candidates for each of `kLanes` queries, and their moments.
/// \param queries x, y and z \param guess > 0, of the squared distance to the k-th
/// \param[out] squared distances of each candidate
/// \param[out] limits squared, within which exactly the k nearest lie; NaN where there is none,
/// because of ties, and the moments mean nothing
void momentsOfNearest(const Coordinates& candidates, std::size_t n,
                      const std::array<Lanes, 3>& queries, std::size_t k, float guess,
                      Lanes* squared, Lanes& limits, MomentLanes& moments);

}  // namespace storey::detail
