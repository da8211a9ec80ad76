// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Gives walls one id, the smallest of theirs, that were taken for two and whose fitted lines turn
/// out to be one: they face the same way, have a part of their length in common, and all edges of the one
/// with fewer points are less than `apart` from the line of the other. \return whether there were
/// any
bool uniteStackedWalls(const std::map<int, WallFit>& fits, double apart,
                       std::vector<FloorplanLayer>& layers);

}  // namespace storey::detail
