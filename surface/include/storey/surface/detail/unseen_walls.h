// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// The walls that have next to no points of their own: what `fitUnseenWalls` moves.
std::map<int, WallFit> unseenWalls(const std::vector<FloorplanLayer>& layers,
                                   const std::map<int, WallFit>& fits);

}  // namespace storey::detail
