// SPDX-License-Identifier: BSD-3-Clause
// How many seeds the longest tests take.
#pragma once

#include <cstdint>

namespace warren::test {

/// All of them, or with sanitizers, where the code is ten times slower, a quarter: what they look for lies in the code
/// that runs, and it runs with the first seeds.
constexpr std::uint64_t seeds(std::uint64_t all) {
#ifdef WARREN_FEWER_SEEDS
  return (all + 3) / 4;
#else
  return all;
#endif
}

}  // namespace warren::test
