// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "io/point_index.h"
#include "io/point_records.h"

namespace storey::io {
namespace {

template <typename Number>
void moveEntries(std::vector<Number>& entries, std::size_t each, std::size_t from, std::size_t to) {
  std::copy_n(entries.begin() + static_cast<std::ptrdiff_t>(from * each), each,
              entries.begin() + static_cast<std::ptrdiff_t>(to * each));
}

}  // namespace

void RawCloud::settle(std::size_t first) {
  if (take_part_) {
    if (size() < max_points_) return;
    take_part_(*this);
    cut(0);
    return;
  }
  if (key_limit_ < kAllKeys) keepSample(first);
  thin(max_points_);
}

void RawCloud::thin(std::uint64_t max_points) {
  while (size() > max_points) {
    key_limit_ -= std::max<std::uint64_t>(key_limit_ / 8, 1);
    keepSample(0);
    viewers = Viewers();  // of all points, and already asked
  }
}

void RawCloud::keepSample(std::size_t first) {
  std::size_t kept = first;
  for (std::size_t i = first; i < size(); ++i) {
    if (hashPosition(&positions[3 * i]) >= key_limit_) continue;
    moveEntries(positions, 3, i, kept);
    if (!normals.empty()) moveEntries(normals, 3, i, kept);
    for (ExtraColumn& extra : extras) moveEntries(extra.values, 1, i, kept);
    ++kept;
  }
  cut(kept);
}

void RawCloud::cut(std::size_t num_points) {
  positions.resize(3 * num_points);
  if (!normals.empty()) normals.resize(3 * num_points);
  for (ExtraColumn& extra : extras) extra.values.resize(num_points);
}

}  // namespace storey::io
