// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// What `report.json` holds: per stage what was counted, found and derived, the checks of the
/// model, how far the points are from it, seconds and peak memory.
std::string describe(const Options& options, const Result& result);

}  // namespace storey::reconstruct
