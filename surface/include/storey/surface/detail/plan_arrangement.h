// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/lattice.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace storey {
namespace detail {

using GridSegment = std::pair<GridPoint, GridPoint>;

/// The subdivision of the plane by segments, as half-edges: half-edges 2 e and 2 e + 1 are edge e
/// in both senses, `twin(h) = h ^ 1`. Edges end only in vertices and cross nowhere.
struct PlanArrangement {
  std::vector<GridPoint> vertices;         ///< ascending
  std::vector<int> origin;                 ///< half-edge -> vertex it starts from
  std::vector<int> next;                   ///< half-edge -> the next with the same cell on its left
  std::vector<int> cell;                   ///< half-edge -> cell on its left, -1: the unbounded one
  std::vector<std::vector<int>> outgoing;  ///< vertex -> half-edges, counter-clockwise
  std::vector<Eigen::Vector2d> interior;   ///< cell -> a point in its interior

  int target(int half_edge) const { return origin[static_cast<std::size_t>(half_edge ^ 1)]; }
  const GridPoint& from(int half_edge) const {
    return vertices[static_cast<std::size_t>(origin[static_cast<std::size_t>(half_edge)])];
  }
  const GridPoint& to(int half_edge) const {
    return vertices[static_cast<std::size_t>(target(half_edge))];
  }
};

/// Nodes the segments on the lattice (snap rounding by GEOS) and finds the cells. Segments that do
/// not separate two cells are left out. Empty if there is no cell.
PlanArrangement arrangeSegments(std::vector<GridSegment> segments);

}  // namespace detail
}  // namespace storey
