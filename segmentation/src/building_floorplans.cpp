// SPDX-License-Identifier: BSD-3-Clause
#include <storey/segmentation/detail/building_floorplans.h>
#include <storey/segmentation/detail/end_evidence.h>
#include <storey/segmentation/detail/line_refit.h>
#include <storey/segmentation/detail/outline_faces.h>
#include <storey/segmentation/detail/outline_pruning.h>
#include <storey/segmentation/detail/transition_blocks.h>
#include <storey/segmentation/detail/wall_hypotheses.h>
#include <storey/segmentation/detail/wall_lines.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr double kMargin = 0.15;     // of the box around the walls
constexpr double kSameLine = 1.0;    // noise deviations: opposite walls on one line
constexpr double kFaceCost = 0.5;    // of the least area of a wall
constexpr double kBeyondEnd = 0.5;   // of the side of the least wall
constexpr double kBlockFaces = 2.0;  // faces that one more block has at least
// Where most of a building is missing, closing it costs more than its walls have to show, unless
// what was not seen is taken as cheaper.
constexpr double kMinExplained = 0.5;  // of the area of the walls found
constexpr double kLeastGap = 0.1;
constexpr double kShortEdge = 3.0;         // noise deviations
constexpr double kCornerTolerance = 0.05;  // noise deviations

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

// Area of the walls seen that bound the blocks.
double explainedArea(const LineArrangement& plan, const std::vector<CellBlock>& blocks) {
  double area = 0.0;
  for (const CellBlock& block : blocks) {
    for (const OutlineRun& run : runsOf(plan, block.terms, block.inside)) area += run.seen;
  }
  return area;
}

// The walls of a building, cut into cells and labelled.
class Labeling {
 public:
  Labeling(const WallInput& input, const BuildingFloorplanOptions& options,
           BuildingFloorplans& result)
      : points_(input.walls),
        level_points_(input.levels),
        scale_(input.scale),
        steps_(options.steps),
        threads_(options.threads),
        face_cost_(kFaceCost * options.min_wall_area),
        least_side_(std::sqrt(options.min_wall_area)),
        box_(boxAround(input.walls)),
        result_(result) {
    energy_.block = options.block_cost > 0.0 ? options.block_cost : kBlockFaces * face_cost_;
    for (const WallLine& wall : result.walls) wall_area_ += wall.support_area;
  }

  /// All lines first, then those alone that bound a block, refitted.
  void run() {
    arrange(planLinesOf(result_.walls, result_.hypotheses, scale_.noise));
    result_.levels = findLevels(evidence_);

    label();
    if (!steps_.second_pass) return;
    const std::vector<PlanLine> used = distinct(
        refitUsedLines(result_.plan, evidence_, result_.blocks, points_, scale_.noise, threads_),
        scale_.noise, box_);
    if (used.size() < 3) return;

    arrange(used);
    label();
  }

  void simplify(const SimplicityLimits& limits) {
    result_.trade_off =
        simplifyOutlines(result_.plan, energy_.gap, face_cost_, limits, result_.blocks, threads_);
  }

  void takeOutlines(double min_area) {
    for (const CellBlock& block : result_.blocks) {
      FloorplanLayer layer;
      layer.z_min = evidence_.heightOf(block.first_bin);
      layer.z_max = evidence_.heightOf(block.last_bin);
      result_.block_heights.emplace_back(layer.z_min, layer.z_max);
      layer.plan = outlineOf(result_.plan, block, kCornerTolerance * scale_.noise,
                             kShortEdge * scale_.noise, min_area);
      if (!layer.plan.empty()) result_.layers.push_back(std::move(layer));
    }
  }

 private:
  void arrange(const std::vector<PlanLine>& lines) {
    result_.plan = arrangeLines(lines, box_.low, box_.high, kCornerTolerance * scale_.noise);
    evidence_ = gatherEvidence(result_.plan, points_, scale_, steps_.saturated_tiles, threads_);
    if (!steps_.wall_ends) return;
    noteEnds(result_.plan, result_.ends, kBeyondEnd * least_side_, kSameLine * scale_.noise,
             evidence_);
  }

  void prune() {
    if (!steps_.pruning) return;
    pruneOutlines(result_.plan, energy_.gap, face_cost_, result_.blocks, true, threads_);
  }

  void label() {
    while (true) {
      result_.blocks =
          labelCells(result_.plan, evidence_, result_.levels, level_points_, energy_, threads_);
      // Divided once they are simple: what noise adds to an outline is no reason to do without it.
      prune();
      if (steps_.transitions) {
        divideTransitions(result_.plan, evidence_, energy_.gap, face_cost_, result_.blocks);
      }
      prune();
      result_.gap = energy_.gap;
      if (explainedArea(result_.plan, result_.blocks) > kMinExplained * wall_area_) return;
      if (energy_.gap < kLeastGap) return;
      energy_.gap *= 0.5;
    }
  }

  const std::vector<WallPoint>& points_;
  const std::vector<LevelPoint>& level_points_;
  const WallScale& scale_;
  MethodSteps steps_;
  unsigned int threads_;
  CellEnergyOptions energy_;
  double face_cost_;
  double least_side_;  // of a wall
  double wall_area_ = 0.0;
  PlanBox box_;
  WallEvidence evidence_;
  BuildingFloorplans& result_;
};

}  // namespace

BuildingFloorplans extractBuildingFloorplans(const WallInput& input,
                                             const BuildingFloorplanOptions& options) {
  BuildingFloorplans result;
  if (input.sample.empty()) return result;

  WallScale sample_scale = input.scale;
  sample_scale.density *=
      static_cast<double>(input.sample.size()) / static_cast<double>(input.walls.size());
  const HeightDensity density(input.sample, sample_scale, options.threads);
  result.walls = findWallLines(input.sample, sample_scale, density,
                               {options.min_wall_area, options.steps, options.threads});
  if (result.walls.size() < 2) return result;

  if (options.steps.hypotheses) {
    WallHypotheses found = hypothesiseLines(result.walls, input.sample, sample_scale, density,
                                            cornerGap(input.scale.density), options.threads);
    result.hypotheses = std::move(found.lines);
    result.ends = std::move(found.ends);
  }

  Labeling labeling(input, options, result);
  labeling.run();
  labeling.simplify(options.limits);
  labeling.takeOutlines(options.min_area);

  return result;
}

}  // namespace storey::detail
