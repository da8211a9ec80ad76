// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <string>
#include <vector>

#include "stages/floorplans.h"
#include "stages/stage_cloud.h"

namespace storey::stages {

/// Floorplans on their way to a model.
struct StageFloorplans {
  Method method = Method::Building;    ///< whose they are: of blocks, or of slices
  std::vector<FloorplanLayer> layers;  ///< bottom to top, in the upright frame of the cloud
  StageState state;                    ///< its frame, CRS, noise and density
};

/// Writes floorplans as GeoJSON: a Feature for each layer with z_min, z_max and, nested polygon /
/// ring / edge, the wall ids and what is hypothetical. Coordinates are those of the upright local
/// frame, exactly as later stages need them; `frame_to_input` takes them to the input's.
/// \throws io::Failure (CannotCreate, IoError)
void writeFloorplans(const std::string& path, const StageFloorplans& floorplans);

/// Reads what `writeFloorplans` wrote. \throws io::Failure (BadInput, MissingInput, IoError)
StageFloorplans readFloorplans(const std::string& path);

}  // namespace storey::stages
