// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "bench/isolation.h"
#include "io/failure.h"

namespace storey::bench {
namespace {

TEST(Isolation, KeepsTheOrderAndReportsHowTasksEnd) {
  std::vector<Task> tasks;
  for (int i = 0; i < 20; ++i)
    tasks.emplace_back([i] { return std::string("\0x", 2) + char('a' + i); });
  tasks.emplace_back([]() -> std::string { throw std::runtime_error("no luck"); });
  tasks.emplace_back([]() -> std::string { std::abort(); });
  tasks.emplace_back([]() -> std::string { throw io::Failure(io::BadInput, "", "no walls", ""); });
  tasks.emplace_back([] { return std::string(100000, 'y'); });
  for (const unsigned int jobs : {1u, 3u}) {
    std::size_t finished = 0;
    const std::vector<Report> reports =
        runIsolated(tasks, jobs, [&](std::size_t, const Report&) { ++finished; });
    EXPECT_EQ(finished, tasks.size());
    ASSERT_EQ(reports.size(), tasks.size());
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(reports[i].result, std::string("\0x", 2) + static_cast<char>('a' + i));
      EXPECT_EQ(reports[i].failure, "");
    }
    EXPECT_EQ(reports[20].failure, "EXCEPTION: no luck");
    EXPECT_NE(reports[21].failure.find("CRASH"), std::string::npos);
    EXPECT_EQ(reports[22].failure, "no walls");
    EXPECT_EQ(reports[23].result, std::string(100000, 'y'));
  }
}

}  // namespace
}  // namespace storey::bench
