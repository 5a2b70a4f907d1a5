// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/relaxable_bits.hpp"

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <immintrin.h>
#endif

#include <cmath>

#include "core/base/whole.hpp"

namespace warren::detail {
namespace {

std::uint64_t relaxable_baseline(const Vec2* points, const double* labels, std::uint32_t count,
                                 const Relaxation& by) noexcept {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 off = points[i] - by.p;
    const double sum = off.x * off.x + off.y * off.y;
    const bool is_near = as_whole<int>(sum <= by.square) & as_whole<int>(by.through < labels[i]);
    if (is_near && by.through + std::sqrt(sum) < labels[i]) bits |= std::uint64_t{1} << i;
  }
  return bits;
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

/// The first `count` of four lanes.
[[gnu::target("avx2")]] __m256i first_lanes(std::uint32_t count) noexcept {
  return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3));
}

[[gnu::target("avx2")]] std::uint64_t relaxable_avx2(const Vec2* points, const double* labels, std::uint32_t count,
                                                     const Relaxation& by) noexcept {
  const __m256d px = _mm256_set1_pd(by.p.x);
  const __m256d py = _mm256_set1_pd(by.p.y);
  const __m256d through = _mm256_set1_pd(by.through);
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; i += 4) {
    const std::uint32_t left = count - i;
    const double* xy = &points[i].x;
    const __m256d a = _mm256_maskload_pd(xy, first_lanes(2 * left));
    const __m256d b = left > 2 ? _mm256_maskload_pd(xy + 4, first_lanes(2 * left - 4)) : _mm256_setzero_pd();
    // Points 0, 2, 1, 3; so are the labels.
    const __m256d dx = _mm256_sub_pd(_mm256_unpacklo_pd(a, b), px);
    const __m256d dy = _mm256_sub_pd(_mm256_unpackhi_pd(a, b), py);
    const __m256d label = _mm256_permute4x64_pd(_mm256_maskload_pd(labels + i, first_lanes(left)), 0b11011000);
    const __m256d sum = _mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy));
    const __m256d maybe = _mm256_and_pd(_mm256_cmp_pd(sum, _mm256_set1_pd(by.square), _CMP_LE_OQ),
                                        _mm256_cmp_pd(through, label, _CMP_LT_OQ));
    if (_mm256_movemask_pd(maybe) == 0) continue;
    const __m256d sooner = _mm256_cmp_pd(_mm256_add_pd(through, _mm256_sqrt_pd(sum)), label, _CMP_LT_OQ);
    const int lanes = _mm256_movemask_pd(_mm256_permute4x64_pd(_mm256_and_pd(maybe, sooner), 0b11011000));
    bits |= as_whole<std::uint64_t>(lanes) << i;
  }
  return bits;
}

[[gnu::target("avx512f")]] std::uint64_t relaxable_avx512(const Vec2* points, const double* labels, std::uint32_t count,
                                                          const Relaxation& by) noexcept {
  const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
  const __m512i odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
  const __m512d through = _mm512_set1_pd(by.through);
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; i += 8) {
    const std::uint32_t left = count - i < 8 ? count - i : 8;
    const std::uint32_t numbers = (1U << 2 * left) - 1;
    const double* xy = &points[i].x;
    const __m512d a = _mm512_maskz_loadu_pd(as_whole<__mmask8>(numbers), xy);
    const __m512d b = _mm512_maskz_loadu_pd(as_whole<__mmask8>(numbers >> 8), xy + 8);
    const auto lanes = as_whole<__mmask8>((1U << left) - 1);
    const __m512d label = _mm512_maskz_loadu_pd(lanes, labels + i);
    const __m512d dx = _mm512_sub_pd(_mm512_permutex2var_pd(a, even, b), _mm512_set1_pd(by.p.x));
    const __m512d dy = _mm512_sub_pd(_mm512_permutex2var_pd(a, odd, b), _mm512_set1_pd(by.p.y));
    const __m512d sum = _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy));
    __mmask8 found = _mm512_mask_cmp_pd_mask(lanes, sum, _mm512_set1_pd(by.square), _CMP_LE_OQ);
    found = _mm512_mask_cmp_pd_mask(found, through, label, _CMP_LT_OQ);
    if (found == 0) continue;
    found = _mm512_mask_cmp_pd_mask(found, _mm512_add_pd(through, _mm512_maskz_sqrt_pd(found, sum)), label, _CMP_LT_OQ);
    bits |= std::uint64_t{found} << i;
  }
  return bits;
}

#endif

}  // namespace

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

std::uint64_t relaxable_bits(const Vec2* points, const double* labels, std::uint32_t count, const Relaxation& by,
                             InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::baseline:
      return relaxable_baseline(points, labels, count, by);
    case InstructionSet::avx2:
      return relaxable_avx2(points, labels, count, by);
    case InstructionSet::avx512:
      return relaxable_avx512(points, labels, count, by);
  }
  return 0;
}

#else

std::uint64_t relaxable_bits(const Vec2* points, const double* labels, std::uint32_t count, const Relaxation& by,
                             InstructionSet /*set*/) noexcept {
  return relaxable_baseline(points, labels, count, by);
}

#endif

}  // namespace warren::detail
