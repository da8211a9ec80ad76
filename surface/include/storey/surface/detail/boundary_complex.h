// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/plan_arrangement.h>

#include <cstdint>
#include <vector>

namespace storey {
namespace detail {

/// Which cells of the plan are inside the building, slab by slab: slab k lies between levels k and
/// k + 1.
struct SlabLabels {
  std::vector<std::int64_t> levels;       ///< ascending, one more than slabs
  std::vector<std::vector<char>> inside;  ///< [slab][cell]

  int numSlabs() const { return static_cast<int>(inside.size()); }
  int numLevels() const { return static_cast<int>(levels.size()); }
  /// False for the unbounded cell (-1) and for slabs below and above the building.
  bool solid(int cell, int slab) const {
    return cell >= 0 && slab >= 0 && slab < numSlabs() &&
           inside[static_cast<std::size_t>(slab)][static_cast<std::size_t>(cell)] != 0;
  }
};

enum class ElementKind { Wall, CapUp, CapDown };

/// An elementary face: an edge of the plan times a slab, or a cell at a level.
struct Element {
  ElementKind kind;
  int plan;  ///< wall: the half-edge that has the solid on its left; cap: the cell
  int z;     ///< wall: slab; cap: level
};

/// The boundary of a stack of cells, cut into elementary faces.
///
/// Notation: a *dart* is a directed edge of an elementary face that has the face on its left seen
/// from outside. A *corner* is a place where the surface may have a vertex: (vertex of the plan,
/// level). Where four or more faces meet at an edge they are paired so that each wedge of solid
/// keeps its own two; the darts then form a 2-manifold, and a corner at which it passes several
/// times has several *umbrellas*. `shell` numbers the connected parts of the manifold.
struct BoundaryComplex {
  std::vector<Element> elements;
  std::vector<int> element;  ///< dart -> elementary face
  std::vector<int> next;     ///< dart -> the next one of the same face
  std::vector<int> prev;
  std::vector<int> twin;  ///< dart -> the dart of the paired face, in the opposite sense
  std::vector<int>
      corner;  ///< dart -> corner it starts from, plan vertex * number of levels + level
  std::vector<int> umbrella;         ///< dart -> umbrella at that corner
  std::vector<int> umbrella_corner;  ///< umbrella -> corner
  std::vector<int> shell;            ///< elementary face -> shell

  std::size_t numDarts() const { return element.size(); }
  const Element& face(int dart) const {
    return elements[static_cast<std::size_t>(element[static_cast<std::size_t>(dart)])];
  }
};

/// A place where a shell touches itself: along a vertical edge (a == b, the contact lasts over the
/// slab), at one point (a == b), or along a horizontal edge between vertices a and b of the plan.
struct Pinch {
  int a;
  int b;
  int slab;      ///< the slab that is to be filled around the contact to make an end of it
  bool upright;  ///< a vertical edge, the height of the slab
};

BoundaryComplex buildBoundary(const PlanArrangement& plan, const SlabLabels& labels);

/// All contacts that have to be filled: those of one shell with itself, and those of shells that
/// the filling of others joins.
std::vector<Pinch> findPinches(const SlabLabels& labels, const BoundaryComplex& boundary);

}  // namespace detail
}  // namespace storey
