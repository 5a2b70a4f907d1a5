// SPDX-License-Identifier: BSD-3-Clause
// How much a call may take: threads, time, memory; and who may stop it and is told how far it is. None of it changes an
// answer, but that a stop is one.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "core/base/page_pool.hpp"
#include "core/run/execution.hpp"

namespace warren {

class Ticker;  // parallel/ticker.hpp

/// How far a call is.
struct ProgressReport {
  std::string_view stage;   ///< "sample", "connect", "search", …
  std::uint64_t done = 0;   ///< items of the stage
  std::uint64_t total = 0;  ///< 0: not known
};

/// That a call may ask for.
inline constexpr unsigned most_threads = 1024;

/// What a call may take. Limits change its time, never its result.
struct Limits {
  unsigned threads = 0;                                      ///< <= 1024; 0: one a core that this process may use
  std::optional<std::chrono::nanoseconds> budget = {};       ///< from the call on, > 0; none: no end
  std::optional<std::size_t> memory = {};                    ///< bytes that the process may hold; none: all there is
  const SignalFlag* cancel = nullptr;                        ///< stops the call as soon as it is not 0
  std::function<void(const ProgressReport&)> progress = {};  ///< called ten times a second, on another thread
  /// Called with each better path by planners that get better with time, on the thread that called; false ends the
  /// search with the path that it has.
  std::function<bool(const Improvement&)> on_improvement = {};
};

/// The execution that keeps limits; the budget begins with it. Not movable: the execution points into it. Throws
/// UsageError for limits that nobody can keep.
class LimitedExecution : NotCopied {
 public:
  /// Its budget begins; `limits` is copied, its flag is not.
  explicit LimitedExecution(const Limits& limits);
  ~LimitedExecution();

  /// Valid while this lives.
  const Execution& execution() const { return execution_; }

 private:
  PagePool pages_;  // what one stage leaves is warm for the next
  Deadline deadline_;
  Progress progress_;
  std::function<bool(const Improvement&)> on_improvement_;
  Execution execution_;
  std::unique_ptr<Ticker> reporter_;  // last: it ends before what it looks at
};

}  // namespace warren
