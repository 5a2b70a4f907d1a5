// SPDX-License-Identifier: BSD-3-Clause
// What every benchmark says in the same words: items a second and bytes an item; and the check that comes before the
// clock.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/run/execution.hpp"

namespace warren::bench {

inline const Execution one_thread{.threads = 1};

/// `items` were worked on in each iteration; `bytes` are held, read or written for all of them together.
inline void report(benchmark::State& state, std::size_t items, std::size_t bytes) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(items));
  state.counters["bytes/item"] = static_cast<double>(bytes) / static_cast<double>(items);
}

/// Ends the program where a result is not the plain version's: then its time means nothing.
inline void check(bool same, const char* what) {
  if (same) return;
  std::fprintf(stderr, "warren_bench: %s: not what the plain version gives\n", what);
  std::abort();
}

/// A benchmark is called several times until its iterations are known: this is the first call, of one iteration.
inline bool is_first_call(const benchmark::State& state) { return state.max_iterations == 1; }

/// The first call checks, unless another run of the same program has done so (bench/rounds.py says it).
inline bool should_check(const benchmark::State& state) {
  static const bool is_checked = std::getenv("WARREN_BENCH_CHECKED") != nullptr;
  return is_first_call(state) && !is_checked;
}

/// Benchmarks over threads count the CPU time of all of them, and the clock's time.
inline void over_threads(benchmark::internal::Benchmark* bench) {
  bench->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
}

}  // namespace warren::bench
