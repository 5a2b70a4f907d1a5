// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/path_hash.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace warren {
namespace {

constexpr std::array<std::uint64_t, 9> powers_of(std::uint64_t factor) {
  std::array<std::uint64_t, 9> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * factor;
  return powers;
}

}  // namespace

/// A byte of zeros changes nothing but for the factor, and coordinates of cells begin with some.
void PathHash::add(double number) {
  constexpr auto powers = powers_of(0x100000001b3U);
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const auto zeros = static_cast<unsigned>(std::countr_zero(bits)) / 8;
  hash_ *= powers[zeros];
  for (unsigned shift = 8 * zeros; shift < 64; shift += 8) hash_ = (hash_ ^ (bits >> shift & 0xffU)) * powers[1];
}

std::string PathHash::text() const { return fmt::format("{:016x}", hash_); }

std::string path_hash(const Answer& answer, const Execution& execution) {
  constexpr std::size_t states_a_poll = 1U << 16U;
  PathHash hash;
  const std::size_t count = answer.states.empty() ? answer.path.size() : answer.states.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i % states_a_poll == 0) execution.check();
    if (answer.states.empty()) {
      hash.add(answer.path[i].x);
      hash.add(answer.path[i].y);
    } else {
      for (std::size_t k = 0; k < answer.states.width; ++k) hash.add(answer.states[i][k]);
    }
  }
  return hash.text();
}

}  // namespace warren
