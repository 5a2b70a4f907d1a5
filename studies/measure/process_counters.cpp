// SPDX-License-Identifier: BSD-3-Clause
#include "studies/measure/process_counters.hpp"

#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

namespace warren::studies {
namespace {

constexpr std::array<PerfEvent, 4> hardware_events{{{PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
                                                    {PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS},
                                                    {PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_MISSES},
                                                    {PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_MISSES}}};
static_assert(hardware_events.size() == RunCounts::hardware_names.size());

/// Starts to count, threads that are started later included; -1 where the kernel refuses.
int open_event(const PerfEvent& event) {
  perf_event_attr attributes{};
  attributes.size = sizeof(attributes);
  attributes.type = event.type;
  attributes.config = event.config;
  attributes.inherit = 1;
  attributes.exclude_kernel = 1;  // what an ordinary user may count
  attributes.exclude_hv = 1;
  attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  constexpr int this_thread = 0;
  constexpr int any_cpu = -1;
  constexpr int no_group = -1;
  return static_cast<int>(
      ::syscall(SYS_perf_event_open, &attributes, this_thread, any_cpu, no_group, PERF_FLAG_FD_CLOEXEC));
}

/// The count so far; none if the event was never on a counter.
std::optional<double> read_event(int file) {
  struct Reading {
    std::uint64_t count, enabled_ns, running_ns;
  } reading{};
  if (file < 0 || ::read(file, &reading, sizeof(reading)) != static_cast<ssize_t>(sizeof(reading))) return std::nullopt;
  if (reading.running_ns == 0) return std::nullopt;
  return static_cast<double>(reading.count) * static_cast<double>(reading.enabled_ns) /
         static_cast<double>(reading.running_ns);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

RunCounts operator-(const RunCounts& after, const RunCounts& before) {
  RunCounts between{after.cpu_s - before.cpu_s, after.page_faults - before.page_faults,
                    after.involuntary_switches - before.involuntary_switches};
  for (std::size_t i = 0; i < after.hardware.size(); ++i) {
    const bool is_known = after.hardware[i] && i < before.hardware.size();
    // An event that had no counter at first has counted nothing then.
    between.hardware.push_back(is_known ? std::optional(*after.hardware[i] - before.hardware[i].value_or(0.0))
                                        : std::nullopt);
  }
  return between;
}

std::optional<double> RunCounts::hardware_count(std::string_view name) const {
  const auto at =
      static_cast<std::size_t>(std::find(hardware_names.begin(), hardware_names.end(), name) - hardware_names.begin());
  return at < hardware.size() ? hardware[at] : std::nullopt;
}

nlohmann::ordered_json counts_json(const RunCounts& counts) {
  nlohmann::ordered_json json{{"cpu_s", counts.cpu_s},
                              {"page_faults", counts.page_faults},
                              {"involuntary_switches", counts.involuntary_switches}};
  for (const std::string_view name : RunCounts::hardware_names) {
    if (const auto count = counts.hardware_count(name)) json[std::string{name}] = static_cast<std::uint64_t>(*count);
  }
  return json;
}

RunCounters::RunCounters() : RunCounters(hardware_events) {}

RunCounters::RunCounters(std::span<const PerfEvent> events) {
  int error = 0;
  for (const PerfEvent& event : events) {
    files_.push_back(open_event(event));
    if (files_.back() < 0) error = errno;
  }
  const bool none = std::all_of(files_.begin(), files_.end(), [](int file) { return file < 0; });
  if (none) refusal_ = std::generic_category().message(error);
}

RunCounters::~RunCounters() {
  for (const int file : files_) {
    if (file >= 0) ::close(file);
  }
}

RunCounts RunCounters::read() const {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  RunCounts counts{seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime), static_cast<std::uint64_t>(usage.ru_minflt),
                   static_cast<std::uint64_t>(usage.ru_nivcsw)};
  for (const int file : files_) counts.hardware.push_back(read_event(file));
  return counts;
}

}  // namespace warren::studies
