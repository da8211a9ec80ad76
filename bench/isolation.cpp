// SPDX-License-Identifier: BSD-3-Clause
#include "bench/isolation.h"

#include <omp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <system_error>

#include "io/failure.h"

namespace storey::bench {
namespace {

constexpr rlim_t kMaxCpuSeconds = 1800;
// Exit statuses of tasks without a result.
constexpr int kThrown = 1;
constexpr int kRefused = 2;  // by an `io::Failure`

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

struct Child {
  std::size_t task = 0;
  File output;  // shared with the process, which writes its result or what was thrown
};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

[[noreturn]] void runAndExit(const Task& task, std::FILE* output) {
  const rlimit no_core{0, 0};
  const rlimit cpu{kMaxCpuSeconds, kMaxCpuSeconds + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &cpu);
  omp_set_num_threads(1);  // the processes share the cores already
  std::string text;
  int status = 0;
  try {
    text = task();
  } catch (const io::Failure& refusal) {
    text = refusal.what();
    status = kRefused;
  } catch (const std::exception& error) {
    text = error.what();
    status = kThrown;
  }
  const bool written =
      std::fwrite(text.data(), 1, text.size(), output) == text.size() && std::fflush(output) == 0;
  _exit(written ? status : kThrown);  // without the caller's exit handlers and buffers
}

std::string contentOf(std::FILE* file) {
  std::string content;
  char buffer[4096];
  std::rewind(file);
  for (std::size_t size; (size = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
    content.append(buffer, size);
  }
  return content;
}

Report reportOf(const Child& child, int status) {
  const std::string content = contentOf(child.output.get());
  if (WIFSIGNALED(status)) {
    return {"", std::string("CRASH: ") + strsignal(WTERMSIG(status))};
  }
  if (WEXITSTATUS(status) == kRefused) return {"", content};
  if (WEXITSTATUS(status) != 0) return {"", "EXCEPTION: " + content};
  return {content, ""};
}

}  // namespace

std::vector<Report> runIsolated(const std::vector<Task>& tasks, unsigned int jobs,
                                const std::function<void(std::size_t, const Report&)>& finished) {
  std::vector<Report> reports(tasks.size());
  std::map<pid_t, Child> running;
  std::size_t next = 0;
  while (next < tasks.size() || !running.empty()) {
    if (next < tasks.size() && running.size() < jobs) {
      Child child{next, File(std::tmpfile())};
      if (!child.output) fail("a temporary file");
      const pid_t process = fork();
      if (process < 0) fail("a new process");
      if (process == 0) runAndExit(tasks[next], child.output.get());
      running.emplace(process, std::move(child));
      ++next;
      continue;
    }
    int status = 0;
    const pid_t process = wait(&status);
    if (process < 0) fail("waiting for a process");
    const auto child = running.find(process);
    if (child == running.end()) continue;  // not one of ours
    const std::size_t task = child->second.task;
    reports[task] = reportOf(child->second, status);
    running.erase(child);
    finished(task, reports[task]);
  }
  return reports;
}

}  // namespace storey::bench
