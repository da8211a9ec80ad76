// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/line_arrangement.h>
#include <storey/segmentation/floorplan.h>

#include <vector>

namespace storey::detail {

/// Drops connected parts of the solid (components of neighbouring layers that overlap in plan) with
/// little support beside the best one: neighbours cut by the crop, cars, trees. Support is the area
/// of the walls that are not hypothetical.
/// \param keep share of the best part's support that a part needs
void dropWeakParts(const LineArrangement& plan, double keep, std::vector<FloorplanLayer>& layers);

}  // namespace storey::detail
