// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/task_crew.h>

#include <system_error>

namespace storey::detail {

TaskCrew::TaskCrew(int threads) {
  try {
    for (int t = 1; t < threads; ++t) helpers_.emplace_back([this] { help(); });
  } catch (const std::system_error&) {
    // The system has no more threads: those that are there do it.
  }
}

TaskCrew::~TaskCrew() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    leaving_ = true;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void TaskCrew::run(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::unique_lock<std::mutex> lock(mutex_);
  work_ = &work;
  next_ = 0;
  count_ = count;
  if (count > 1) wake_.notify_all();
  takeTasks(lock);
  done_.wait(lock, [&] { return busy_ == 0; });
}

void TaskCrew::help() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return leaving_ || next_ < count_; });
    if (leaving_) return;
    ++busy_;
    takeTasks(lock);
    if (--busy_ == 0) done_.notify_one();
  }
}

void TaskCrew::takeTasks(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t task = next_++;
    const auto& work = *work_;
    lock.unlock();
    work(task);
    lock.lock();
  }
}

}  // namespace storey::detail
