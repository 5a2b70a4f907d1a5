// SPDX-License-Identifier: BSD-3-Clause
// How a computation is run: on how many threads, until when, and who is told how far it is. Passed by const& through
// every stage; none of it changes a result.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/solution.hpp"

namespace warren {
/// Thrown where a budget ended or a signal came. Whoever solves makes it an answer; what() is the reason's name.
struct Stopped : Error {
  /// For this reason; bytes: what memory was wanted, 0: not known.
  explicit Stopped(StopReason why, std::size_t bytes = 0) noexcept : reason(why), wanted_bytes(bytes) {}
  /// The reason's name: "budget", "memory", "SIGINT", "SIGTERM" or "SIGHUP".
  const char* what() const noexcept override { return name_of(reason).data(); }
  StopReason reason;         ///< a limit, or a signal
  std::size_t wanted_bytes;  ///< of memory: the least that the process would have held; 0: of others, and not known
};

/// Why `work` ended early, by a limit, a signal or for want of memory; none: it is done.
template <class Work>
std::optional<StopReason> stopped_by(const Work& work) {
  try {
    work();
  } catch (const Stopped& stopped) {
    return stopped.reason;
  } catch (const std::bad_alloc&) {
    return StopReason::memory;
  }
  return std::nullopt;
}

/// Does `work` find the memory that it takes? Throws its other stops.
template <class Work>
bool memory_holds(const Work& work) {
  const auto stop = stopped_by(work);
  if (stop && *stop != StopReason::memory) throw Stopped{*stop};
  return !stop;
}

/// Set by a signal handler, read by all threads: 0, or the signal's number.
using SignalFlag = std::atomic<int>;

/// Memory of a part that runs beside others.
struct CountedRoom {
  std::size_t bytes;  ///< less than so many are granted in all, whatever is given back
};

/// Time budget, memory budget and cancellation. Long loops ask between batches; the answer is an exception of its own
/// type, `Stopped`, that the caller of a whole plan turns into Outcome::stopped. Polling costs one clock read, 25 ns.
/// Any number of threads may ask. Neither copied nor moved.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;  ///< that never goes back

  Deadline() = default;  ///< never ends, and has all memory
  /// seconds from now (infinity: no limit), bytes that the process may hold in all, a flag that a signal sets.
  explicit Deadline(double seconds, std::size_t memory_bytes = std::numeric_limits<std::size_t>::max(),
                    const SignalFlag* signal = nullptr);
  /// A part of what runs under `whole` (nullptr: no limit): it ends so many seconds from now (infinity: with the
  /// whole), or with the whole, and has its memory, less what is kept back of it, and its signal.
  Deadline(const Deadline* whole, double seconds, std::size_t kept_back_bytes = 0);
  /// A part beside others: it ends with the whole (nullptr: no limit), and is granted what both the whole and its own
  /// room allow. What that allows is a function of what the part asks for, whatever others hold at that moment.
  Deadline(const Deadline* whole, CountedRoom own);

  /// Why to stop, if it is time to.
  std::optional<StopReason> reached() const noexcept;
  /// Throws Stopped if it is time to.
  void check() const {
    if (const auto reason = reached()) throw Stopped{*reason};
  }
  /// Throws Stopped{memory} if this many further bytes would pass the limit: asked before large allocations. Asking the
  /// system takes 6 us, so a 64th of what was left when it was last asked is granted without.
  void reserve(std::size_t bytes) const;

  /// Seconds that are left, at least 0; infinity: no limit.
  double seconds_left() const noexcept;
  /// What the process may hold in all.
  std::size_t memory_bytes() const { return memory_bytes_; }
  /// Bytes that may still be granted; the most that there are: no limit. Where they are not counted they are measured
  /// and rounded down to an eighth of a power of two: a few threads' stacks make no difference, but at a step's border.
  std::size_t room() const;
  /// The most that the process would have held with what was refused; 0: nothing was.
  std::size_t wanted_bytes() const { return wanted_.load(std::memory_order_relaxed); }

 private:
  [[noreturn]] void refuse(std::size_t wanted) const;

  std::optional<Clock::time_point> end_;
  std::size_t memory_bytes_ = std::numeric_limits<std::size_t>::max();
  const SignalFlag* signal_ = nullptr;
  const Deadline* whole_ = nullptr;
  bool is_counted_ = false;
  mutable std::atomic<std::size_t> unasked_{0};  // bytes that are granted without a look; counted: all that are left
  mutable std::atomic<std::size_t> wanted_{0};
};

/// Bytes that this process holds now (resident set), and the most it has held, without the pages that the calling
/// thread keeps and has no use for (core/base/page_pool.hpp); 0 where the system doesn't tell.
std::size_t resident_bytes();
/// The most that this process has held, as resident_bytes().
std::size_t peak_resident_bytes();
/// Gives the system back what has been freed in small pieces, which stays resident until somebody asks for it. Any
/// thread, whatever allocator the program runs with.
void give_freed_pages_back() noexcept;
/// Bytes that this process may hold: the smaller of the machine's memory that is available, less a 16th of it for
/// everybody else, and the cgroup's limit.
std::size_t available_bytes();

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

class Trace;         // core/run/trace.hpp
class StageAccount;  // core/run/trace.hpp

/// What changes the time of a call, never its result, but that who is told of improvements may have enough.
struct Execution {
  unsigned threads = 0;                ///< 0: one a core that this process may use; changes the time, never the result
  const Deadline* deadline = nullptr;  ///< nullptr: no limit
  Progress* progress = nullptr;        ///< nullptr: nobody watches
  Trace* trace = nullptr;              ///< nullptr: nobody records
  StageAccount* account = nullptr;     ///< nullptr: nobody asks what a stage costs
  /// Told of each better path, on the thread that called, by planners that get better with time; false: enough.
  const std::function<bool(const Improvement&)>* on_improvement = nullptr;

  /// Throws Stopped if it is time to stop.
  void check() const {
    if (deadline != nullptr) deadline->check();
  }
  /// The same, in one of 4096 steps of a loop.
  void poll(std::uint64_t step) const {
    if (step % 4096 == 0) check();
  }
  /// Seconds that are left, at least 0; infinity: no limit.
  double seconds_left() const noexcept {
    return deadline != nullptr ? deadline->seconds_left() : std::numeric_limits<double>::infinity();
  }
  /// Is it time to stop?
  bool should_stop() const noexcept { return deadline != nullptr && deadline->reached().has_value(); }
  /// Throws Stopped{memory} if so many further bytes would pass the limit.
  void reserve(std::size_t bytes) const {
    if (deadline != nullptr) deadline->reserve(bytes);
  }
  /// The same without telling progress: passes inside a stage are no items of it.
  Execution quiet() const {
    Execution inner = *this;
    inner.progress = nullptr;
    return inner;
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
class StageTimer : NotCopied {
 public:
  /// The stage begins; `items`: how many it has, 0: not known. `seconds` and what the execution points to outlive it.
  StageTimer(const Execution& execution, const char* stage, double& seconds, std::uint64_t items = 0)
      : StageTimer(execution, stage, &seconds, items) {}
  /// The same; nullptr: nobody keeps the seconds.
  StageTimer(const Execution& execution, const char* stage, double* seconds, std::uint64_t items = 0);
  ~StageTimer();
  /// So many items it had, where they are known at its end alone: for a trace.
  void set_items(std::uint64_t items) noexcept { items_ = items; }

 private:
  Trace* trace_;
  StageAccount* account_;
  const char* stage_;
  const char* before_ = nullptr;  // the stage in which this one is, in a trace
  double* seconds_;
  std::uint64_t items_;
  double cpu_begin_s_ = 0.0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace warren
