// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench/experiment.h"
#include "bench/summary.h"

namespace storey::bench {

std::string methodName(reconstruct::Method method);

/// A list of the outcomes that are not exact or not valid, with what differs; nothing if all are.
void printNotExact(const std::vector<Experiment>& experiments,
                   const std::vector<Outcome>& outcomes);

/// The same for those without a valid model.
void printNotValid(const std::vector<Experiment>& experiments,
                   const std::vector<Outcome>& outcomes);

}  // namespace storey::bench
