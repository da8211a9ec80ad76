// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/threads.h>

#include <cstddef>

namespace storey::detail {

/// Has several threads fetch from the system the memory that a list reserves and has not used yet.
/// That takes longer than to fill it, and else one thread does it page by page where the list
/// grows.
template <typename List>
void touchReserve(unsigned int threads, List& list) {
  constexpr std::size_t kPage = 4096;       // bytes, at most, of all systems
  constexpr std::size_t kFew = 64 * kPage;  // bytes that may lie in memory used before
  const std::size_t bytes = (list.capacity() - list.size()) * sizeof(*list.data());
  if (bytes < kFew) return;
  volatile char* const memory = reinterpret_cast<char*>(list.data() + list.size());
  const auto pages = static_cast<std::ptrdiff_t>(bytes / kPage);
#pragma omp parallel for num_threads(threadsFor(threads)) schedule(static)
  for (std::ptrdiff_t page = 0; page < pages; ++page) {
    memory[static_cast<std::size_t>(page) * kPage] = 0;
  }
}

}  // namespace storey::detail
