// SPDX-License-Identifier: BSD-3-Clause
#include "studies/measure/machine_memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

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

}  // namespace

Machine this_machine() { return {.cpu = cpu_model(), .cores = thread_count(0), .memory_bytes = machine_bytes()}; }

std::string text_of(const Machine& machine) {
  return fmt::format("{}, {} {}, {}", machine.cpu, machine.cores, machine.cores == 1 ? "core" : "cores",
                     human_bytes(static_cast<double>(machine.memory_bytes)));
}

nlohmann::ordered_json machine_json(const Machine& machine) {
  return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"memory_bytes", machine.memory_bytes}};
}

void restart_peak_memory() {
  give_freed_pages_back();  // what earlier runs have freed is no part of this one's peak
  std::ofstream("/proc/self/clear_refs") << "5";
  PagePool::watch_idle_bytes();
}

void WarmMemory::prepare(std::size_t bytes, const Execution& execution) {
  constexpr std::size_t least = std::size_t{64} << 20;
  if (execution.deadline != nullptr) {
    const std::size_t limit = execution.deadline->memory_bytes();
    const std::size_t held = resident_bytes();
    bytes = std::min(bytes, limit > held ? limit - held : 0);
  }
  if (bytes < least || bytes <= touch_.bytes) return;
  const double first_s = touch_once(bytes, execution);
  const double again_s = touch_once(bytes, execution);
  // The part that an earlier call touched was warm in the first pass too: what the colds cost more is added up.
  const double earlier_excess_s = touch_.cold_s - touch_.warm_s;
  touch_ = {.bytes = bytes, .cold_s = again_s + std::max(0.0, first_s - again_s) + earlier_excess_s, .warm_s = again_s};
}

}  // namespace warren::studies
