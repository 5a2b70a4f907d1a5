// SPDX-License-Identifier: BSD-3-Clause
// Records when each stage and each chunk ran and on which thread, for the Chrome trace format. One mutex is held for
// each event, once a stage or chunk. What takes turns inside of a stage (checks in queries, queries in expansion:
// PartClock) is a part of its event and has none of its own.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"

namespace warren {

class Trace {
 public:
  using Clock = std::chrono::steady_clock;
  struct Event {
    const char* name;  ///< a literal
    double begin_us;   ///< since the trace was made
    double duration_us;
    std::uint32_t thread;  ///< 0 is the thread that made the trace
    bool is_stage;
    std::uint64_t items;  ///< that were done, of a stopped stage that were to be; 0: not known
  };

  Trace() : start_(Clock::now()), threads_{std::this_thread::get_id()} {}

  /// Destructors call it, also while an exception is on its way: where memory is out, events() says so.
  void record(const char* name, Clock::time_point begin, Clock::time_point end, bool is_stage,
              std::uint64_t items = 0) noexcept {
    const auto micros = [](Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); };
    const std::lock_guard lock(mutex_);  // never contended for long
    try {
      const std::uint32_t thread = number_of(std::this_thread::get_id());
      events_.push_back({name, micros(begin - start_), micros(end - begin), thread, is_stage, items});
    } catch (const std::bad_alloc&) {
      is_whole_ = false;
    }
  }

  /// The stage that runs from now on, whose name chunks get; returns the one before.
  const char* enter(const char* stage) noexcept { return stage_.exchange(stage, std::memory_order_relaxed); }
  const char* stage() const noexcept { return stage_.load(std::memory_order_relaxed); }  ///< nullptr: none

  /// All events, thread by thread. Call when no worker runs. Throws std::bad_alloc where one could not be recorded.
  std::vector<Event> events() const {
    if (!is_whole_) throw std::bad_alloc();
    std::vector<Event> all = events_;
    std::stable_sort(all.begin(), all.end(), [](const Event& a, const Event& b) { return a.thread < b.thread; });
    return all;
  }
  std::size_t thread_count() const { return threads_.size(); }

 private:
  std::uint32_t number_of(std::thread::id id) {
    const auto found = std::find(threads_.begin(), threads_.end(), id);
    if (found != threads_.end()) return static_cast<std::uint32_t>(found - threads_.begin());
    threads_.push_back(id);
    return static_cast<std::uint32_t>(threads_.size() - 1);
  }

  Clock::time_point start_;
  std::atomic<const char*> stage_{nullptr};  // a name alone: which one a chunk sees changes no result
  std::mutex mutex_;                         // guards threads_ and events_
  std::vector<std::thread::id> threads_;     // by number
  std::vector<Event> events_;
  bool is_whole_ = true;
};

// What stages cost, wall-clock and CPU. Where the links of a chain take turns inside one loop, clocks of every few
// turns tell their shares (PartClock), and the stage's time is dealt out by these: of points every 32nd, for two looks
// at the clock each turn would cost as much as the turn; of bodies each, whose motions take microseconds. CPU time is
// the whole process's, so that of two solves at once each counts both.

/// CPU time that all threads of the process have taken so far.
double process_cpu_s() noexcept;

/// What takes turns inside of a stage; of `rest` the stage itself.
enum class StagePart : std::uint8_t { queries, checks, rest };

class StageAccount {
 public:
  /// So long a thread was busy with a part of the stage that runs. Any number of threads may say so.
  void add_part(StagePart part, double ns) noexcept {
    parts_ns_[static_cast<std::size_t>(part)].fetch_add(static_cast<std::uint64_t>(ns), std::memory_order_relaxed);
  }
  /// A stage begins: what was told before it belonged to none.
  void begin() noexcept {
    for (auto& ns : parts_ns_) ns.store(0, std::memory_order_relaxed);
  }
  /// A stage has ended: its parts get their shares, it gets the rest.
  void add(const char* stage, double wall_s, double cpu_s) noexcept;
  /// By name, in the order in which they first ended; none where memory is out.
  std::vector<StageCost> costs() const noexcept;

 private:
  void add_cost(const char* stage, double wall_s, double cpu_s) noexcept;

  std::mutex mutex_;  // guards costs_, once a stage
  struct Cost {
    const char* name = "";  // a literal
    double wall_s = 0.0;
    double cpu_s = 0.0;
  };
  std::array<Cost, 32> costs_;
  std::ptrdiff_t count_ = 0;
  std::array<std::atomic<std::uint64_t>, 2> parts_ns_{};
};

/// One thread's clock of what takes turns, of every `every`-th turn; tells the account when it goes. Without an account
/// it looks at no clock.
class PartClock : NotCopied {
 public:
  PartClock(const Execution& execution, std::uint32_t every) : account_(execution.account), every_(every) {}
  ~PartClock();

  /// A turn begins.
  void begin() {
    is_timed_ = account_ != nullptr && turns_++ % every_ == 0;
    if (!is_timed_) return;
    ++timed_;
    last_ = Clock::now();
  }
  /// What went by since was this part.
  void lap(StagePart part) {
    if (is_timed_) take(part);
  }

 private:
  using Clock = std::chrono::steady_clock;
  void take(StagePart part);

  StageAccount* account_;
  std::uint32_t every_;
  bool is_timed_ = false;
  std::uint64_t turns_ = 0;
  std::uint64_t timed_ = 0;
  std::array<double, 3> ns_{};
  Clock::time_point last_;
};

}  // namespace warren
