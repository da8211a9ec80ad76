// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/cell_labels.h>
#include <storey/segmentation/detail/method_steps.h>
#include <storey/segmentation/detail/outline_trade_off.h>
#include <storey/segmentation/detail/wall_ends.h>
#include <storey/segmentation/detail/wall_input.h>
#include <storey/segmentation/floorplan.h>

#include <utility>
#include <vector>

namespace storey::detail {

struct BuildingFloorplanOptions {
  double min_wall_area = 0.0;  ///< least supported area of a wall, > 0
  double block_cost = 0.0;     ///< K, wall area that one more block must explain; 0: derived
  double min_area = 0.0;       ///< of a component or courtyard
  SimplicityLimits limits;
  MethodSteps steps = {};
  unsigned int threads = 0;  ///< 0: all cores; the result is the same for any number
};

struct BuildingFloorplans {
  std::vector<WallLine> walls;       ///< found in the points
  std::vector<PlanLine> hypotheses;  ///< lines for walls that were not seen
  std::vector<WallEnd> ends;         ///< of walls, which these lines pass
  LineArrangement plan;              ///< of walls and hypotheses; cells of the plan
  std::vector<std::size_t> levels;   ///< bins of the layers
  double gap = 0.0;                  ///< cost of a wall not seen that was worked with
  std::vector<CellBlock> blocks;
  std::vector<std::pair<double, double>> block_heights;  ///< z_min, z_max; parallel to `blocks`
  std::vector<OutlineTradeOff> trade_off;  ///< from the default towards simpler models
  std::vector<FloorplanLayer> layers;  ///< parallel to `blocks` that have an outline, bottom to top
};

/// The floorplans of a building from the walls of all of it at once (see
/// `BuildingFloorplanExtraction`). The sample of the points of walls votes for lines, all of them
/// count as evidence.
BuildingFloorplans extractBuildingFloorplans(const WallInput& input,
                                             const BuildingFloorplanOptions& options);

}  // namespace storey::detail
