// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/boundary_complex.h>
#include <storey/surface/polyhedral_model.h>

#include <cstdint>
#include <vector>

namespace storey {
namespace detail {

/// Connected parts of the boundary that are planar within the strip (see `mergeFaces`).
/// \param known regions found before, to be united further; empty: none
/// \param counts vertex of the plan -> whether the strip must contain it
/// \return elementary face -> region; regions are numbered by their first elementary face
std::vector<int> findCoplanarRegions(const PlanArrangement& plan, const BoundaryComplex& boundary,
                                     const std::vector<FloorplanEdge>& sources, std::int64_t strip,
                                     const std::vector<int>& known,
                                     const std::vector<char>& counts);

}  // namespace detail
}  // namespace storey
