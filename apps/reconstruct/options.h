// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/detail/method_steps.h>

#include <string>
#include <vector>

#include "export/formats.h"
#include "stages/options.h"

namespace storey::reconstruct {

using stages::Method;
using stages::SpaceSide;

/// Everything a user can set. Lengths are in the cloud's unit; 0 derives them from the cloud.
struct Options {
  std::string input;
  int max_points = 0;  ///< a larger cloud is thinned to so many; 0: no limit
  std::string output_directory;
  std::vector<exports::Format> formats;
  stages::AttitudeOptions attitude;
  int structure_points = 0;  ///< to find the structure in; 0: derived
  double kept_share = stages::kDefaultKeptShare;
  Method method = Method::Building;
  stages::BlockOptions blocks;
  stages::SliceOptions slices;
  stages::SimplicityOptions simplicity;
  stages::ModelOptions model;
  unsigned int threads = 0;
  bool intermediate = false;
  bool pictures = false;  ///< of all stages: implies their clouds
  bool quiet = false;
  detail::MethodSteps steps;  ///< for experiments only: no option of the command line
};

/// Reads the command line. \return false if help or the version was asked for and printed
/// \throws io::Failure (Usage)
bool parseOptions(int argc, char** argv, Options& options);

}  // namespace storey::reconstruct
