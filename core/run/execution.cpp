// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/execution.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string_view>
#include <thread>

#include "core/base/page_pool.hpp"
#include "core/run/trace.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace warren {
namespace {

unsigned affinity_count() {
  cpu_set_t mask;
  if (::sched_getaffinity(0, sizeof mask, &mask) != 0) return std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&mask)));
}

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Cores that the cgroup's quota pays for, rounded up; affinity_count() where there is no quota.
unsigned quota_count(unsigned fallback) {
  const File file(std::fopen("/sys/fs/cgroup/cpu.max", "r"));
  double quota = 0.0;
  double period = 0.0;
  if (!file || std::fscanf(file.get(), "%lf %lf", &quota, &period) != 2 || period <= 0.0) return fallback;
  return static_cast<unsigned>(std::max(1.0, std::ceil(quota / period)));
}

/// The first number of a small file, or nothing ("max" counts as nothing).
std::optional<std::size_t> number_in(const char* path) {
  const File file(std::fopen(path, "r"));
  unsigned long long value = 0;
  if (!file || std::fscanf(file.get(), "%llu", &value) != 1) return std::nullopt;
  return static_cast<std::size_t>(value);
}

/// What the line of a name and a colon says in kilobytes.
std::optional<std::size_t> kilobytes_in(const char* path, std::string_view name) {
  const File file(std::fopen(path, "r"));
  char line[128];
  while (file && std::fgets(line, sizeof line, file.get()) != nullptr) {
    if (std::string_view(line).starts_with(name)) return std::strtoull(line + name.size(), nullptr, 10) * 1024;
  }
  return std::nullopt;
}

StopReason reason_of_signal(int number) {
  if (number == SIGTERM) return StopReason::terminate;
  return number == SIGHUP ? StopReason::hang_up : StopReason::interrupt;
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

StageTimer::StageTimer(const Execution& execution, const char* stage, double* seconds, std::uint64_t items)
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
  if (seconds_ != nullptr) *seconds_ += wall_s;
  if (account_ != nullptr) account_->add(stage_, wall_s, process_cpu_s() - cpu_begin_s_);
  if (trace_ == nullptr) return;
  trace_->enter(before_);
  trace_->record(stage_, begin_, end, true, items_);
}

void give_freed_pages_back() noexcept {
#ifdef __GLIBC__
  // The first call sets up glibc's allocator where another one stands before it (a sanitizer's, one that is preloaded),
  // and two threads must not do that at once.
  static const int first = ::malloc_trim(0);
  static_cast<void>(first);
  ::malloc_trim(0);
#endif
}

Deadline::Deadline(double seconds, std::size_t memory_bytes, const SignalFlag* signal)
    : memory_bytes_(memory_bytes), signal_(signal) {
  constexpr double longest_s = 1e9;  // about thirty years: beyond it the clock's own type would overflow
  if (std::isfinite(seconds) && seconds < longest_s) {
    end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
}

Deadline::Deadline(const Deadline* whole, double seconds, std::size_t kept_back_bytes) : Deadline(seconds) {
  if (whole == nullptr) return;
  memory_bytes_ = whole->memory_bytes_;
  if (memory_bytes_ != std::numeric_limits<std::size_t>::max()) {
    memory_bytes_ -= std::min(memory_bytes_, kept_back_bytes);
  }
  signal_ = whole->signal_;
  whole_ = whole;
  if (whole->end_ && (!end_ || *whole->end_ < *end_)) end_ = whole->end_;
  is_counted_ = whole->is_counted_;
  const std::size_t left = is_counted_ ? whole->room() : 0;
  unasked_.store(left - std::min(left, kept_back_bytes), std::memory_order_relaxed);
}

Deadline::Deadline(const Deadline* whole, CountedRoom own) : Deadline(whole, std::numeric_limits<double>::infinity()) {
  is_counted_ = true;
  unasked_.store(own.bytes, std::memory_order_relaxed);
}

std::optional<StopReason> Deadline::reached() const noexcept {
  if (signal_ != nullptr) {
    const int number = signal_->load(std::memory_order_relaxed);
    if (number != 0) return reason_of_signal(number);
  }
  if (end_ && Clock::now() >= *end_) return StopReason::time;
  return std::nullopt;
}

double Deadline::seconds_left() const noexcept {
  if (!end_) return std::numeric_limits<double>::infinity();
  return std::max(0.0, std::chrono::duration<double>(*end_ - Clock::now()).count());
}

void Deadline::refuse(std::size_t wanted) const {
  for (const Deadline* told = this; told != nullptr; told = told->whole_) {
    std::size_t most = told->wanted_.load(std::memory_order_relaxed);
    while (most < wanted && !told->wanted_.compare_exchange_weak(most, wanted, std::memory_order_relaxed)) continue;
  }
  throw Stopped{StopReason::memory, wanted};
}

void Deadline::reserve(std::size_t bytes) const {
  check();
  if (memory_bytes_ == std::numeric_limits<std::size_t>::max()) return;
  std::size_t unasked = unasked_.load(std::memory_order_relaxed);
  while (bytes < unasked) {
    if (!unasked_.compare_exchange_weak(unasked, unasked - bytes, std::memory_order_relaxed)) continue;
    if (is_counted_) whole_->reserve(bytes);
    return;
  }
  if (is_counted_) refuse(memory_bytes_ + std::min(bytes - unasked, ~memory_bytes_));
  const auto fits = [&](std::size_t held) { return held < memory_bytes_ && bytes <= memory_bytes_ - held; };
  std::size_t held = resident_bytes();
  if (!fits(held)) {
    give_freed_pages_back();
    held = resident_bytes();
  }
  if (!fits(held)) refuse(bytes + std::min(held, std::numeric_limits<std::size_t>::max() - bytes));
  unasked_.store((memory_bytes_ - held - bytes) / 64, std::memory_order_relaxed);
}

std::size_t Deadline::room() const {
  if (memory_bytes_ == std::numeric_limits<std::size_t>::max()) return memory_bytes_;
  if (is_counted_) return unasked_.load(std::memory_order_relaxed);
  std::size_t held = resident_bytes();
  if (held > memory_bytes_ / 256) {  // else all that has been freed is less than a step
    give_freed_pages_back();
    held = resident_bytes();
  }
  const std::size_t left = memory_bytes_ - std::min(memory_bytes_, held);
  const std::size_t step = std::max<std::size_t>(1, std::bit_floor(left) / 8);
  return left / step * step;
}

std::size_t resident_bytes() {
  const File file(std::fopen("/proc/self/statm", "r"));
  unsigned long long total = 0;
  unsigned long long resident = 0;
  if (!file || std::fscanf(file.get(), "%llu %llu", &total, &resident) != 2) return 0;
  const auto bytes = static_cast<std::size_t>(resident) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return bytes - std::min(bytes, PagePool::idle_bytes());
}

std::size_t peak_resident_bytes() {
  // Not getrusage's: that begins with what the process held that this program was started from.
  const std::size_t bytes = kilobytes_in("/proc/self/status", "VmHWM:").value_or(0);
  return bytes - std::min(bytes, PagePool::least_idle_bytes());
}

std::size_t available_bytes() {
  const std::size_t free =
      kilobytes_in("/proc/meminfo", "MemAvailable:").value_or(std::numeric_limits<std::size_t>::max());
  std::size_t bytes = free - free / 16 + resident_bytes();  // who takes all of it is killed for it
  if (const auto limit = number_in("/sys/fs/cgroup/memory.max")) bytes = std::min(bytes, *limit);
  if (const auto limit = number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes")) bytes = std::min(bytes, *limit);
  return bytes;
}

}  // namespace warren
