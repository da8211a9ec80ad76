// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Moves all corners to the intersections of the fitted lines. An edge that would turn around is
/// shorter than its neighbours are off: it goes if it is shorter than they are; and so does the
/// shorter of two edges whose lines are nearly one. Where that does not help, the ring keeps its
/// corners and loses its wall ids.
void moveCorners(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits);

}  // namespace storey::detail
