// SPDX-License-Identifier: BSD-3-Clause
// What a run cost beside its time: CPU seconds, page faults and involuntary switches of the process, and the
// processor's own counts where the kernel hands them out (perf_event_open; many virtual machines and containers don't).
// Read before and after a run and subtracted. Cost of a reading: a few microseconds.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace warren::studies {

/// Counts since some beginning, or between two readings.
struct RunCounts {
  static constexpr std::array<std::string_view, 4> hardware_names{"cycles", "instructions", "cache_misses",
                                                                  "branch_misses"};
  double cpu_s = 0.0;                                ///< of all threads, in user and kernel mode
  std::uint64_t page_faults = 0;                     ///< answered without reading from a disk
  std::uint64_t involuntary_switches = 0;            ///< a thread had to make way for another process
  std::vector<std::optional<double>> hardware = {};  ///< by name, in user mode; scaled where the kernel took turns

  friend RunCounts operator-(const RunCounts& after, const RunCounts& before);
  /// Whether the processor's count of this name is there.
  std::optional<double> hardware_count(std::string_view name) const;
};

/// cpu_s page_faults involuntary_switches, and those of the hardware's counts that are there.
nlohmann::ordered_json counts_json(const RunCounts& counts);

/// One of the kernel's events, as perf_event_open takes it.
struct PerfEvent {
  std::uint32_t type;
  std::uint64_t config;
};

/// Counts for this thread and all threads that it or they start from now on: make it before the first parallel loop.
class RunCounters {
 public:
  RunCounters();
  /// These events instead of RunCounts::hardware_names.
  explicit RunCounters(std::span<const PerfEvent> events);
  ~RunCounters();
  RunCounters(const RunCounters&) = delete;
  RunCounters& operator=(const RunCounters&) = delete;

  RunCounts read() const;
  /// Why none of the events is counted, as the system says it; empty if one is.
  const std::string& refusal() const { return refusal_; }

 private:
  std::vector<int> files_;  // a descriptor for each event, or -1
  std::string refusal_;
};

}  // namespace warren::studies
