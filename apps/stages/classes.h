// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/stage_cloud.h"

namespace storey::stages {

/// What each point is of: a wall, a level face, the ground and so on, by `detail::PointClass`.
/// \return a line that says what was found
std::string classify(StageCloud& cloud, unsigned int threads);

}  // namespace storey::stages
