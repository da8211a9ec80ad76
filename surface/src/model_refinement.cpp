// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/fitted_model.h>
#include <storey/surface/detail/level_fitting.h>
#include <storey/surface/detail/unseen_walls.h>
#include <storey/surface/detail/wall_corners.h>
#include <storey/surface/model_refinement.h>

#include <map>
#include <utility>

namespace storey {
namespace {

FitPoints turned(FitPoints points, const LayerwiseModel& model, unsigned int threads) {
  if (!model.upright.matrix().isIdentity(0.0)) {
    detail::turnPoints(model.upright, threads, points);
  }
  return points;
}

FitOptions fitOptions(const LayerwiseModelOptions& options) {
  FitOptions fit;
  fit.noise = options.noise;
  fit.share_directions = options.steps.shared_directions;
  fit.find_panes = options.steps.panes;
  fit.max_shift = 0.5 * options.slice_thickness;
  fit.threads = options.threads;
  return fit;
}

}  // namespace

ModelRefinement::ModelRefinement(FitPoints sample, const LayerwiseModelOptions& options,
                                 LayerwiseModel& model)
    : options_(options),
      model_(model),
      sample_(turned(std::move(sample), model, options.threads)),
      layers_(model.model.storeys),
      fit_(fitOptions(options)),
      walls_(layers_, sample_, fit_) {
  fit_.noise = detail::noiseOfWalls(model.walls, options.noise);  // of the heights
}

void ModelRefinement::add(FitPoints part) {
  if (layers_.empty()) return;
  const FitPoints points = turned(std::move(part), model_, options_.threads);
  walls_.add(points);
  const std::vector<detail::LevelEvidence> levels =
      detail::collectLevelEvidence(layers_, points, fit_);
  if (levels_.empty()) {
    levels_ = levels;
    return;
  }
  for (std::size_t k = 0; k < levels.size(); ++k) levels_[k] += levels[k];
}

void ModelRefinement::finish() {
  std::map<int, WallFit> fits = walls_.solve();
  if (fits.empty()) return;
  for (const auto& [id, fit] : detail::unseenWalls(layers_, fits)) {
    const auto before = model_.walls.find(id);
    if (before != model_.walls.end()) fits[id] = before->second;
  }
  detail::moveCorners(layers_, fits);
  model_.walls = std::move(fits);
  model_.levels = detail::fitHeights(layers_, levels_, fit_);
  detail::extrudeFits(layers_, sample_, fit_.noise, options_, model_);
}

}  // namespace storey
