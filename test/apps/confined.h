// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <fstream>
#include <functional>
#include <string>

namespace storey::test {

constexpr unsigned kMaxSeconds = 1;
constexpr rlim_t kMaxMemory = rlim_t{256} << 20;  // bytes beyond what the process has already

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitMemory = false;  // the sanitizer's shadow takes terabytes of addresses
#else
constexpr bool kLimitMemory = true;
#endif

inline void limitResources() {
  alarm(kLimitMemory ? kMaxSeconds : 30 * kMaxSeconds);
  if (!kLimitMemory) return;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMaxMemory;
  const rlimit rule{limit, limit};
  setrlimit(RLIMIT_AS, &rule);
}

/// Runs `body` in a child under limits of time and memory; returns what it returned, or
/// "killed ..." if the child did not end by itself.
inline std::string inChild(const std::function<std::string()>& body) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    limitResources();
    std::string answer;
    try {
      answer = body();
    } catch (const std::exception& error) {
      answer = std::string("exception ") + error.what();
    }
    const bool sent = write(ends[1], answer.data(), answer.size()) >= 0;
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  std::string answer;
  char buffer[4096];
  for (ssize_t got; (got = read(ends[0], buffer, sizeof buffer)) > 0;) {
    answer.append(buffer, static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return "killed by signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? answer : "killed, status " + std::to_string(status);
}

}  // namespace storey::test
