// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/boundary_complex.h>
#include <storey/surface/polyhedral_model.h>

#include <vector>

namespace storey {
namespace detail {

/// Rounding moves a point by at most 1/sqrt(2) units: points of one wall lie in a strip of 2 units.
constexpr std::int64_t kPlanarStrip = 2;  // grid units

/// Merges elementary faces of the same plane to polygons and leaves out the corners at which less
/// than three polygons meet.
/// \param strip walls are of the same plane if their vertices lie in a vertical strip of this
///        width, in grid units; 0: only if they are exactly coplanar
/// \param sources parallel to `boundary.elements`: what is known of a wall
PolyhedralModel mergeFaces(const PlanArrangement& plan, const SlabLabels& labels,
                           const BoundaryComplex& boundary,
                           const std::vector<FloorplanEdge>& sources, const Lattice& lattice,
                           std::int64_t strip);

}  // namespace detail
}  // namespace storey
