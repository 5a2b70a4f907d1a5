// SPDX-License-Identifier: BSD-3-Clause
// A few threads that take tasks from a short queue, so that whoever hands them out never waits: a full queue says no.
// A task may run loops of parallel/chunks.hpp.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace warren::serve {

class TaskCrew {
 public:
  /// threads >= 1. Where the system makes fewer, there are fewer; where it makes none, offer() does the task itself.
  TaskCrew(unsigned threads, std::size_t most_waiting);
  /// As end().
  ~TaskCrew() { end(); }
  TaskCrew(const TaskCrew&) = delete;
  TaskCrew& operator=(const TaskCrew&) = delete;

  /// Does the task soon, on one of the threads; false: too many wait already. Tasks don't throw.
  bool offer(std::function<void()> task);
  /// Tasks that nobody has begun.
  std::size_t waiting() const;
  /// Waits for the tasks that have begun; the others are never done. offer() then says no.
  void end();

 private:
  void work();

  const std::size_t most_waiting_;
  mutable std::mutex mutex_;  // guards what follows but threads_, which its owner alone touches
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace warren::serve
