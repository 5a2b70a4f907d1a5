// SPDX-License-Identifier: BSD-3-Clause
// The machine itself, by loops that no change of warren can touch: arithmetic that waits for itself, a chain of reads
// that no cache holds, a stream through memory. Whatever they take longer in one run of the benchmarks than in another
// is the machine's doing: `tools/bench --compare` calls no smaller difference a difference.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"

namespace warren::bench {
namespace {

void bm_machine_arithmetic(benchmark::State& state) {
  constexpr std::size_t steps = 1'000'000;
  std::uint64_t value = 1;
  for (auto _ : state) {
    for (std::size_t i = 0; i < steps; ++i) value = mix64(value);
    benchmark::DoNotOptimize(value);
  }
  report(state, steps, 0);
}
BENCHMARK(bm_machine_arithmetic)->Unit(benchmark::kMillisecond);

/// 64 MiB as one ring that jumps about: the steps of a linear congruential generator of full period.
const std::vector<std::uint32_t>& ring() {
  static const std::vector<std::uint32_t> kept = [] {
    constexpr std::uint32_t size = 1U << 24;
    std::vector<std::uint32_t> next(size);
    for (std::uint32_t i = 0; i < size; ++i) next[i] = (i * 10'644'325U + 12'345U) % size;
    return next;
  }();
  return kept;
}

void bm_machine_latency(benchmark::State& state) {
  constexpr std::size_t steps = 100'000;
  const std::vector<std::uint32_t>& next = ring();
  std::uint32_t at = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < steps; ++i) at = next[at];
    benchmark::DoNotOptimize(at);
  }
  report(state, steps, steps * sizeof(std::uint32_t));
}
BENCHMARK(bm_machine_latency)->Unit(benchmark::kMillisecond);

void bm_machine_stream(benchmark::State& state) {
  const std::vector<std::uint32_t>& words = ring();
  for (auto _ : state) benchmark::DoNotOptimize(std::accumulate(words.begin(), words.end(), std::uint64_t{0}));
  report(state, words.size(), words.size() * sizeof(std::uint32_t));
}
BENCHMARK(bm_machine_stream)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
