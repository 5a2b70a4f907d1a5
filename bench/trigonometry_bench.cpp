// SPDX-License-Identifier: BSD-3-Clause
// The functions whose bits are the same everywhere, each beside the C library's, for random angles within a turn or
// two.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/trigonometry.hpp"

namespace {

using namespace warren;

template <class Function>
void run_function(benchmark::State& state, double largest, const Function& function) {
  constexpr std::size_t count = 4096;
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < count; ++i) numbers.push_back(largest * (2.0 * uniform(1, i, 0) - 1.0));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(function(numbers[i % count], numbers[(i + 1) % count]));
    ++i;
  }
}

void bm_sine_and_cosine(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) {
    const auto [sine, cosine] = portable::sin_and_cos(x);
    return sine + cosine;
  });
}
BENCHMARK(bm_sine_and_cosine);
void bm_library_sine_and_cosine(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) { return std::sin(x) + std::cos(x); });
}
BENCHMARK(bm_library_sine_and_cosine);

void bm_sine(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) { return portable::sin(x); });
}
BENCHMARK(bm_sine);
void bm_library_sine(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) { return std::sin(x); });
}
BENCHMARK(bm_library_sine);

void bm_atan2(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double y) { return portable::atan2(y, x); });
}
BENCHMARK(bm_atan2);
void bm_library_atan2(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double y) { return std::atan2(y, x); });
}
BENCHMARK(bm_library_atan2);

void bm_acos(benchmark::State& state) {
  run_function(state, 1.0, [](double x, double) { return portable::acos(x); });
}
BENCHMARK(bm_acos);
void bm_library_acos(benchmark::State& state) {
  run_function(state, 1.0, [](double x, double) { return std::acos(x); });
}
BENCHMARK(bm_library_acos);

void bm_hypot(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double y) { return portable::hypot(x, y); });
}
BENCHMARK(bm_hypot);
void bm_library_hypot(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double y) { return std::hypot(x, y); });
}
BENCHMARK(bm_library_hypot);

void bm_log(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) { return portable::log(x * x); });
}
BENCHMARK(bm_log);
void bm_library_log(benchmark::State& state) {
  run_function(state, 7.0, [](double x, double) { return std::log(x * x); });
}
BENCHMARK(bm_library_log);

}  // namespace
