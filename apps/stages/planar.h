// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/stage_cloud.h"

namespace storey::stages {

/// Planar confidence of each point, and the threshold that keeps the share (0 to 1) of them.
/// \return a line that says what was found
std::string measureConfidence(StageCloud& cloud, double kept_share, unsigned int threads);

/// Dominant directions of the planar points, and which of them each point has.
/// \return a line that says what was found \throws io::Failure (BadInput) if there are none
std::string findDirections(StageCloud& cloud, unsigned int threads);

}  // namespace storey::stages
