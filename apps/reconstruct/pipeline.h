// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/cloud_reader.h"
#include "reconstruct/options.h"
#include "stages/slices.h"

namespace storey::reconstruct {

using stages::Cloud;
using stages::Point;

struct StageTime {
  std::string name;
  double seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of all threads together
};

/// What every stage found, from the cloud to the model.
struct Result {
  io::LoadedCloud loaded;  ///< the points themselves are moved on to `cloud`
  stages::Attitude attitude;
  stages::StageCloud all;                       ///< all points, upright
  stages::StageCloud cloud;                     ///< those that the structure was found in
  stages::SliceFloorplans slices;               ///< method paper
  std::vector<FloorplanLayer> blocks;           ///< method building
  storey::detail::BuildingFloorplans building;  ///< how they were found
  LayerwiseModel model;
  bool fitted_to_all = true;  ///< points of the file; else to the sample that was read
  Eigen::Isometry3d local_to_input = Eigen::Isometry3d::Identity();  ///< of the model
  std::vector<StageTime> times;
};

/// Who wants to see what happens.
struct Observers {
  /// Called at the end of each stage with a line that says what it found.
  std::function<void(const std::string& line)> progress = [](const std::string&) {};
  /// Called with the cloud of each stage under its name, as "01_upright".
  std::function<void(const std::string& name, const stages::StageCloud&)> cloud =
      [](const std::string&, const stages::StageCloud&) {};
};

/// Takes the cloud `options.input` through all stages: the programs of the stages one after the
/// other, without their files. \throws io::Failure (BadInput) with the reason where a stage finds
/// nothing to go on with
Result reconstruct(const Options& options, const Observers& observers = {});

/// The same for a cloud in memory; `options.input` is only its name in messages.
Result reconstruct(io::LoadedCloud cloud, const Options& options, const Observers& observers = {});

}  // namespace storey::reconstruct
