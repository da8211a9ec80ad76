// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_file.h"
#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// Writes what came after the clouds of the stages, in the upright local frame: the floorplans as
/// `09_floorplans.geojson` (as storey_floorplans) and as lines in 09_floorplans.vtk, by default
/// also the walls found and the cells of the plan as 09_walls.geojson and 09_cells.geojson, the
/// model as 11_model.vtk, and coloured by what the points show of each face as 11_support.vtk,
/// and the points by their distance from it as 11_points.pcd.
/// \throws io::Failure
void writeIntermediate(const io::OutputDirectory& directory, const Options& options,
                       const Result& result);

}  // namespace storey::reconstruct
