// SPDX-License-Identifier: BSD-3-Clause
// Which of some points, up to 64, lie in a disc, as bits: with SSE2 two at a time, else one by one; the same bits.
#pragma once

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <emmintrin.h>
#endif

#include <cstdint>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren::detail {

/// Bit i is set where the squared distance from p to (x[i], y[i]) is at most `square`. There are 1 to 64 points; where
/// their number is odd, one more may be read.
inline std::uint64_t near_bits_plain(const double* x, const double* y, std::uint32_t count, Vec2 p, double square) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double dx = x[i] - p.x;
    const double dy = y[i] - p.y;
    bits |= as_whole<std::uint64_t>(dx * dx + dy * dy <= square) << i;
  }
  return bits;
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

inline std::uint64_t near_bits(const double* x, const double* y, std::uint32_t count, Vec2 p, double square) {
  const __m128d px = _mm_set1_pd(p.x);
  const __m128d py = _mm_set1_pd(p.y);
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; i += 2) {
    const __m128d dx = _mm_sub_pd(_mm_loadu_pd(x + i), px);
    const __m128d dy = _mm_sub_pd(_mm_loadu_pd(y + i), py);
    const __m128d sum = _mm_add_pd(_mm_mul_pd(dx, dx), _mm_mul_pd(dy, dy));
    const int near = _mm_movemask_pd(_mm_cmple_pd(sum, _mm_set1_pd(square)));
    bits |= as_whole<std::uint64_t>(near) << i;
  }
  return bits & (~std::uint64_t{0} >> (64 - count));
}

#else

inline std::uint64_t near_bits(const double* x, const double* y, std::uint32_t count, Vec2 p, double square) {
  return near_bits_plain(x, y, count, p, square);
}

#endif

}  // namespace warren::detail
