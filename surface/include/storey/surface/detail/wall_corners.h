// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Radians; where lines that turn by less cross is not well known.
constexpr double kMinTurn = 0.03;

/// Moves all corners to the intersections of the fitted lines. Neighbours of one wall are one edge.
/// Neighbours that are nearly parallel may cross anywhere: where that is further away than the
/// shorter of them is long, their corner is put on the line of the longer one, and the shorter one
/// loses its wall id. Where an edge would turn around, it or one of its neighbours is shorter than
/// their lines are off: the shortest of the three goes. A ring of which fewer than three edges
/// would be left keeps its corners and loses all its wall ids.
void moveCorners(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits);

/// The same of one ring, which stays as it is where fewer than three edges would be left.
/// \return false there
bool moveCorners(FloorplanRing& ring, const std::map<int, WallFit>& fits);

}  // namespace storey::detail
