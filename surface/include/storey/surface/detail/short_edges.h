// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_fitting.h>

#include <map>
#include <vector>

namespace storey::detail {

/// Takes edges away that are shorter than `least` now that all corners are where the fitted lines
/// cross, or of no wall: what an outline had there was the noise of its lines. The neighbours of
/// one meet where their lines do; of neighbours that are nearly parallel, two parts of one wall
/// with a step between them, the shorter goes too. Only where no corner, of before or after, is
/// further than `least` from the other outline; and no ring loses its last three edges.
void dropShortEdges(std::vector<FloorplanLayer>& layers, const std::map<int, WallFit>& fits,
                    double least);

}  // namespace storey::detail
