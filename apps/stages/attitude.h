// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/features/vertical_direction_estimation.h>
#include <storey/filters/cloud_scale.h>

#include <limits>

#include "io/cloud_reader.h"
#include "stages/stage_cloud.h"

namespace storey::stages {

/// What encloses the points: a building seen from outside, or a space (room, yard) from inside.
enum class SpaceSide { Auto, Outside, Inside };

/// Lengths are in the cloud's unit; 0 derives them from the cloud.
struct AttitudeOptions {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< zero: found from the walls
  SpaceSide side = SpaceSide::Auto;
  bool estimate_normals = false;  ///< even if the file has some
  /// Where all points were seen from, in the input's coordinates; NaN: not known.
  Eigen::Vector3d sensor = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double noise = 0.0;
  std::string crs;  ///< of the coordinates in the file, any text
};

/// What the first stage found.
struct Attitude {
  int normals_k = 0;                              ///< neighbours of estimated normals; 0: given
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the input's frame
  bool level = false;  ///< +z is within the accuracy of `up` and was taken for it
  VerticalQuality vertical;
  std::string side_reason;
  CloudScale scale;
};

// The parts of the first stage, in their order: from a loaded cloud to one that all others may rely
// on. Each changes the cloud and returns a line that says what it found. \throws io::Failure
// (BadInput) with the reason where there is nothing to go on with.
/// With a sensor all normals are turned to it, given ones as well.
std::string estimateMissingNormals(StageCloud& cloud, const AttitudeOptions& options,
                                   unsigned int threads, Attitude& found);
std::string setUpright(StageCloud& cloud, const AttitudeOptions& options, unsigned int threads,
                       Attitude& found);
std::string orientOutwards(StageCloud& cloud, const AttitudeOptions& options, unsigned int threads,
                           Attitude& found);
std::string measureScale(StageCloud& cloud, double given_noise, unsigned int threads,
                         CloudScale& scale);

/// Measures noise and density of a cloud that does not tell them.
void ensureScale(StageCloud& cloud);

}  // namespace storey::stages
