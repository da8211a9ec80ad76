// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/boundary_complex.h>
#include <storey/surface/detail/grid_layers.h>

#include <vector>

namespace storey {
namespace detail {

/// All heights at which a layer begins or ends, ascending.
std::vector<std::int64_t> collectLevels(const std::vector<GridLayer>& layers);

/// Whether each cell is inside (even-odd rule, at its interior point) any layer of each slab.
SlabLabels labelCells(const PlanArrangement& plan, const std::vector<GridLayer>& layers);

/// What is known of each wall of the boundary: of the edge of a layer of its slab that is nearest
/// to it and runs along it. Parallel to `boundary.elements`; unknown (-1) for caps.
std::vector<FloorplanEdge> findSources(const PlanArrangement& plan, const SlabLabels& labels,
                                       const BoundaryComplex& boundary,
                                       const std::vector<GridLayer>& layers);

}  // namespace detail
}  // namespace storey
