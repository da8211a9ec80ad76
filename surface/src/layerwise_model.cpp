// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/even_draw.h>
#include <storey/surface/detail/points_by_wall.h>
#include <storey/surface/detail/short_edges.h>
#include <storey/surface/detail/stacked_walls.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/face_support.h>
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
constexpr double kShortEdge = 3.0;      // noise deviations: a face as narrow is noise of others
constexpr double kMaxNoiseRatio = 2.0;  // of the walls' residual to the noise they were found with

// The noise that the walls show: the residual of the wall in the middle, counted by points.
double noiseOfWalls(const std::map<int, WallFit>& walls, double guess) {
  std::vector<std::pair<double, std::size_t>> residuals;
  std::size_t points = 0;
  for (const auto& [id, wall] : walls) {
    if (wall.support == 0) continue;
    residuals.emplace_back(wall.residual, wall.support);
    points += wall.support;
  }
  std::sort(residuals.begin(), residuals.end());
  std::size_t below = 0;
  for (const auto& [residual, support] : residuals) {
    below += support;
    if (2 * below >= points) {
      return std::clamp(residual, guess / kMaxNoiseRatio, guess * kMaxNoiseRatio);
    }
  }
  return guess;
}

void turn(const Eigen::Isometry3d& upright, unsigned int threads, FitPoints& points) {
  const auto work = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3f& p = points.positions[i];
      Eigen::Vector3f& n = points.normals[i];
      p = (upright * p.cast<double>()).cast<float>();
      n = (upright.linear() * n.cast<double>()).cast<float>();
    }
  };
  detail::forEachChunk(points.positions.size(), threads, work);
}

// Turns the points by what the walls lean. \return the rotation
Eigen::Isometry3d setUpright(const std::vector<FloorplanLayer>& layers,
                             const LayerwiseModelOptions& options, FitPoints& points,
                             detail::PointsByWall& by_wall) {
  if (!options.steps.upright) return Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d upright =
      detail::fitUpright(layers, points, options.noise, options.threads, by_wall);
  if (upright.matrix().isIdentity(0.0)) return upright;
  turn(upright, options.threads, points);
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
  by_wall = {};
  fit.noise = noiseOfWalls(result.walls, options.noise);
  if (options.steps.unseen_walls) {
    fitUnseenWalls(layers, points, fit.noise, result.walls, options.threads);
  }
  if (options.steps.facets) detail::dropShortEdges(layers, result.walls, kShortEdge * fit.noise);
  fit.max_shift = 0.5 * options.slice_thickness;
  result.levels = fitHeights(layers, points, fit);
  result.model = extrudeFloorplans(layers, options.grid);
  result.check = checkModel(result.model);
  if (result.model.empty()) return;
  measureSupport(points, fit.noise, result.model, options.threads);
  propagateDeviations(result.walls, result.levels, result.model);
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

LayerwiseModel buildLayerwiseModel(const std::vector<FloorplanLayer>& slices, FitPoints points,
                                   const LayerwiseModelOptions& options) {
  LayerwiseModel result;
  result.dominant = selectDominantFloorplans(slices, options.dominant);
  fitAndExtrude(std::move(points), options, result);
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
