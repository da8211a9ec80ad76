// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "reconstruct/pipeline.h"

namespace storey::reconstruct {

/// Writes `report.json`: per stage what was counted, found and derived, the checks of the model,
/// seconds and peak memory. \throws io::Failure
void writeReport(const std::string& path, const Options& options, const Result& result);

}  // namespace storey::reconstruct
