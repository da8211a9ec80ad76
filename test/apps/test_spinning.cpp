// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "cli/spinning.h"

namespace storey::cli {
namespace {

constexpr const char* kSpins = "GOMP_SPINCOUNT";
constexpr const char* kPolicy = "OMP_WAIT_POLICY";
constexpr const char* kStartedAnew = "STOREY_TEST_STARTED_ANEW";
constexpr int kNotStartedAnew = 7;

/// In a process of its own: this program, of which a new start runs only the test below.
[[noreturn]] void limitAndLeave(const char* given) {
  unsetenv(kSpins);
  unsetenv(kPolicy);
  if (given != nullptr) setenv(given, "5", 1);
  setenv(kStartedAnew, "1", 1);
  std::string name = "test_spinning";
  std::string filter = "--gtest_filter=StartedAnew.ThreadsSpinLittle";
  char* arguments[] = {name.data(), filter.data(), nullptr};
  limitSpinning(arguments);
  _exit(kNotStartedAnew);
}

TEST(Spinning, ProgramsAreStartedAnewOnce) {
  EXPECT_EXIT(limitAndLeave(nullptr), testing::ExitedWithCode(0), "");
}

TEST(Spinning, WhatTheUserAsksForStays) {
  EXPECT_EXIT(limitAndLeave(kSpins), testing::ExitedWithCode(kNotStartedAnew), "");
  EXPECT_EXIT(limitAndLeave(kPolicy), testing::ExitedWithCode(kNotStartedAnew), "");
}

TEST(StartedAnew, ThreadsSpinLittle) {
  if (std::getenv(kStartedAnew) == nullptr) GTEST_SKIP() << "part of the tests above";
  const char* const spins = std::getenv(kSpins);
  ASSERT_NE(spins, nullptr);
  EXPECT_LE(std::stoi(spins), 10000);
  char* arguments[] = {nullptr};
  limitSpinning(arguments);  // returns: not a second time
}

}  // namespace
}  // namespace storey::cli
