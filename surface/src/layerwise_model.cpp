// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/extrusion.h>
#include <storey/surface/layerwise_model.h>

#include <algorithm>
#include <set>

namespace storey {
namespace {

// A boundary lies in the slice that straddles it or in one of its neighbours.
constexpr double kHeightSearchInSlices = 1.5;

// Walls and heights of the blocks, the solid, its checks.
void fitAndExtrude(const FitPoints& points, const LayerwiseModelOptions& options,
                   LayerwiseModel& result) {
  std::vector<FloorplanLayer> layers = result.dominant.blocks;
  if (layers.empty()) return;
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
}

// The walls of an outline, whatever corner and component come first.
std::multiset<int> wallsOf(const Floorplan& plan) {
  std::multiset<int> walls;
  for (const FloorplanComponent& component : plan.components) {
    for (const FloorplanEdge& edge : component.outer.edges) walls.insert(edge.wall);
    for (const FloorplanRing& hole : component.holes) {
      for (const FloorplanEdge& edge : hole.edges) walls.insert(edge.wall);
    }
  }
  return walls;
}

}  // namespace

LayerwiseModel buildLayerwiseModel(const std::vector<FloorplanLayer>& slices,
                                   const FitPoints& points, const LayerwiseModelOptions& options) {
  LayerwiseModel result;
  result.dominant = selectDominantFloorplans(slices, options.dominant);
  fitAndExtrude(points, options, result);
  return result;
}

LayerwiseModel buildModelOfBlocks(const std::vector<FloorplanLayer>& blocks,
                                  const FitPoints& points, const LayerwiseModelOptions& options) {
  LayerwiseModel result;
  result.dominant.blocks = blocks;
  std::vector<std::multiset<int>> types;
  for (const FloorplanLayer& block : blocks) {
    const std::multiset<int> walls = wallsOf(block.plan);
    const auto known = std::find(types.begin(), types.end(), walls);
    result.dominant.types.push_back(static_cast<int>(known - types.begin()));
    if (known == types.end()) types.push_back(walls);
  }
  result.dominant.num_types = static_cast<int>(types.size());
  result.dominant.num_candidates = result.dominant.num_types;
  fitAndExtrude(points, options, result);
  return result;
}

}  // namespace storey
