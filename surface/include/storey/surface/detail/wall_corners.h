// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Moves all corners to the intersections of the fitted lines. Neighbours that are nearly parallel
/// may cross anywhere: where that is further away than the shorter of them is long, their corner is
/// put on the line of the longer one, and the shorter one loses its wall id. An edge that would
/// turn around is shorter than its neighbours are off: it goes if it is shorter than they are.
/// Where that is not so, the ring keeps its corners and loses all its wall ids.
void moveCorners(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits);

}  // namespace storey::detail
