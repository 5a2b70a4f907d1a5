// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/task_crew.hpp"

#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/page_pool.hpp"

namespace warren::serve {
namespace {

/// The pages of a task's large blocks are the next one's: fresh ones take longer to touch than a path to find.
class PagesOfTasks {
 public:
  PagesOfTasks() { renew(); }
  void end_task() {
    constexpr std::size_t most_idle_bytes = std::size_t{128} << 20U;
    if (PagePool::idle_bytes() > most_idle_bytes) renew();
  }

 private:
  void renew() {
    try {
      pool_.emplace();
    } catch (const std::bad_alloc&) {  // then all pages are fresh
    }
  }
  std::optional<PagePool> pool_;
};

}  // namespace

TaskCrew::TaskCrew(unsigned threads, std::size_t most_waiting) : most_waiting_(most_waiting) {
  try {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // as many as there are
  }
}

bool TaskCrew::offer(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (ended_ || tasks_.size() >= most_waiting_) return false;
    if (!threads_.empty()) {
      tasks_.push_back(std::move(task));
      wake_.notify_one();
      return true;
    }
  }
  task();
  return true;
}

std::size_t TaskCrew::waiting() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size();
}

void TaskCrew::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    tasks_.clear();
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void TaskCrew::work() {
  PagesOfTasks pages;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
    if (ended_) return;
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    pages.end_task();
    lock.lock();
  }
}

}  // namespace warren::serve
