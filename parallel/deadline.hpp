// SPDX-License-Identifier: BSD-3-Clause
// Time budget, memory budget and cancellation. Long loops ask between batches; the answer is an exception of its own
// type, `Stopped`, that the caller of a whole plan turns into Outcome::stopped. Polling costs one clock read, 25 ns.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/stop_reason.hpp"

namespace warren {

/// Thrown where a budget ended or a signal came. Whoever solves makes it an answer; what() is the reason's name.
struct Stopped : Error {
  /// For this reason.
  explicit Stopped(StopReason why) noexcept : reason(why) {}
  /// The reason's name: "budget", "memory", "SIGINT", "SIGTERM" or "SIGHUP".
  const char* what() const noexcept override { return name_of(reason).data(); }
  StopReason reason;  ///< a limit, or a signal
};

/// Set by a signal handler, read by all threads: 0, or the signal's number.
using SignalFlag = std::atomic<int>;

/// Any number of threads may ask. Neither copied nor moved.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;  ///< that never goes back

  Deadline() = default;  ///< never ends, and has all memory
  /// seconds from now (infinity: no limit), bytes that the process may hold in all, a flag that a signal sets.
  explicit Deadline(double seconds, std::size_t memory_bytes = std::numeric_limits<std::size_t>::max(),
                    const SignalFlag* signal = nullptr);
  /// A part of what runs under `whole` (nullptr: no limit): it ends so many seconds from now (infinity: with the
  /// whole), or with the whole, and has its memory and its signal.
  Deadline(const Deadline* whole, double seconds);

  /// Why to stop, if it is time to.
  std::optional<StopReason> reached() const noexcept;
  /// Throws Stopped if it is time to.
  void check() const {
    if (const auto reason = reached()) throw Stopped{*reason};
  }
  /// Throws Stopped{memory} if this many further bytes would pass the limit: asked before large allocations. Asking the
  /// system takes 6 us, so a 64th of what was left when it was last asked is granted without.
  void reserve(std::size_t bytes) const;

  /// What the process may hold in all.
  std::size_t memory_bytes() const { return memory_bytes_; }

 private:
  std::optional<Clock::time_point> end_;
  std::size_t memory_bytes_ = std::numeric_limits<std::size_t>::max();
  const SignalFlag* signal_ = nullptr;
  mutable std::atomic<std::size_t> unasked_{0};  // bytes that may be granted without a look
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

}  // namespace warren
