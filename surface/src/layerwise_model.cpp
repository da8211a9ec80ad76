// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/extrusion.h>
#include <storey/surface/layerwise_model.h>

namespace storey {
namespace {

// A boundary lies in the slice that straddles it or in one of its neighbours.
constexpr double kHeightSearchInSlices = 1.5;

}  // namespace

LayerwiseModel buildLayerwiseModel(const std::vector<FloorplanLayer>& slices,
                                   const FitPoints& points,
                                   const LayerwiseModelOptions& options) {
  LayerwiseModel result;
  result.dominant = selectDominantFloorplans(slices, options.dominant);
  std::vector<FloorplanLayer> layers = result.dominant.blocks;
  if (layers.empty()) return result;

  FitOptions fit;
  fit.noise = options.noise;
  fit.max_shift = kHeightSearchInSlices * options.slice_thickness;
  fitWalls(layers, points, fit);
  fitHeights(layers, points, fit);
  result.walls = fitWalls(layers, points, fit);  // now each point in the layer that it is of
  fit.max_shift = 0.5 * options.slice_thickness;
  fitHeights(layers, points, fit);

  result.model = extrudeFloorplans(layers, options.grid);
  result.check = checkModel(result.model);
  return result;
}

}  // namespace storey
