// SPDX-License-Identifier: BSD-3-Clause
// What tests ask of a build with sanitizers: fewer seeds, and no small memory.
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

/// Does a process hold what warren asks for, and nothing else? Sanitizers hold more than a small limit.
constexpr bool memory_is_ours() {
#ifdef WARREN_FEWER_SEEDS
  return false;
#else
  return true;
#endif
}

}  // namespace warren::test
