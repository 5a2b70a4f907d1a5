// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/limits.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "parallel/ticker.hpp"

namespace warren {
namespace {

double seconds_of(const Limits& limits) {
  if (!limits.budget) return std::numeric_limits<double>::infinity();
  const double seconds = std::chrono::duration<double>(*limits.budget).count();
  if (!(seconds > 0.0)) throw UsageError("@budget: must be longer than nothing");
  return seconds;
}

unsigned threads_of(const Limits& limits) {
  if (limits.threads > most_threads) {
    throw UsageError(fmt::format("@threads: must be at most {} (found: {})", most_threads, limits.threads));
  }
  return limits.threads;
}

}  // namespace

struct LimitedExecution::Reporter {
  Reporter(const Progress& progress, const std::function<void(const ProgressReport&)>& report)
      : ticker(std::chrono::milliseconds(100), std::chrono::milliseconds(100), [&progress, report] {
          const char* stage = progress.stage();
          if (stage != nullptr) report({stage, progress.done(), progress.total()});
        }) {}
  Ticker ticker;
};

LimitedExecution::LimitedExecution(const Limits& limits)
    : deadline_(seconds_of(limits), limits.memory.value_or(available_bytes()), limits.cancel) {
  execution_.threads = threads_of(limits);
  execution_.deadline = &deadline_;
  on_improvement_ = limits.on_improvement;
  if (on_improvement_) execution_.on_improvement = &on_improvement_;
  if (!limits.progress) return;
  execution_.progress = &progress_;
  reporter_ = std::make_unique<Reporter>(progress_, limits.progress);
}

LimitedExecution::~LimitedExecution() = default;

}  // namespace warren
