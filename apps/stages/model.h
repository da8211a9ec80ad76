// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/floorplan_grammar.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <vector>

#include "stages/floorplans.h"
#include "stages/stage_cloud.h"

namespace storey::stages {

using PartVisitor = LayerwiseMRFReconstruction<Point>::PartVisitor;
using PartSource = LayerwiseMRFReconstruction<Point>::PartSource;

struct ModelOptions {
  double smoothness = 0.1;  ///< eta1, method paper
  double label_cost = 0.5;  ///< eta2, method paper
  FloorplanGrammar::Encoding encoding = FloorplanGrammar::Encoding::Walls;
  bool expansion = false;  ///< minimise by alpha-expansion instead of exactly
  double grid = 0.0;       ///< unit of the vertices, length; 0: derived
};

/// The solid over the floorplans, fitted to all points.
/// \param layers of slices or of blocks, as `method` says
/// \param parts of all points, where the cloud is a sample of them; may be empty
/// \param steps for experiments: those of the method that are left out
/// \return a line that says what was found \throws io::Failure (BadInput) if there is no solid
std::string buildModel(StageCloud& cloud, const std::vector<FloorplanLayer>& layers, Method method,
                       const SimplicityOptions& simplicity, const ModelOptions& options,
                       unsigned int threads, LayerwiseModel& model, const PartSource& parts = {},
                       const storey::detail::MethodSteps& steps = {});

/// Takes a model to the coordinates of the file that the first stage read.
Eigen::Isometry3d modelToInput(const StageCloud& cloud, const LayerwiseModel& model);

}  // namespace storey::stages
