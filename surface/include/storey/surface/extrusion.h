// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/surface/polyhedral_model.h>

#include <vector>

namespace storey {

/// The closed solid of a stack of floorplans: each layer's outline between its two heights, all
/// of it on the integer lattice of spacing `grid` [doc/method.md, deviation 9].
///
/// All outlines are noded together into one arrangement, so that walls and caps of neighbouring
/// layers use the same vertices; each (cell, layer) is inside or outside, and what lies between
/// the two is the surface. It is therefore closed whatever the outlines are; rings are read by the
/// even-odd rule, layers that overlap in height are united, gaps between layers stay gaps.
/// Vertices and heights move by about one grid unit at most: vertices closer than one unit to an
/// edge are put on it, cells narrower than two units go with a neighbour. Coplanar neighbours are
/// one face; walls count as coplanar if a strip of two units holds them. If walls merged so get in
/// each other's way (`checkModel` objects) only exactly coplanar ones are merged.
/// Layers thinner than the grid after rounding vanish.
///
/// Parts that touch only along an edge or at a point become separate shells. Where a part touches
/// *itself* that way (no 2-manifold in space) a small plug fills the contact: a diamond of half
/// diagonal extent / 4096 (4 to 256 grid units, a third of a short edge there) over one layer's
/// height, along a horizontal contact a bar; its walls are marked hypothetical. What is still in
/// contact after three rounds is filled by whole cells. `PolyhedralModel::storeys` keeps the layers
/// as given.
///
/// A face down is `Ground` where a whole connected part of a layer stands on nothing and nothing
/// of the building is below it, else `Ceiling`. A wall face takes the wall id, and whether it is
/// hypothetical, from the larger part of its area.
///
/// \param layers at least one with z_min < z_max and a non-empty floorplan; finite coordinates
/// \param grid in the unit of the layers, > 0; 0 (default): 2^-20 of the largest extent, rounded
///        up to a power of ten. The extent must be below 2^30 grid units.
/// \return empty, after a PCL_ERROR, if the input is not as above or nothing is left on the grid
/// \par Deterministic Vertices and faces are ordered by geometry alone, whatever the order of
/// components and rings.
PolyhedralModel extrudeFloorplans(const std::vector<FloorplanLayer>& layers, double grid = 0.0);

}  // namespace storey
