// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace storey {

/// What is known of one edge of a floorplan.
struct FloorplanEdge {
  int wall = -1;              ///< edges with the same id >= 0 lie in one vertical plane, whatever
                              ///< their ring, component or layer; -1: a plane of its own
  bool hypothetical = false;  ///< put in by completion, not seen in the points
};

/// A closed polygon, implicitly closed: edge i runs from vertex i to vertex i + 1 (mod n).
struct FloorplanRing {
  std::vector<Eigen::Vector2d> vertices;  ///< n >= 3, in the horizontal plane of the cloud's frame
  std::vector<FloorplanEdge> edges;       ///< n, parallel to `vertices`

  std::size_t size() const { return vertices.size(); }
};

/// A connected part of a floorplan: its outer ring runs counter-clockwise, its holes (courtyards)
/// clockwise, so that the building is always on the left of an edge.
struct FloorplanComponent {
  FloorplanRing outer;
  std::vector<FloorplanRing> holes;
};

/// The outline of a building at one height. Components have disjoint interiors.
struct Floorplan {
  std::vector<FloorplanComponent> components;

  bool empty() const { return components.empty(); }
};

/// A floorplan that holds between two heights. This is the one door between the rooms of the
/// house: the sources of floorplans (slices, or the walls of the whole building) put a
/// `std::vector<FloorplanLayer>` together, ordered bottom to top with disjoint ranges, and all that
/// comes after (heights, fit, solid, checks, writers) reads nothing else.
struct FloorplanLayer {
  double z_min = 0.0;
  double z_max = 0.0;
  Floorplan plan;
};

/// Area enclosed by a ring, positive if it runs counter-clockwise (shoelace formula).
double signedArea(const FloorplanRing& ring);

/// Area of the floorplan: outer rings less holes.
double area(const Floorplan& plan);

/// Length of all edges, holes included.
double perimeter(const Floorplan& plan);

/// Whether the point lies inside an outer ring and outside its holes (even-odd rule). Points on
/// an edge may fall to either side.
bool contains(const Floorplan& plan, const Eigen::Vector2d& point);

/// Number of edges of all rings.
std::size_t countEdges(const Floorplan& plan);

}  // namespace storey
