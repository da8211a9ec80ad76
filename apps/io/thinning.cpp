// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "io/point_records.h"
#include "io/position_hash.h"

namespace storey::io {
namespace {

// So many more points than the limit, of it, are taken before copies are looked for and the sample
// is thinned: either takes as long as all of them let it.
constexpr std::uint64_t kSpareShare = 8;

template <typename Number>
void copyEntries(std::vector<Number>& entries, std::size_t each, std::size_t from, std::size_t to) {
  std::copy_n(entries.begin() + static_cast<std::ptrdiff_t>(from * each), each,
              entries.begin() + static_cast<std::ptrdiff_t>(to * each));
}

}  // namespace

std::uint64_t RawCloud::room() const {
  const std::uint64_t limit = take_part_ ? max_points_ : max_points_ + max_points_ / kSpareShare;
  return size() < limit ? limit - size() : 1;
}

void RawCloud::settle(std::size_t first) {
  if (take_part_) {
    if (size() < max_points_) return;
    take_part_(*this);
    cut(0);
    return;
  }
  if (key_limit_ < kAllKeys) keepSample(first);
  if (size() > max_points_ + max_points_ / kSpareShare) thin(max_points_);
}

void RawCloud::thin(std::uint64_t max_points) {
  if (size() <= max_points) return;
  viewers = Viewers();  // of all points, and already asked
  if (hasCopies()) dropCopies();
  while (size() > max_points) {
    key_limit_ -= std::max<std::uint64_t>(key_limit_ / 8, 1);
    keepSample(0);
  }
}

void RawCloud::keepSample(std::size_t first) {
  std::size_t kept = first;
  for (std::size_t i = first; i < size(); ++i) {
    if (hashPosition(&positions[3 * i]) < key_limit_) copyPoint(i, kept++);
  }
  cut(kept);
}

bool RawCloud::hasCopies() const {
  constexpr std::uint64_t kDrawn = 4096;
  std::vector<std::uint64_t> drawn(kDrawn);  // points, then what their places hash to
  for (std::uint64_t k = 0; k < kDrawn; ++k) drawn[k] = mixBits(k) % size();
  std::sort(drawn.begin(), drawn.end());
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  for (std::uint64_t& point : drawn) point = hashPosition(&positions[3 * point]);
  std::sort(drawn.begin(), drawn.end());
  return std::adjacent_find(drawn.begin(), drawn.end()) != drawn.end();
}

void RawCloud::dropCopies() {
  constexpr std::uint32_t kEmpty = 0xffffffffu;  // more than points that a file may have
  std::size_t slots = 16;
  while (slots < 2 * size()) slots *= 2;
  std::vector<std::uint32_t> point_at(slots, kEmpty);  // an open hash table
  const auto share_place = [this](std::size_t a, std::size_t b) {
    return std::memcmp(&positions[3 * a], &positions[3 * b], 3 * sizeof(double)) == 0;
  };
  const auto has_lesser_normal = [this](std::size_t a, std::size_t b) {
    return !normals.empty() && std::lexicographical_compare(&normals[3 * a], &normals[3 * a] + 3,
                                                            &normals[3 * b], &normals[3 * b] + 3);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    std::size_t slot = hashPosition(&positions[3 * i]) & (slots - 1);
    while (point_at[slot] != kEmpty && !share_place(point_at[slot], i)) {
      slot = (slot + 1) & (slots - 1);
    }
    if (point_at[slot] == kEmpty) {
      point_at[slot] = static_cast<std::uint32_t>(kept);
      copyPoint(i, kept++);
    } else if (has_lesser_normal(point_at[slot], i)) {
      copyPoint(i, point_at[slot]);
    }
  }
  cut(kept);
}

void RawCloud::copyPoint(std::size_t from, std::size_t to) {
  if (from == to) return;
  copyEntries(positions, 3, from, to);
  if (!normals.empty()) copyEntries(normals, 3, from, to);
  for (ExtraColumn& extra : extras) copyEntries(extra.values, 1, from, to);
}

void RawCloud::cut(std::size_t num_points) {
  positions.resize(3 * num_points);
  if (!normals.empty()) normals.resize(3 * num_points);
  for (ExtraColumn& extra : extras) extra.values.resize(num_points);
}

}  // namespace storey::io
