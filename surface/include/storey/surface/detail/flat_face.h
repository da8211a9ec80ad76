// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/lattice.h>
#include <storey/surface/polyhedral_model.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace storey {
namespace detail {

using LatticePoint = std::array<std::int64_t, 3>;  // grid units

/// The integers that a vertex stands for; nothing if it is not finite or too far out to be exact.
std::optional<LatticePoint> latticeIndex(const Eigen::Vector3d& vertex, double grid);

/// The same relative to an origin; nothing also if it is further from it than
/// `kMaxLatticeExtent`.
std::optional<LatticePoint> toLattice(const Eigen::Vector3d& vertex, double grid,
                                      const LatticePoint& origin);

/// A vertex of a face in the coordinates of its plane. For a wall u runs along it, scaled by the
/// length of its chord, so that it stays an integer (below 2^62).
struct FlatVertex {
  int index = 0;  ///< in the model
  std::int64_t u = 0;
  std::int64_t v = 0;

  bool at(const FlatVertex& other) const { return u == other.u && v == other.v; }
};

/// > 0 if c lies left of the line from a to b.
Wide orient(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c);

using FlatRing = std::vector<FlatVertex>;

/// A face in its plane, seen from outside: the outer ring (first) counter-clockwise.
/// \return the rings; empty if an index is out of range, a vertex off the lattice's range, or the
/// outer ring encloses no area
std::vector<FlatRing> flattenFace(const PolyhedralModel& model, const PolyhedralFace& face);

Wide twiceArea(const FlatRing& ring);

/// Whether the rings bound a polygon: no edge meets another one but at common vertices, holes run
/// clockwise and lie inside the outer ring and outside each other.
bool isPolygon(const std::vector<FlatRing>& rings);

}  // namespace detail
}  // namespace storey
