// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/method_steps.h>
#include <storey/surface/dominant_floorplans.h>
#include <storey/surface/floorplan_fitting.h>
#include <storey/surface/model_check.h>
#include <storey/surface/polyhedral_model.h>

#include <map>
#include <vector>

namespace storey {

struct LayerwiseModelOptions {
  DominantFloorplanOptions dominant;
  double noise = 0.0;            ///< standard deviation of the points about their walls, > 0
  double slice_thickness = 0.0;  ///< > 0; heights are sought within 1.5 slices of a boundary
  double grid = 0.0;             ///< see extrudeFloorplans
  std::size_t max_faces = 0;     ///< of a model of slices: by fewer types; 0: no limit
  detail::MethodSteps steps;     ///< of the fits, for experiments
  unsigned int threads = 0;      ///< 0: all cores; the result is the same for any number
};

struct LayerwiseModel {
  DominantFloorplans dominant;
  std::map<int, WallFit> walls;   ///< by wall id
  std::vector<HeightFit> levels;  ///< foot to top
  /// Takes the points to the frame that walls, levels and model are in: the identity, or the small
  /// rotation that sets walls upright which lean together (`fitUpright`).
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  PolyhedralModel model;
  ModelCheck check;
};

/// The second room of the house: floorplans of slices to a checked solid. Dominant floorplans are
/// chosen (11)-(15), their walls and heights fitted to all points, and extruded. Where the model
/// has more than `max_faces` polygons, the same with one type less, down to a single one.
/// \return an empty model if no slice has a floorplan
LayerwiseModel buildLayerwiseModel(const std::vector<FloorplanLayer>& slices,
                                   const FitPoints& points, const LayerwiseModelOptions& options);

/// The same from blocks whose floorplans are chosen already (edges carry wall ids, as from
/// `BuildingFloorplanExtraction`): fit, extrusion and checks. Equal outlines are one type.
LayerwiseModel buildModelOfBlocks(const std::vector<FloorplanLayer>& blocks, FitPoints points,
                                  const LayerwiseModelOptions& options);

}  // namespace storey
