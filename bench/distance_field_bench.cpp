// SPDX-License-Identifier: BSD-3-Clause
// The exact distance transform in CPU time a cell, beside memory bandwidth: the same bytes copied once. Maps with
// few, some and many blocked cells, since the rows' envelopes have as many pieces as there are columns that count.
#include <benchmark/benchmark.h>

#include <cstring>
#include <stdexcept>

#include "core/base/rng.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {
namespace {

Bitmap noise(std::uint32_t side, double share) {
  Bitmap map(side, side);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      if (uniform(1, x, y) < share) map.set(x, y);
    }
  }
  return map;
}

/// A cell's value against brute force at a few places.
void check(const Bitmap& map, const DistanceField& field) {
  for (std::uint64_t i = 0; i < 5; ++i) {
    const auto x = static_cast<std::int64_t>(random_bits(2, i, 0) % map.width());
    const auto y = static_cast<std::int64_t>(random_bits(2, i, 1) % map.height());
    std::int64_t best = DistanceField::far;
    for (std::int64_t v = 0; v < map.height(); ++v) {
      for (std::int64_t u = 0; u < map.width(); ++u) {
        if (map.holds(u, v)) best = std::min(best, (x - u) * (x - u) + (y - v) * (y - v));
      }
    }
    if (best != field.squared(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))) {
      throw std::logic_error("the distance transform is wrong");
    }
  }
}

/// range(0): cells a side; range(1): blocked cells in 1000; range(2): threads.
void distance_field(benchmark::State& state) {
  const auto side = static_cast<std::uint32_t>(state.range(0));
  const Bitmap map = noise(side, static_cast<double>(state.range(1)) / 1000.0);
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  check(map, DistanceField(map, CellDistance::centres, false, execution));
  for (auto _ : state) {
    benchmark::DoNotOptimize(DistanceField(map, CellDistance::centres, false, execution));
  }
  state.counters["a_cell"] = benchmark::Counter(
      static_cast<double>(map.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(distance_field)
    ->ArgsProduct({{1000, 4000}, {1, 50, 400}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// Memory bandwidth: 4 bytes a cell, read and written once.
void copy_as_many_bytes(benchmark::State& state) {
  const auto cells = static_cast<std::size_t>(state.range(0) * state.range(0));
  const RawVector<std::uint32_t> from(cells, 1);
  RawVector<std::uint32_t> to(cells, 0);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), cells * sizeof(std::uint32_t));
    benchmark::ClobberMemory();
  }
  state.counters["a_cell"] = benchmark::Counter(
      static_cast<double>(cells), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(copy_as_many_bytes)->Arg(1000)->Arg(4000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren
