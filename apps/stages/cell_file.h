// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/building_floorplans.h>

#include <string>

#include "stages/stage_cloud.h"

namespace storey::stages {

/// Writes the cells that the walls cut the plan into as GeoJSON: a Feature for each, with its
/// number and, in `inside`, the numbers of the blocks in which it is inside the building. The
/// collection's `blocks` are z_min and z_max of each block, bottom to top; coordinates those of the
/// upright local frame. \throws io::Failure (CannotCreate, IoError)
void writeCells(const std::string& path, const storey::detail::BuildingFloorplans& found,
                const StageState& state);

}  // namespace storey::stages
