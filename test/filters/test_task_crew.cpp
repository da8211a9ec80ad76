// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/filters/detail/task_crew.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace {

using storey::detail::TaskCrew;

TEST(TaskCrew, DoesEachTaskOfManyListsOnce) {
  for (const int threads : {1, 2, 5}) {
    TaskCrew crew(threads);
    EXPECT_EQ(crew.size(), threads);
    for (std::size_t count = 0; count < 200; ++count) {
      std::vector<int> done(count, 0);
      crew.run(count, [&](std::size_t i) { ++done[i]; });
      // All is done when it returns, and nothing twice.
      EXPECT_EQ(std::count(done.begin(), done.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
  }
}

TEST(TaskCrew, ThreadsWorkSideBySide) {
  // Tasks that wait for each other end only where each has a thread.
  constexpr int kThreads = 3;
  TaskCrew crew(kThreads);
  ASSERT_EQ(crew.size(), kThreads);
  std::atomic<int> begun{0};
  std::vector<std::thread::id> by(kThreads);
  crew.run(kThreads, [&](std::size_t i) {
    by[i] = std::this_thread::get_id();
    ++begun;
    while (begun < kThreads) std::this_thread::yield();
  });
  EXPECT_EQ(std::set<std::thread::id>(by.begin(), by.end()).size(),
            static_cast<std::size_t>(kThreads));
}

TEST(TaskCrew, AloneTheCallerDoesItInOrder) {
  TaskCrew crew(1);
  std::vector<std::size_t> order;
  crew.run(10, [&](std::size_t i) { order.push_back(i); });
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  EXPECT_EQ(order.size(), 10U);
}

}  // namespace
