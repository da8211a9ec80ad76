// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/segment_linking.h>

#include "cli/command_line.h"
#include "stages/attitude.h"
#include "stages/model.h"

namespace storey::stages {

/// Options of the slices' floorplans.
struct SliceOptions {
  double thickness = 0.0;  ///< length; 0: derived
  storey::detail::LinkingMethod linking = storey::detail::LinkingMethod::Optimal;
};

constexpr double kDefaultKeptShare = 0.85;

// The options of each stage, declared once for its own program and for storey_reconstruct.
void declareAttitude(cli::CommandLine& line, AttitudeOptions& options);
void declareStructurePoints(cli::CommandLine& line, int& structure_points);
void declareKeptShare(cli::CommandLine& line, double& kept_share);
void declareMethod(cli::CommandLine& line, Method& method);
void declareThickness(cli::CommandLine& line, SliceOptions& options);
void declareLinking(cli::CommandLine& line, SliceOptions& options);
void declareBlocks(cli::CommandLine& line, BlockOptions& options);
void declareMaxFaces(cli::CommandLine& line, SimplicityOptions& simplicity);
void declareMaxTypes(cli::CommandLine& line, SimplicityOptions& simplicity);
void declareModel(cli::CommandLine& line, ModelOptions& options);
void declareTradeOff(cli::CommandLine& line, SimplicityOptions& simplicity);
void declareQuiet(cli::CommandLine& line, bool& quiet);

/// Checks and completes what `parse` read.
void checkAttitude(const cli::CommandLine& line, AttitudeOptions& options);

/// Refuses options that the method does not look at.
void checkMethod(const cli::CommandLine& line, Method method);

}  // namespace storey::stages
