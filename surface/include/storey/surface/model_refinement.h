// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/detail/level_evidence.h>
#include <storey/surface/detail/wall_round.h>
#include <storey/surface/layerwise_model.h>

#include <vector>

namespace storey {

/// Fits a model to more points than memory holds: it was made from a sample of them, and they come
/// in parts, of which only sums are kept. Walls and heights are then those of all points, to a
/// tenth of the error that the sample left; so are their deviations. Heights beside holes in the
/// points may be off by a deviation or two: they are sought as far as the sample's density makes
/// it needful. What the faces are, and how much of each is covered, stays what the sample says.
///
/// Walls with next to no points stay where they are.
class ModelRefinement {
 public:
  /// \param sample that the model was made from, as for `buildModelOfBlocks`
  /// \param options of the model, the same
  ModelRefinement(FitPoints sample, const LayerwiseModelOptions& options, LayerwiseModel& model);

  /// \param part of the points, the sample's own among them
  void add(FitPoints part);

  /// Moves the model. Without points it stays as it is.
  void finish();

 private:
  LayerwiseModelOptions options_;
  LayerwiseModel& model_;
  FitPoints sample_;  // in the frame of the model
  std::vector<FloorplanLayer> layers_;
  FitOptions fit_;
  detail::WallRound walls_;
  std::vector<detail::LevelEvidence> levels_;
};

}  // namespace storey
