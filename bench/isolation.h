// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace storey::bench {

/// Work whose result is bytes.
using Task = std::function<std::string()>;

struct Report {
  std::string result;
  std::string failure;  ///< a refusal (`io::Failure`), "EXCEPTION: " and what else was thrown, or
                        ///< "CRASH: " and the signal; empty if all went well
};

/// Runs each task in a process of its own, at most `jobs` (>= 1) at a time, so that a crash, or
/// more than half an hour of CPU time, ends one task and is reported. Reports are in the order of
/// the tasks; `finished` is called as they end. The caller must not have used OpenMP: its threads
/// do not live on in the new process.
std::vector<Report> runIsolated(const std::vector<Task>& tasks, unsigned int jobs,
                                const std::function<void(std::size_t, const Report&)>& finished);

}  // namespace storey::bench
