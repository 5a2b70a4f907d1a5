// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/path_hash.hpp"

#include <fmt/format.h>

#include <bit>

namespace warren {
void PathHash::add(double number) {
  const auto bits = std::bit_cast<std::uint64_t>(number);
  for (unsigned shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ (bits >> shift & 0xffU)) * 0x100000001b3U;
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
