// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/execution.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "parallel/stage_account.hpp"
#include "parallel/trace.hpp"

namespace warren {
namespace {

unsigned affinity_count() {
  cpu_set_t mask;
  if (::sched_getaffinity(0, sizeof mask, &mask) != 0) return std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&mask)));
}

/// Cores that the cgroup's quota pays for, rounded up; affinity_count() where there is no quota.
unsigned quota_count(unsigned fallback) {
  std::FILE* file = std::fopen("/sys/fs/cgroup/cpu.max", "r");
  if (file == nullptr) return fallback;
  double quota = 0.0;
  double period = 0.0;
  const int fields = std::fscanf(file, "%lf %lf", &quota, &period);
  std::fclose(file);
  if (fields != 2 || period <= 0.0) return fallback;
  return static_cast<unsigned>(std::max(1.0, std::ceil(quota / period)));
}

}  // namespace

unsigned thread_count(unsigned threads) {
  if (threads != 0) return threads;
  static const unsigned usable = [] {
    const unsigned cores = affinity_count();
    return std::min(cores, quota_count(cores));
  }();
  return usable;
}

StageTimer::StageTimer(const Execution& execution, const char* stage, double& seconds, std::uint64_t items)
    : trace_(execution.trace), account_(execution.account), stage_(stage), seconds_(seconds), items_(items) {
  if (execution.progress != nullptr) execution.progress->begin(stage, items);
  if (execution.trace != nullptr) before_ = execution.trace->enter(stage);
  if (execution.account != nullptr) {
    execution.account->begin();
    cpu_begin_s_ = process_cpu_s();
  }
  begin_ = std::chrono::steady_clock::now();
}

StageTimer::~StageTimer() {
  const auto end = std::chrono::steady_clock::now();
  const double wall_s = std::chrono::duration<double>(end - begin_).count();
  seconds_ += wall_s;
  if (account_ != nullptr) account_->add(stage_, wall_s, process_cpu_s() - cpu_begin_s_);
  if (trace_ == nullptr) return;
  trace_->enter(before_);
  trace_->record(stage_, begin_, end, true, items_);
}

}  // namespace warren
