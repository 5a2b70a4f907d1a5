// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/path_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace warren {
namespace {

constexpr std::uint64_t factor = 0x100000001b3U;

constexpr std::array<std::uint64_t, 7> powers_of_factor() {
  std::array<std::uint64_t, 7> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * factor;
  return powers;
}

}  // namespace

/// A byte of zeros changes nothing but for the factor, and coordinates of cells begin with five, most of them: then no
/// branch depends on the number. Each byte waits for the one before it, so every multiplication that is left out
/// counts.
void PathHash::add(double number) {
  constexpr std::size_t most_zeros = 5;
  constexpr auto powers = powers_of_factor();
  const auto bits = std::bit_cast<std::uint64_t>(number);
  std::size_t byte = std::min<std::size_t>(most_zeros, static_cast<unsigned>(std::countr_zero(bits)) / 8);
  last_ = last_ * powers[byte + 1] ^ (bits >> 8 * byte & 0xffU);
  while (++byte < 8) last_ = last_ * factor ^ (bits >> 8 * byte & 0xffU);
}

std::string PathHash::text() const { return fmt::format("{:016x}", last_ * factor); }

std::string path_hash(const Answer& answer, const Execution& execution) {
  constexpr std::size_t states_a_poll = 1U << 16U;
  PathHash hash;
  for (std::size_t i = 0; i < answer.state_count(); ++i) {
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
