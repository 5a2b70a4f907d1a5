// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/machine.hpp"

#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <numeric>
#include <system_error>

#include "core/base/page_pool.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::studies {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown CPU";
}

std::size_t machine_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) : 0;
}

/// Seconds that it takes to write a byte to every page of a new block.
double touch_once(std::size_t bytes, const Execution& execution) {
  constexpr std::size_t page = 4096;
  constexpr std::size_t grain = std::size_t{4} << 20;
  const auto begin = std::chrono::steady_clock::now();
  RawVector<std::uint8_t> block(bytes);
  for_chunks(bytes, grain, execution, [&](Range r) {
    volatile std::uint8_t* const byte = block.data();  // volatile: nobody reads them, yet they must be written
    for (std::size_t i = r.first; i < r.last; i += page) byte[i] = 1;
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

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

constexpr std::size_t probe_parts = 64;
constexpr std::uint64_t rounds = 120'000;  // of each part: some 150 us

/// One number that doesn't wait for the others. Opaque to the compiler, which would put several into one register, or
/// leave the work out.
inline void step(std::uint64_t round, std::uint64_t& x) {
  x ^= round;
  x += x;
  asm volatile("" : "+r"(x));
}

/// Numbers enough to keep all units for whole numbers of a core busy.
void run_part(std::uint64_t seed) {
  std::uint64_t a = seed, b = seed + 1, c = seed + 2, d = seed + 3;
  std::uint64_t e = seed + 4, f = seed + 5, g = seed + 6, h = seed + 7;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    step(round, a);
    step(round, b);
    step(round, c);
    step(round, d);
    step(round, e);
    step(round, f);
    step(round, g);
    step(round, h);
  }
}

}  // namespace

std::string machine_text() {
  const unsigned cores = thread_count(0);
  return fmt::format("{}, {} {}, {}", cpu_model(), cores, cores == 1 ? "core" : "cores",
                     human_bytes(static_cast<double>(machine_bytes())));
}

nlohmann::ordered_json machine_json() {
  return {{"cpu", cpu_model()}, {"cores", thread_count(0)}, {"memory_bytes", machine_bytes()}};
}

void restart_peak_memory() {
  give_freed_pages_back();  // what earlier runs have freed is no part of this one's peak
  std::ofstream("/proc/self/clear_refs") << "5";
  PagePool::watch_idle_bytes();
}

void touch_memory(std::size_t bytes, MemoryTouch& so_far, const Execution& execution) {
  constexpr std::size_t least = std::size_t{64} << 20;
  if (execution.deadline != nullptr) {
    const std::size_t limit = execution.deadline->memory_bytes();
    const std::size_t held = resident_bytes();
    bytes = std::min(bytes, limit > held ? limit - held : 0);
  }
  if (bytes < least || bytes <= so_far.bytes) return;
  const double first_s = touch_once(bytes, execution);
  const double again_s = touch_once(bytes, execution);
  // The part that an earlier call touched was warm in the first pass too: what the colds cost more is added up.
  const double earlier_excess_s = so_far.cold_s - so_far.warm_s;
  so_far = {.bytes = bytes, .cold_s = again_s + std::max(0.0, first_s - again_s) + earlier_excess_s, .warm_s = again_s};
}

RunCounts operator-(const RunCounts& after, const RunCounts& before) {
  RunCounts between{after.cpu_s - before.cpu_s, after.page_faults - before.page_faults,
                    after.involuntary_switches - before.involuntary_switches, after.hardware};
  for (std::size_t i = 0; i < std::min(before.hardware.size(), between.hardware.size()); ++i) {
    // An event that had no counter at first has counted nothing then.
    if (between.hardware[i]) *between.hardware[i] -= before.hardware[i].value_or(0.0);
  }
  return between;
}

std::optional<double> RunCounts::hardware_count(std::string_view name) const {
  const auto at = static_cast<std::size_t>(std::ranges::find(hardware_names, name) - hardware_names.begin());
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
  if (std::ranges::all_of(files_, [](int file) { return file < 0; })) refusal_ = std::generic_category().message(error);
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

double arithmetic_per_second(const Execution& execution) {
  Execution own = execution.quiet();
  own.trace = nullptr;
  std::vector<double> done(probe_parts);
  const auto run = [&](Range r) {
    const auto begin = std::chrono::steady_clock::now();
    run_part(r.first);
    done[r.first] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for_chunks(probe_parts / 8, 1, own, run);  // wakes threads that sleep
  for_chunks(probe_parts, 1, own, run);
  const double seconds = std::accumulate(done.begin(), done.end(), 0.0);
  const auto threads = static_cast<double>(std::min<std::size_t>(thread_count(own.threads), probe_parts));
  return threads * static_cast<double>(probe_parts * rounds) / seconds;
}

}  // namespace warren::studies
