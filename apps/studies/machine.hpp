// SPDX-License-Identifier: BSD-3-Clause
// The machine that a measurement was made on, and its memory as measurements need it: warmed, and with a peak that
// starts anew. On a virtual machine the first touch of a page can cost a hundred times the second (the host has to find
// it), and that cost belongs to the machine, not to a solver: it is measured apart.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"

namespace warren::studies {

/// This one: "Intel(R) Xeon(R), 2 cores, 31.4 GiB". The name of its CPU's model, or "unknown CPU"; the cores that this
/// process may use; its memory in all, 0 where the system doesn't tell.
std::string machine_text();
/// {"cpu": …, "cores": …, "memory_bytes": …}
nlohmann::ordered_json machine_json();

/// From now on peak_resident_bytes() tells the peak since now, where the system can do that.
void restart_peak_memory();

/// What touching memory for the first time has cost, before a clock starts, so that what follows finds it warm.
struct MemoryTouch {
  std::size_t bytes = 0;  ///< the most that was touched at once; 0: nothing was
  double cold_s = 0.0;    ///< the first time
  double warm_s = 0.0;    ///< the same bytes once more
};

/// Has so many bytes touched at once, unless they were, or are too few to matter, or more than the limit allows.
/// Throws Stopped at a signal.
void touch_memory(std::size_t bytes, MemoryTouch& so_far, const Execution& execution);

/// What a run cost beside its time: CPU seconds, page faults and involuntary switches of the process, and the
/// processor's own counts where the kernel hands them out (perf_event_open; many virtual machines and containers
/// don't). Read before and after a run and subtracted. Cost of a reading: a few microseconds. Counts since some
/// beginning, or between two readings.
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
class RunCounters : NotCopied {
 public:
  RunCounters();
  /// These events instead of RunCounts::hardware_names.
  explicit RunCounters(std::span<const PerfEvent> events);
  ~RunCounters();

  RunCounts read() const;
  /// Why none of the events is counted, as the system says it; empty if one is.
  const std::string& refusal() const { return refusal_; }

 private:
  std::vector<int> files_;  // a descriptor for each event, or -1
  std::string refusal_;
};

// What the machine itself gives to several threads at this moment. Two cores of a virtual machine may be two threads of
// one core, or share it with somebody else: then even arithmetic in registers doesn't run twice as fast on both, and no
// program can. So that a speed-up can be held against what was there, the same arithmetic is timed beside each run.

/// Rounds of integer arithmetic a second that the execution's threads do together, in registers, enough of it at once
/// to fill a core: latency leaves no room for another thread on the same core. Timed in each thread, so that waking
/// threads and sharing out the work cost nothing. Takes some 10 ms of CPU. Throws Stopped.
double arithmetic_per_second(const Execution& execution);

}  // namespace warren::studies
