// SPDX-License-Identifier: BSD-3-Clause
// The threads that help with loops: made when a loop first has chunks for them, kept for the next one until the program
// ends. Where the system makes no more threads, loops run on those there are, at the worst on their caller's alone, and
// most loops after that don't ask again; nothing but the time tells the difference. (oneTBB, which stood here before,
// aborts or hangs then: it starts threads on threads, where nobody can catch what they throw. The same speed, measured
// with tools/bench.)
// Whoever runs dry looks for another loop for some tens of microseconds, for the next one often comes at once, and
// sleeps then.
// Each thread begins in a share of its own, and helps with the others' where that is done: chunks drawn from one row
// for all made neighbours work side by side, in the same cache lines where each writes its slot (a quarter of the time
// of sampling mazes on two cores).
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

namespace warren {

/// Chunks 0 .. chunks - 1, each given to one thread. Lives on its caller's stack.
class SharedLoop {
 public:
  SharedLoop(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t));

  /// Runs chunks until none is left, those of the thread's own share first; the first exception ends the loop.
  /// thread: 0 for the caller, then the helpers.
  void work(std::size_t thread) noexcept;
  bool has_chunks() const;
  /// Call when all have left: throws what a chunk threw.
  void rethrow() const;

 private:
  friend class WorkerCrew;

  static constexpr std::size_t most_shares = 16;
  /// In a cache line of its own.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};  // each value is handed to one thread
    std::size_t end = 0;
    bool has_chunks() const { return next.load(std::memory_order_relaxed) < end; }
  };

  void work_on(Share& share) noexcept;

  const std::size_t chunks_;
  const unsigned threads_;
  const void* body_;
  void (*call_)(const void*, std::size_t);
  const std::size_t share_count_;
  std::array<Share, most_shares> shares_;
  std::atomic<bool> failed_{false};  // whoever sets it writes error_
  std::exception_ptr error_;         // read when nobody is inside
  std::atomic<unsigned> inside_{0};  // helpers; written under the crew's mutex
  std::condition_variable left_;     // inside_ became 0
  SharedLoop* next_loop_ = nullptr;  // under the crew's mutex
};

/// Is never ended: its threads end with the process.
class WorkerCrew {
 public:
  /// Starts a thread that helps as number `index`. Throws std::system_error or std::bad_alloc where none can be made.
  using Start = void (*)(WorkerCrew& crew, std::size_t index);

  explicit WorkerCrew(Start start = start_thread) : start_(start) {}
  ~WorkerCrew() = delete;
  WorkerCrew(const WorkerCrew&) = delete;
  WorkerCrew& operator=(const WorkerCrew&) = delete;

  /// Runs a loop on the calling thread and up to loop.threads - 1 others. Any threads may call it, also from loops.
  void run(SharedLoop& loop);

 private:
  struct Worker {
    std::condition_variable wake;
    bool asleep = false;
  };

  static void start_thread(WorkerCrew& crew, std::size_t index);
  void grow(std::size_t count);
  [[noreturn]] void help(std::size_t index);
  void wait_for_work(std::unique_lock<std::mutex>& lock, Worker& worker, std::size_t index);
  SharedLoop* loop_for(std::size_t index) const;
  void open(SharedLoop& loop);
  void close(SharedLoop& loop);

  static constexpr unsigned loops_between_tries = 500;  // a refusal takes its time, and the mutex holds up all loops

  const Start start_;
  std::mutex mutex_;  // guards all below but posts_, which is only written under it
  std::vector<std::unique_ptr<Worker>> workers_;
  SharedLoop* first_loop_ = nullptr;
  unsigned refused_at_ = 0U - loops_between_tries;  // value of posts_ when the system last made no thread
  std::atomic<unsigned> posts_{0};                  // loops opened so far, for those who look for one without the mutex
};

}  // namespace warren
