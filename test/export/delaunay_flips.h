// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/lattice.h>

#include <array>
#include <vector>

namespace storey::test {

/// Makes a triangulation constrained Delaunay by flips of inner edges, exactly: no triangle is
/// left as a sliver that need not be one. Checkers of solids cut polygons so.
/// \param triangles counter-clockwise in the plane; indices into `points`, coordinates below 2^30
void flipToDelaunay(std::vector<std::array<int, 3>>& triangles,
                    const std::vector<detail::GridPoint>& points);

}  // namespace storey::test
