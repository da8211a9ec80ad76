// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/wall_points.h>

#include <string>
#include <vector>

#include "stages/stage_cloud.h"

namespace storey::stages {

/// Writes walls as GeoJSON: a Feature for each, whose lines are where it was seen in plan (the
/// building on the left), with its number as in the cloud's field `wall`, normal, offset, heights,
/// area, points and residual. Coordinates are those of the upright local frame; `frame_to_input`
/// takes them to the input's. \throws io::Failure (CannotCreate, IoError)
void writeWalls(const std::string& path, const std::vector<storey::detail::WallLine>& walls,
                const StageState& state);

}  // namespace storey::stages
