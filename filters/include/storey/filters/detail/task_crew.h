// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace storey::detail {

/// Threads for many short lists of tasks, one list after the other. Between lists they sleep, and a
/// list never waits for one that has not begun: OpenMP's threads spin for milliseconds, and where
/// other programs keep the cores busy each list would wait until all of them have had their turn.
class TaskCrew {
 public:
  /// \param threads with the caller's
  explicit TaskCrew(int threads);
  ~TaskCrew();
  TaskCrew(const TaskCrew&) = delete;
  TaskCrew& operator=(const TaskCrew&) = delete;

  /// Threads at work, with the caller's.
  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls `work(i)`, which must not throw, for all i < count and returns when all is done. One
  /// list at a time.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  void help();
  void takeTasks(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t next_ = 0;  // task of the list
  std::size_t count_ = 0;
  int busy_ = 0;  // helpers with tasks
  bool leaving_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace storey::detail
