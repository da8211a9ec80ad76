// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/first_touch.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

using storey::detail::touchReserve;

// 64 MB: so much always comes from the system, and not from memory that was freed before.
constexpr std::size_t kEntries = std::size_t{1} << 24;

/// Share of the pages wholly inside a list's memory that the system has given to it.
double residentShare(const std::vector<int>& list) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(list.data());
  const std::uintptr_t first = (begin + page - 1) / page * page;
  const std::uintptr_t last = (begin + list.capacity() * sizeof(int)) / page * page;
  std::vector<unsigned char> resident((last - first) / page);
  if (mincore(reinterpret_cast<void*>(first), last - first, resident.data()) != 0) return -1.0;
  const auto count = std::count_if(resident.begin(), resident.end(),
                                   [](unsigned char flags) { return (flags & 1) != 0; });
  return static_cast<double>(count) / static_cast<double>(resident.size());
}

TEST(FirstTouch, FetchesAllMemoryThatAListReserves) {
  for (const unsigned int threads : {1u, 2u, 3u}) {
    std::vector<int> list;
    list.reserve(kEntries);
    ASSERT_LT(residentShare(list), 0.5);
    touchReserve(threads, list);
    EXPECT_EQ(residentShare(list), 1.0);
  }
}

TEST(FirstTouch, LeavesTheEntriesThatAreThere) {
  std::vector<int> list(kEntries / 2 + 1, 7);
  list.reserve(kEntries);
  touchReserve(2, list);
  EXPECT_EQ(list, std::vector<int>(kEntries / 2 + 1, 7));
}

TEST(FirstTouch, OfAFullListDoesNothing) {
  std::vector<int> list(3, 7);
  list.shrink_to_fit();
  touchReserve(2, list);
  EXPECT_EQ(list, std::vector<int>(3, 7));
}

}  // namespace
