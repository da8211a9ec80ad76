// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace storey::view {

/// A cloud that storey_reconstruct --intermediate wrote, in the upright local frame.
struct StageCloud {
  std::vector<Eigen::Vector3f> positions;  ///< finite
  std::vector<Eigen::Vector3f> normals;    ///< parallel to `positions`; may be 0 or not finite
  std::vector<double> values;              ///< the field asked for, or none
};

/// Reads a binary PCD of numbers of 4 bytes, as the clouds of the stages are.
/// \param value_field "intensity" or "label"; empty for positions and normals alone
/// \throws io::Failure (BadInput, MissingInput, IoError)
StageCloud readStageCloud(const std::string& path, const std::string& value_field);

/// Reads the lines of a legacy VTK file of polygonal data in ASCII, as the floorplans are.
/// \throws io::Failure (BadInput, MissingInput, IoError)
std::vector<std::vector<Eigen::Vector3d>> readVtkLines(const std::string& path);

}  // namespace storey::view
