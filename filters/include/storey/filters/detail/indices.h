// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <pcl/types.h>

#include <cstddef>

namespace storey::detail {

/// Whether all indices lie within a cloud of `size` points; PCL never checks. Prints a PCL_ERROR in
/// the name of the class `caller` if not.
inline bool indicesInside(const pcl::Indices& indices, std::size_t size, const char* caller) {
  for (const pcl::index_t i : indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= size) {
      PCL_ERROR("[storey::%s] index %d is outside the cloud of %zu points.\n", caller,
                static_cast<int>(i), size);
      return false;
    }
  }
  return true;
}

}  // namespace storey::detail
