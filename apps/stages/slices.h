// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>
#include <storey/segmentation/slice_stages.h>

#include <vector>

#include "stages/stage_cloud.h"

namespace storey::stages {

// The paper's chain, stage by stage [Sui et al. 2016, section 3]: each takes what the one before it
// left in the cloud, changes the cloud, and returns a line that says what it found. The result does
// not depend on the number of threads.

/// Groups the planar wall points into slices. \param thickness 0: derived
std::string cutSlices(StageCloud& cloud, double thickness);

/// Leaves only the points of slices, slice by slice, with smoothed normals. They keep their
/// heights, so that all stages can be looked at over each other.
std::string smoothNormals(StageCloud& cloud, unsigned int threads);

/// The direction of each point. \throws io::Failure (BadInput) if the cloud has no directions
std::string labelPoints(StageCloud& cloud, unsigned int threads);

/// Regions of linked points of one direction, numbered through all slices.
std::string growRegions(StageCloud& cloud, unsigned int threads);

/// Moves the points onto their walls, and gives them the normals of their directions.
std::string refinePositions(StageCloud& cloud, unsigned int threads);

/// A slice that gave no floorplan.
struct SliceFailure {
  std::size_t slice = 0;
  std::string reason;
};

struct SliceFloorplans {
  std::vector<FloorplanLayer> layers;  ///< one a slice; empty plans where there is none
  std::vector<SliceFailure> failures;
};

/// \throws io::Failure (BadInput) if no slice has a floorplan
std::string outlineSlices(StageCloud& cloud, storey::detail::LinkingMethod linking,
                          unsigned int threads, SliceFloorplans& floorplans);

}  // namespace storey::stages
