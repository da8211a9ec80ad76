// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/surface/detail/lattice.h>

#include <cstdint>
#include <string>
#include <vector>

namespace storey {
namespace detail {

/// An edge of a floorplan, or a piece of one, on the lattice.
struct GridEdge {
  GridPoint a;
  GridPoint b;
  FloorplanEdge source;
};

/// A layer on the lattice. Its rings need no order: inside and outside follow from the edges
/// alone (even-odd rule).
struct GridLayer {
  std::int64_t z_min = 0;
  std::int64_t z_max = 0;
  std::vector<GridEdge> edges;
};

/// Rounds layers to the lattice. A vertex (of any layer) that lies within one unit of an edge is
/// made a vertex of that edge, before rounding: collinear edges of stacked layers that overlap are
/// thus split at the same points and stay identical, instead of enclosing slivers one unit wide.
/// \param grid 0: derived from the extent
/// \param[out] lattice what the integers stand for
/// \param[out] error why the result is empty, if it is
std::vector<GridLayer> makeGridLayers(const std::vector<FloorplanLayer>& layers, double grid,
                                      Lattice& lattice, std::string& error);

}  // namespace detail
}  // namespace storey
