// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "synth/outlines.h"

namespace storey::synth {

/// How far apart things must be in a random building, so that its truth can be told from noise.
struct BuildingRules {
  double shortest_edge = 1.2;
  double between_edges = 1.2;     ///< edges of one storey that are no neighbours
  double between_planes = 0.7;    ///< parallel walls anywhere, unless they are one plane
  double between_storeys = 0.7;   ///< corners to the edges of the next storey, unless on them
  double sharpest_corner = 0.25;  ///< rad, of a corner and of its deviation from a straight angle
};

/// Whether the stages make a building: simple outlines, courtyards inside, components apart, each
/// component above another of the layer below, and all distances as the rules want them.
bool obeysRules(const std::vector<Stage>& stages, const BuildingRules& rules);

}  // namespace storey::synth
