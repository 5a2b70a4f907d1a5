// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/limits.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "parallel/ticker.hpp"

namespace warren {

LimitedExecution::LimitedExecution(const Limits& limits)
    : deadline_(limits.budget ? std::chrono::duration<double>(*limits.budget).count()
                              : std::numeric_limits<double>::infinity(),
                limits.memory.value_or(available_bytes()), limits.cancel) {
  if (limits.budget && limits.budget->count() <= 0) throw UsageError("@budget: must be longer than nothing");
  if (limits.threads > most_threads) {
    throw UsageError(fmt::format("@threads: must be at most {} (found: {})", most_threads, limits.threads));
  }
  execution_.threads = limits.threads;
  execution_.deadline = &deadline_;
  on_improvement_ = limits.on_improvement;
  if (on_improvement_) execution_.on_improvement = &on_improvement_;
  if (!limits.progress) return;
  execution_.progress = &progress_;
  constexpr std::chrono::milliseconds pause(100);
  reporter_ = std::make_unique<Ticker>(pause, pause, [this, report = limits.progress] {
    const char* stage = progress_.stage();
    if (stage != nullptr) report({stage, progress_.done(), progress_.total()});
  });
}

LimitedExecution::~LimitedExecution() = default;

}  // namespace warren
