// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/building_floorplans.h>
#include <storey/segmentation/detail/line_refit.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>
#include <storey/segmentation/detail/transition_blocks.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace storey::detail {
namespace {

constexpr std::size_t kMaxSamples = 250000;  // points that vote for lines
constexpr double kMargin = 0.15;             // of the box around the walls
constexpr double kSameLine = 1.0;            // noise deviations: opposite walls on one line
constexpr int kPasses = 2;                   // the second with the walls that bound a block alone
constexpr double kFaceCost = 0.5;            // of the least area of a wall
constexpr double kBlockFaces = 2.0;          // faces that one more block has at least
// Where most of a building is missing, closing it costs more than its walls have to show, unless
// what was not seen is taken as cheaper.
constexpr double kMinExplained = 0.5;  // of the area of the walls found
constexpr double kLeastGap = 0.1;
constexpr double kShortEdge = 3.0;         // noise deviations
constexpr double kCornerTolerance = 0.05;  // noise deviations

std::vector<WallPoint> drawEvenly(const std::vector<WallPoint>& points) {
  const std::size_t step = points.size() / kMaxSamples + 1;
  if (step == 1) return points;
  std::vector<WallPoint> sample;
  // Golden-ratio stepping inside each stride, so that the order of a scanner leaves no pattern.
  double phase = 0.5;
  for (std::size_t i = 0; i < points.size(); i += step) {
    phase = std::fmod(phase + 0.6180339887498949, 1.0);
    const auto j = i + static_cast<std::size_t>(phase * static_cast<double>(step));
    if (j < points.size()) sample.push_back(points[j]);
  }
  return sample;
}

struct PlanBox {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

PlanBox boxAround(const std::vector<WallPoint>& points) {
  PlanBox box{points.front().position, points.front().position};
  for (const WallPoint& p : points) {
    box.low = box.low.cwiseMin(p.position);
    box.high = box.high.cwiseMax(p.position);
  }
  const Eigen::Vector2d margin =
      Eigen::Vector2d::Constant(kMargin * (box.high - box.low).maxCoeff());
  return {box.low - margin, box.high + margin};
}

// Lines of the arrangement: walls that lie on one line, from either side, share it.
std::vector<PlanLine> planLinesOf(const std::vector<WallLine>& walls,
                                  const std::vector<PlanLine>& hypotheses, double noise) {
  std::vector<PlanLine> lines;
  for (const WallLine& wall : walls) {
    const Eigen::Vector2d a = wall.offset * wall.normal + wall.s_min * wall.tangent();
    const Eigen::Vector2d b = wall.offset * wall.normal + wall.s_max * wall.tangent();
    const bool known = std::any_of(lines.begin(), lines.end(), [&](const PlanLine& line) {
      return std::abs(line.across(a)) < kSameLine * noise &&
             std::abs(line.across(b)) < kSameLine * noise;
    });
    if (!known) lines.push_back({wall.normal, wall.offset});
  }
  lines.insert(lines.end(), hypotheses.begin(), hypotheses.end());
  return lines;
}

// Without lines that lie on another all through the box.
std::vector<PlanLine> distinct(const std::vector<PlanLine>& lines, double noise,
                               const PlanBox& box) {
  const Eigen::Vector2d center = 0.5 * (box.low + box.high);
  const double radius = 0.5 * (box.high - box.low).norm();
  std::vector<PlanLine> result;
  for (const PlanLine& line : lines) {
    const Eigen::Vector2d foot = center - line.across(center) * line.normal;
    const bool known = std::any_of(result.begin(), result.end(), [&](const PlanLine& other) {
      const double turn = std::abs(line.tangent().dot(other.normal));
      return std::abs(other.across(foot)) + radius * turn < kSameLine * noise;
    });
    if (!known) result.push_back(line);
  }
  return result;
}

// Support of a component: area of its walls that points confirm.
double supportOf(const FloorplanComponent& component) {
  double seen = 0.0;
  const auto add = [&](const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring.edges[i].hypothetical) continue;
      seen += (ring.vertices[(i + 1) % ring.size()] - ring.vertices[i]).norm();
    }
  };
  add(component.outer);
  for (const FloorplanRing& hole : component.holes) add(hole);
  return seen;
}

Eigen::Vector2d innerPoint(const PlanCell& cell) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : cell.corners) sum += corner;
  return sum / static_cast<double>(cell.corners.size());
}

// Connected parts of the solid (components of different blocks that overlap in plan) with little
// support beside the best one: neighbours cut by the crop, cars, trees.
void dropWeakParts(const LineArrangement& plan, double keep, BuildingFloorplans& result) {
  struct Part {
    std::size_t layer;
    std::size_t component;
    double support;
  };
  std::vector<Part> parts;
  std::vector<std::vector<std::size_t>> cells_of;  // of each part
  for (std::size_t l = 0; l < result.layers.size(); ++l) {
    const double height = result.layers[l].z_max - result.layers[l].z_min;
    for (std::size_t k = 0; k < result.layers[l].plan.components.size(); ++k) {
      const FloorplanComponent& component = result.layers[l].plan.components[k];
      parts.push_back({l, k, height * supportOf(component)});
      std::vector<std::size_t> cells;
      const Floorplan alone{{component}};
      for (std::size_t c = 0; c < plan.cells.size(); ++c) {
        if (contains(alone, innerPoint(plan.cells[c]))) cells.push_back(c);
      }
      cells_of.push_back(std::move(cells));
    }
  }
  std::vector<std::size_t> root(parts.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (parts[j].layer != parts[i].layer + 1) continue;
      std::vector<std::size_t> shared;
      std::set_intersection(cells_of[i].begin(), cells_of[i].end(), cells_of[j].begin(),
                            cells_of[j].end(), std::back_inserter(shared));
      if (!shared.empty()) root[find(j)] = find(i);
    }
  }
  std::vector<double> support(parts.size(), 0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) support[find(i)] += parts[i].support;
  const double best = parts.empty() ? 0.0 : *std::max_element(support.begin(), support.end());
  std::vector<FloorplanLayer> kept;
  std::size_t i = 0;
  for (FloorplanLayer& layer : result.layers) {
    std::vector<FloorplanComponent> components;
    for (FloorplanComponent& component : layer.plan.components) {
      if (support[find(i)] >= keep * best) components.push_back(std::move(component));
      ++i;
    }
    layer.plan.components = std::move(components);
    if (!layer.plan.empty()) kept.push_back(std::move(layer));
  }
  result.layers = std::move(kept);
}

// Area of the walls seen that bound the blocks.
double explainedArea(const LineArrangement& plan, const std::vector<CellBlock>& blocks) {
  double area = 0.0;
  for (const CellBlock& block : blocks) {
    for (const OutlineRun& run : runsOf(plan, block.terms, block.inside)) area += run.seen;
  }
  return area;
}

}  // namespace

BuildingFloorplans extractBuildingFloorplans(const std::vector<WallPoint>& points,
                                             const std::vector<LevelPoint>& level_points,
                                             const WallScale& scale,
                                             const BuildingFloorplanOptions& options) {
  BuildingFloorplans result;
  const std::vector<WallPoint> sample = drawEvenly(points);
  if (sample.empty()) return result;
  WallScale sample_scale = scale;
  sample_scale.density *= static_cast<double>(sample.size()) / static_cast<double>(points.size());
  result.walls = findWallLines(sample, sample_scale, {options.min_wall_area});
  if (result.walls.size() < 2) return result;
  result.hypotheses = hypothesiseLines(result.walls, sample_scale);

  double wall_area = 0.0;
  for (const WallLine& wall : result.walls) wall_area += wall.support_area;
  CellEnergyOptions energy;
  const double face_cost = kFaceCost * options.min_wall_area;
  energy.block = options.block_cost > 0.0 ? options.block_cost : kBlockFaces * face_cost;
  const PlanBox box = boxAround(points);
  const double tolerance = kCornerTolerance * scale.noise;
  std::vector<PlanLine> lines = planLinesOf(result.walls, result.hypotheses, scale.noise);
  WallEvidence evidence;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (pass > 0) {
      lines = distinct(refitUsedLines(result.plan, evidence, result.blocks, points, scale.noise),
                       scale.noise, box);
      if (lines.size() < 3) break;
    }
    result.plan = arrangeLines(lines, box.low, box.high, tolerance);
    evidence = gatherEvidence(result.plan, points, scale);
    if (pass == 0) result.levels = findLevels(evidence);
    while (true) {
      result.blocks = labelCells(result.plan, evidence, result.levels, level_points, energy);
      divideTransitions(result.plan, evidence, energy.gap, face_cost, result.blocks);
      pruneOutlines(result.plan, energy.gap, face_cost, result.blocks);
      if (explainedArea(result.plan, result.blocks) > kMinExplained * wall_area ||
          energy.gap < kLeastGap) {
        break;
      }
      energy.gap *= 0.5;
    }
  }
  result.gap = energy.gap;
  for (const CellBlock& block : result.blocks) {
    FloorplanLayer layer;
    layer.z_min = evidence.heightOf(block.first_bin);
    layer.z_max = evidence.heightOf(block.last_bin);
    layer.plan =
        outlineOf(result.plan, block, tolerance, kShortEdge * scale.noise, options.min_area);
    if (!layer.plan.empty()) result.layers.push_back(std::move(layer));
  }
  dropWeakParts(result.plan, options.keep_components, result);
  return result;
}

}  // namespace storey::detail
