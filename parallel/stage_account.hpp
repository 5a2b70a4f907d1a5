// SPDX-License-Identifier: BSD-3-Clause
// What stages cost, wall-clock and CPU. Where the links of a chain take turns inside one loop, clocks of every few
// turns tell their shares (PartClock), and the stage's time is dealt out by these: of points every 32nd, for two looks
// at the clock each turn would cost as much as the turn; of bodies each, whose motions take microseconds. CPU time is
// the whole process's, so that of two solves at once each counts both.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/base/counters.hpp"
#include "parallel/execution.hpp"

namespace warren {

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
class PartClock {
 public:
  PartClock(const Execution& execution, std::uint32_t every) : account_(execution.account), every_(every) {}
  ~PartClock();
  PartClock(const PartClock&) = delete;
  PartClock& operator=(const PartClock&) = delete;

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
