// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <algorithm>

namespace storey::detail {

/// Threads for a request: as many as asked for, all cores for 0.
inline int threadsFor(unsigned int requested) {
  constexpr unsigned int kMaxThreads = 1024;
  return requested == 0 ? std::max(1, omp_get_num_procs())
                        : static_cast<int>(std::min(requested, kMaxThreads));
}

}  // namespace storey::detail
