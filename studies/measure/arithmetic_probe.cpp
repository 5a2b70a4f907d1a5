// SPDX-License-Identifier: BSD-3-Clause
#include "studies/measure/arithmetic_probe.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren::studies {
namespace {

constexpr std::size_t probe_parts = 64;
constexpr std::uint64_t rounds = 120'000;  // of each part: some 150 us

/// One number that doesn't wait for the others. Opaque to the compiler, which would put several into one register.
inline void step(std::uint64_t round, std::uint64_t& x) {
  x ^= round;
  x += x;
  asm volatile("" : "+r"(x));
}

/// Numbers enough to keep all units for whole numbers of a core busy.
std::uint64_t run_part(std::uint64_t seed) {
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
  return a ^ b ^ c ^ d ^ e ^ f ^ g ^ h;
}

}  // namespace

double arithmetic_per_second(const Execution& execution) {
  Execution own = execution;
  own.progress = nullptr;
  own.trace = nullptr;
  struct Part {
    std::uint64_t result = 0;
    double seconds = 0.0;
  };
  std::vector<Part> done(probe_parts);
  const auto run = [&](Range r) {
    const auto begin = std::chrono::steady_clock::now();
    const std::uint64_t result = run_part(r.first);
    done[r.first] = {result, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
  };
  for_chunks(probe_parts / 8, 1, own, run);  // wakes threads that sleep
  for_chunks(probe_parts, 1, own, run);
  double seconds = 0.0;
  for (const Part& part : done) seconds += part.seconds;
  const volatile std::uint64_t read = done.back().result;  // or the work would be left out
  static_cast<void>(read);
  const auto threads = static_cast<double>(std::min<std::size_t>(thread_count(own.threads), probe_parts));
  return threads * static_cast<double>(probe_parts * rounds) / seconds;
}

}  // namespace warren::studies
