// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench/isolation.h"
#include "bench/performance/meter.h"
#include "reconstruct/options.h"

namespace storey::bench {

/// Does the work in a process of its own. \throws io::Failure (Internal) if it fails
std::vector<Measured> measureAlone(const std::function<std::vector<Measured>()>& work);

/// What no program can go below: the bytes of the file read, and one pass over them.
std::vector<Measured> measureFloor(const std::string& cloud);

/// Every stage from the file to the model, on one thread, and "all stages" with the memory that
/// all of them took at their peak.
std::vector<Measured> measureStages(const reconstruct::Options& options);

}  // namespace storey::bench
