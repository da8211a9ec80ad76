// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/flat_face.h>

#include <array>

namespace storey {
namespace detail {

using LatticeTriangle = std::array<LatticePoint, 3>;

/// What two triangles have in common.
struct TriangleContact {
  enum Kind { Nothing, Point, Segment, Area } kind = Nothing;
  /// Segment: the edge (0: from corner 0 to 1, ...) of the first and the second triangle that it
  /// lies along, -1 if it runs through the interior.
  int edge_of_first = -1;
  int edge_of_second = -1;
};

/// Exact; the triangles must not be degenerate. Coplanar triangles give `Area` or `Nothing` (what
/// they share along edges is not looked at).
TriangleContact findContact(const LatticeTriangle& first, const LatticeTriangle& second);

}  // namespace detail
}  // namespace storey
