// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

namespace storey::bench {
namespace {

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  execv(program.c_str(), words.data());
  _exit(127);
}

}  // namespace

ProgramRun runProgram(const std::string& name, const std::vector<std::string>& arguments) {
  namespace fs = std::filesystem;
  const std::string program = fs::read_symlink("/proc/self/exe").replace_filename(name).string();
  const auto start = std::chrono::steady_clock::now();
  const pid_t process = fork();
  if (process == 0) become(program, arguments);
  int status = 0;
  rusage usage{};
  if (process < 0 || wait4(process, &status, 0, &usage) < 0) return {-1};
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, wall.count(),
          secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime),
          1024.0 * static_cast<double>(usage.ru_maxrss)};
}

}  // namespace storey::bench
