// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

namespace storey::detail {

/// Number of threads that a setting asks for, where 0 means all cores.
inline int threadCount(unsigned int setting) {
  return setting > 0 ? static_cast<int>(setting) : omp_get_num_procs();
}

}  // namespace storey::detail
