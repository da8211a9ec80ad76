// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "reconstruct/options.h"
#include "synth/sampling.h"

namespace storey::bench {

/// One cloud of one building, to be reconstructed and compared with the truth.
struct Experiment {
  std::string building;  ///< as `synth::makeBuilding` takes it
  std::string label;     ///< what is done to the cloud; empty for a clean one
  synth::SamplingOptions sampling;
  bool with_normals = true;
  reconstruct::Method method = reconstruct::Method::Building;
  detail::MethodSteps steps;
};

/// Plain numbers, so that they can be handed from process to process. Lengths are in the units of
/// the unposed building.
struct Measures {
  std::size_t points = 0;
  double noise = 0.0;
  std::size_t true_polygons = 0;
  std::size_t true_corners = 0;
  double error_limit = 0.0;      ///< of a clean cloud with that noise and number of points
  double corner_limit = 0.0;     ///< the same
  std::size_t hidden_walls = 0;  ///< polygons of the truth that no points are of (`ShownTruth`)
  double seconds = 0.0;          ///< CPU time of the reconstruction, also of one that failed
  bool has_model = false;
  // The following only if there is a model.
  double error = 0.0;               ///< the paper's: model vertices to true facets, mean
  double error_deviation = 0.0;     ///< standard deviation of the same
  double corner = 0.0;              ///< true corners to model vertices, mean
  double worst_corner = 0.0;        ///< the same, largest
  double worst_shown_corner = 0.0;  ///< of those at which two walls with points meet
  double iou = 0.0;
  std::size_t polygons = 0;
  std::size_t corners = 0;
  bool valid = false;  ///< closed and without any defect that `checkModel` knows
  double grid = 0.0;   ///< unit of the model's coordinates
};

struct Outcome {
  Measures measures;
  std::vector<Eigen::Vector3d> vertices;  ///< of the model, in the frame of the unposed building
  std::string problem;  ///< why there is no model, or why it is not valid; empty if all is well
};

/// Each experiment in a process of its own, `jobs` at a time; a crash is its failure. Outcomes are
/// in the order of the experiments and do not depend on `jobs`, apart from the seconds.
/// A line for each that ends goes to stderr.
std::vector<Outcome> perform(const std::vector<Experiment>& experiments, unsigned int jobs);

}  // namespace storey::bench
