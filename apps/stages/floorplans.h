// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/building_floorplan_extraction.h>

#include <vector>

#include "stages/stage_cloud.h"

namespace storey::stages {

/// Where the floorplans come from: the walls of the whole building, or slice by slice as the paper.
enum class Method { Building, Paper };

/// What counts, for method building. Areas in the squared unit of the cloud, 0: derived.
struct BlockOptions {
  double block_cost = 0.0;     ///< wall area that one more block must explain
  double min_wall_area = 0.0;  ///< least area of a wall that has points
};

/// How simple a model shall be. 0: no limit.
struct SimplicityOptions {
  int max_types = 0;       ///< of floorplans
  int max_faces = 0;       ///< polygons of the model
  bool trade_off = false;  ///< method building: find the whole trade-off
};

/// The floorplans of blocks from the walls of the whole building.
/// \param steps for experiments: those of the method that are left out
/// \return a line that says what was found \throws io::Failure (BadInput) if there is no building
std::string extractBlocks(StageCloud& cloud, const BlockOptions& options,
                          const SimplicityOptions& simplicity, unsigned int threads,
                          std::vector<FloorplanLayer>& blocks,
                          storey::detail::BuildingFloorplans& found,
                          const storey::detail::MethodSteps& steps = {});

/// The walls of a cloud: the wall of each point, and their lines. \param min_area 0: derived
/// \return a line that says what was found \throws io::Failure (BadInput) if there are none
std::string extractWalls(StageCloud& cloud, double min_area, unsigned int threads,
                         std::vector<storey::detail::WallLine>& lines);

}  // namespace storey::stages
