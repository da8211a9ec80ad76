// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/performance/results.h"

namespace storey::bench {

/// Runs storey_reconstruct on a cloud with one thread and with two, from the file to the files of
/// the model, and notes both in the results as "program, building, 1 thread" and so on, with the
/// peak of their memory. \param runs of each, the fastest of which counts
void measurePrograms(std::size_t size, const std::string& cloud, const std::string& scratch,
                     const std::string& method, int runs, Results& results);

/// The same with two threads and `--max-points` a tenth of the cloud: what a cloud takes that is
/// larger than memory.
void measureThinned(std::size_t size, const std::string& cloud, const std::string& scratch,
                    Results& results);

/// The speed-up by the second thread, from what `measurePrograms` noted, to stdout.
void printSpeedUps(const Results& results);

}  // namespace storey::bench
