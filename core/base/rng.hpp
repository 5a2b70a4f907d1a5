// SPDX-License-Identifier: BSD-3-Clause
// Counter-based random numbers: uniform(seed, index, axis) is a pure function, so that any thread may compute any
// sample and no result depends on the order of the calls. Three rounds of the 64-bit finaliser of splitmix64 (Steele,
// Lea, Flood, OOPSLA 2014), one for each argument; about 3 ns a number.
#pragma once

#include <cstdint>

namespace warren {

/// A bijection of 64-bit numbers that scatters neighbouring arguments.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// 64 random bits, a pure function of the arguments.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, std::uint64_t axis = 0) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  const std::uint64_t a = mix64(seed + golden);
  const std::uint64_t b = mix64(a + golden * (index + 1));
  return mix64(b + golden * (axis + 1));
}

/// A number in [0, 1) with 53 random bits, a pure function of the arguments.
constexpr double uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t axis) {
  return static_cast<double>(random_bits(seed, index, axis) >> 11) * 0x1.0p-53;
}

/// A sequential generator (splitmix64) for algorithms that are serial by nature, such as maze generators.
class SequentialRng {
 public:
  explicit constexpr SequentialRng(std::uint64_t seed) : state_(mix64(seed + 0x9e3779b97f4a7c15U)) {}
  constexpr std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    return mix64(state_);
  }
  /// A number in [0, n), n >= 1; bias below n / 2^64 (multiply-shift on 64 bits).
  constexpr std::uint64_t below(std::uint64_t n) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(static_cast<Wide>(next()) * n >> 64);
  }

 private:
  std::uint64_t state_;
};

}  // namespace warren
