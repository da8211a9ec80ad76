// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/even_draw.h>
#include <storey/surface/detail/divided_walls.h>
#include <storey/surface/detail/fitted_model.h>
#include <storey/surface/detail/points_by_wall.h>
#include <storey/surface/detail/short_edges.h>
#include <storey/surface/detail/stacked_walls.h>
#include <storey/surface/layerwise_model.h>

#include <algorithm>
#include <set>
#include <utility>

namespace storey {
namespace {

// A boundary lies in the slice that straddles it or in one of its neighbours.
constexpr double kHeightSearchInSlices = 1.5;
constexpr int kFirstRounds = 2;               // without panes, which are looked for afterwards
constexpr std::size_t kFirstPoints = 100000;  // tell lines and heights to a part of the noise
constexpr double kOneWall = 1.0;              // noise deviations between lines of one wall, at most
constexpr double kShortEdge = 3.0;  // noise deviations: a face as narrow is noise of others

// Turns the points by what the walls lean. \return the rotation
Eigen::Isometry3d setUpright(const std::vector<FloorplanLayer>& layers,
                             const LayerwiseModelOptions& options, FitPoints& points,
                             detail::PointsByWall& by_wall) {
  if (!options.steps.upright) return Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d upright =
      detail::fitUpright(layers, points, options.noise, options.threads, by_wall);
  if (upright.matrix().isIdentity(0.0)) return upright;
  detail::turnPoints(upright, options.threads, points);
  by_wall = {};
  return upright;
}

// Walls and heights well enough that each point is given to the wall and the layer that it is of.
void fitFirst(const FitPoints& points, FitOptions options, std::vector<FloorplanLayer>& layers) {
  options.rounds = kFirstRounds;
  options.find_panes = false;
  const FitPoints some{detail::drawEvenly(points.positions, kFirstPoints),
                       detail::drawEvenly(points.normals, kFirstPoints)};
  fitWalls(layers, some, options);
  fitHeights(layers, some, options);
}

// Walls and heights of the blocks, the solid, its checks.
void fitAndExtrude(FitPoints points, const LayerwiseModelOptions& options, LayerwiseModel& result) {
  std::vector<FloorplanLayer> layers = result.dominant.blocks;
  if (layers.empty()) return;
  FitOptions fit;
  fit.noise = options.noise;
  fit.share_directions = options.steps.shared_directions;
  fit.find_panes = options.steps.panes;
  fit.max_shift = kHeightSearchInSlices * options.slice_thickness;
  fit.threads = options.threads;
  detail::PointsByWall by_wall;  // each in the layer that it is of, after the first fit
  fitFirst(points, fit, layers);
  result.upright = setUpright(layers, options, points, by_wall);
  result.walls = detail::fitWalls(layers, points, fit, by_wall);
  if (options.steps.facets &&
      detail::uniteStackedWalls(result.walls, kOneWall * options.noise, layers)) {
    result.walls = detail::fitWalls(layers, points, fit, by_wall);
  }
  if (options.steps.divided_walls &&
      detail::divideWalls(by_wall, result.walls, options.noise, options.threads, layers)) {
    result.walls = detail::fitWalls(layers, points, fit, by_wall);
  }
  by_wall = {};
  fit.noise = detail::noiseOfWalls(result.walls, options.noise);
  if (options.steps.unseen_walls) {
    fitUnseenWalls(layers, points, fit.noise, result.walls, options.threads);
  }
  if (options.steps.facets) detail::dropShortEdges(layers, result.walls, kShortEdge * fit.noise);
  fit.max_shift = 0.5 * options.slice_thickness;
  result.levels = fitHeights(layers, points, fit);
  detail::extrudeFits(layers, points, fit.noise, options, result);
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
  while (options.max_faces > 0 && result.model.faces.size() > options.max_faces &&
         result.dominant.num_types > 1) {
    DominantFloorplanOptions fewer = options.dominant;
    fewer.max_types = static_cast<std::size_t>(result.dominant.num_types) - 1;
    const DominantFloorplans whole = std::move(result.dominant);
    result = {};
    result.dominant = selectDominantFloorplans(slices, fewer);
    result.dominant.trade_off = whole.trade_off;  // not as far as the limit alone
    result.dominant.trade_off_faces = whole.trade_off_faces;
    fitAndExtrude(points, options, result);
  }
  return result;
}

LayerwiseModel buildModelOfBlocks(const std::vector<FloorplanLayer>& blocks, FitPoints points,
                                  const LayerwiseModelOptions& options) {
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
  fitAndExtrude(std::move(points), options, result);
  return result;
}

}  // namespace storey
