// SPDX-License-Identifier: BSD-3-Clause
// Compilers turn the loop into vector code of the instruction set of the function that it is inlined in.
#include "planners/lengths/min_plus.hpp"

namespace warren {
namespace {

[[gnu::always_inline]] inline void lessen(std::uint32_t* __restrict least, const std::uint32_t* __restrict rest,
                                          std::uint32_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t sum = first + rest[i];
    least[i] = sum < least[i] ? sum : least[i];
  }
}

[[gnu::always_inline]] inline void lessen_short(std::uint32_t* __restrict least, const std::uint16_t* __restrict rest,
                                                std::uint32_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t length = rest[i];
    const std::uint32_t sum = length == no_short_way ? no_way : first + length;
    least[i] = sum < least[i] ? sum : least[i];
  }
}

[[gnu::always_inline]] inline void lessen_by(std::uint32_t* __restrict least, std::uint32_t* __restrict by,
                                             const std::uint32_t* __restrict rest, std::uint32_t first,
                                             std::uint32_t gate, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t sum = first + rest[i];
    by[i] = sum < least[i] ? gate : by[i];
    least[i] = sum < least[i] ? sum : least[i];
  }
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
[[gnu::target("avx2")]] void lessen_row_by_avx2(std::uint32_t* least, std::uint32_t* by, const std::uint32_t* rest,
                                                std::uint32_t first, std::uint32_t gate, std::size_t count) {
  lessen_by(least, by, rest, first, gate, count);
}
[[gnu::target("avx2")]] void lessen_row_short_avx2(std::uint32_t* least, const std::uint16_t* rest, std::uint32_t first,
                                                   std::size_t count) {
  lessen_short(least, rest, first, count);
}
[[gnu::target("avx2")]] void lessen_row_avx2(std::uint32_t* least, const std::uint32_t* rest, std::uint32_t first,
                                             std::size_t count) {
  lessen(least, rest, first, count);
}
bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
#else
constexpr auto lessen_row_by_avx2 = lessen_row_by_plain;
constexpr auto lessen_row_short_avx2 = lessen_row_short_plain;
constexpr auto lessen_row_avx2 = lessen_row_plain;
constexpr bool has_avx2() { return false; }
#endif

}  // namespace

void lessen_row_plain(std::uint32_t* least, const std::uint32_t* rest, std::uint32_t first, std::size_t count) {
  lessen(least, rest, first, count);
}

void lessen_row_short_plain(std::uint32_t* least, const std::uint16_t* rest, std::uint32_t first, std::size_t count) {
  lessen_short(least, rest, first, count);
}

void lessen_row_by_plain(std::uint32_t* least, std::uint32_t* by, const std::uint32_t* rest, std::uint32_t first,
                         std::uint32_t gate, std::size_t count) {
  lessen_by(least, by, rest, first, gate, count);
}

LessenRowBy lessen_row_by() { return has_avx2() ? lessen_row_by_avx2 : lessen_row_by_plain; }
LessenRowShort lessen_row_short() { return has_avx2() ? lessen_row_short_avx2 : lessen_row_short_plain; }
LessenRow lessen_row() { return has_avx2() ? lessen_row_avx2 : lessen_row_plain; }

}  // namespace warren
