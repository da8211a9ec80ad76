// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/boundary_complex.h>
#include <storey/surface/polyhedral_model.h>

#include <cstdint>
#include <vector>

namespace storey {
namespace detail {

/// Connected parts of the boundary that are planar within the strip (see `mergeFaces`).
/// \return elementary face -> region; regions are numbered by their first elementary face
std::vector<int> findCoplanarRegions(const PlanArrangement& plan, const BoundaryComplex& boundary,
                                     const std::vector<FloorplanEdge>& sources, std::int64_t strip);

}  // namespace detail
}  // namespace storey
