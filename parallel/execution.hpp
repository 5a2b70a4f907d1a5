// SPDX-License-Identifier: BSD-3-Clause
// How a computation is run: on how many threads, until when, and who is told how far it is. Passed by const& through
// every stage; none of it changes a result.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "parallel/deadline.hpp"

namespace warren {

/// How far a stage is; written by the workers, read by whoever draws it.
class Progress {
 public:
  /// A stage begins; `stage` is a literal, total 0 where nobody knows.
  void begin(const char* stage, std::uint64_t total) noexcept {
    done_.store(0, std::memory_order_relaxed);
    total_.store(total, std::memory_order_relaxed);
    stage_.store(stage, std::memory_order_release);
  }
  /// The stage has so many items, as it turns out.
  void set_total(std::uint64_t total) noexcept { total_.store(total, std::memory_order_relaxed); }
  /// So many items more are done. Any number of threads may say so.
  void advance(std::uint64_t items) noexcept { done_.fetch_add(items, std::memory_order_relaxed); }
  const char* stage() const noexcept { return stage_.load(std::memory_order_acquire); }  ///< a literal, or nullptr
  /// Items of the stage that are done.
  std::uint64_t done() const noexcept { return done_.load(std::memory_order_relaxed); }
  std::uint64_t total() const noexcept { return total_.load(std::memory_order_relaxed); }  ///< 0: not known

 private:
  std::atomic<const char*> stage_{nullptr};
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> total_{0};
};

class Trace;         // parallel/trace.hpp
class StageAccount;  // parallel/stage_account.hpp

/// What changes the time of a call, never its result.
struct Execution {
  unsigned threads = 0;                ///< 0: one a core that this process may use; changes the time, never the result
  const Deadline* deadline = nullptr;  ///< nullptr: no limit
  Progress* progress = nullptr;        ///< nullptr: nobody watches
  Trace* trace = nullptr;              ///< nullptr: nobody records
  StageAccount* account = nullptr;     ///< nullptr: nobody asks what a stage costs

  /// Throws Stopped if it is time to stop.
  void check() const {
    if (deadline != nullptr) deadline->check();
  }
  /// Is it time to stop?
  bool should_stop() const noexcept { return deadline != nullptr && deadline->reached().has_value(); }
  /// Throws Stopped{memory} if so many further bytes would pass the limit.
  void reserve(std::size_t bytes) const {
    if (deadline != nullptr) deadline->reserve(bytes);
  }
  /// Tells whoever watches that so many items more are done.
  void advance(std::uint64_t items) const noexcept {
    if (progress != nullptr) progress->advance(items);
  }
};

/// The threads that `threads` asks for: itself, or for 0 the smallest of hardware, affinity mask and cgroup quota.
unsigned thread_count(unsigned threads);

/// Measures one stage: adds the seconds between construction and destruction to `seconds`, and names the stage to
/// whoever watches, records or keeps account.
class StageTimer {
 public:
  /// The stage begins; `items`: how many it has, 0: not known. `seconds` and what the execution points to outlive it.
  StageTimer(const Execution& execution, const char* stage, double& seconds, std::uint64_t items = 0);
  ~StageTimer();
  /// So many items it had, where they are known at its end alone: for a trace.
  void set_items(std::uint64_t items) noexcept { items_ = items; }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Trace* trace_;
  StageAccount* account_;
  const char* stage_;
  const char* before_ = nullptr;  // the stage in which this one is, in a trace
  double& seconds_;
  std::uint64_t items_;
  double cpu_begin_s_ = 0.0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace warren
