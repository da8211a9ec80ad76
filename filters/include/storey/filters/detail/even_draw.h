// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace storey::detail {

/// So many of the entries, evenly drawn, in their order; all where there are no more.
template <typename Entry, typename Allocator>
std::vector<Entry, Allocator> drawEvenly(const std::vector<Entry, Allocator>& entries,
                                         std::size_t count) {
  if (entries.size() <= count) return entries;
  std::vector<Entry, Allocator> drawn;
  drawn.reserve(count);
  const double stride = static_cast<double>(entries.size()) / static_cast<double>(count);
  const auto startOf = [&](std::size_t k) {
    return std::min(static_cast<std::size_t>(stride * static_cast<double>(k)), entries.size());
  };
  // Golden-ratio stepping inside each stride, so that the order of a scanner leaves no pattern.
  double phase = 0.5;
  for (std::size_t k = 0; k < count; ++k) {
    phase = std::fmod(phase + 0.6180339887498949, 1.0);
    const std::size_t start = startOf(k);
    const std::size_t length = startOf(k + 1) - start;
    drawn.push_back(entries[start + static_cast<std::size_t>(phase * static_cast<double>(length))]);
  }
  return drawn;
}

}  // namespace storey::detail
