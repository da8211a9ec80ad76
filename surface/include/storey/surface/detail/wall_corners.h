// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Moves all corners to the intersections of the fitted lines. A ring whose edges would turn around
/// keeps its corners and loses its wall ids.
void moveCorners(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits);

}  // namespace storey::detail
