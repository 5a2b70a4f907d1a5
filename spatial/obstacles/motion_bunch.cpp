// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/motion_bunch.hpp"

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <immintrin.h>
#endif

#include <algorithm>

namespace warren::detail {
namespace {

/// Vectors of numbers, and of what comparing them gives, for machines with registers of so many bytes.
template <class T, std::size_t bytes>
struct LanesOf;
template <>
struct LanesOf<float, 16> {
  using Numbers = float __attribute__((vector_size(16)));
  using Indices = std::int32_t __attribute__((vector_size(16)));
};
template <>
struct LanesOf<float, 32> {
  using Numbers = float __attribute__((vector_size(32)));
  using Indices = std::int32_t __attribute__((vector_size(32)));
};
template <>
struct LanesOf<double, 16> {
  using Numbers = double __attribute__((vector_size(16)));
  using Indices = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct LanesOf<double, 32> {
  using Numbers = double __attribute__((vector_size(32)));
  using Indices = std::int64_t __attribute__((vector_size(32)));
};

/// A wall's box.
template <class T>
struct Ends {
  T low_x, low_y, high_x, high_y;
};
template <class T>
Ends<T> ends_of(const WallOf<T>& wall) {
  return {std::min(wall.x1, wall.x2), std::min(wall.y1, wall.y2), std::max(wall.x1, wall.x2),
          std::max(wall.y1, wall.y2)};
}

}  // namespace

template <class T>
template <std::size_t bytes>
[[gnu::always_inline]] inline void MotionBunch<T>::sift_with(std::span<const WallOf<T>> walls) noexcept {
  using Lanes = typename LanesOf<T, bytes>::Numbers;
  using IndexLanes = typename LanesOf<T, bytes>::Indices;
  constexpr std::size_t width = sizeof(Lanes) / sizeof(T);
  for (std::size_t lane = 0; lane < most; lane += width) {
    Lanes left;
    Lanes bottom;
    Lanes right;
    Lanes top;
    std::memcpy(&left, &left_[lane], sizeof left);
    std::memcpy(&bottom, &bottom_[lane], sizeof bottom);
    std::memcpy(&right, &right_[lane], sizeof right);
    std::memcpy(&top, &top_[lane], sizeof top);
    IndexLanes count{};
    IndexLanes first{};
    IndexLanes last{};
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const auto [low_x, low_y, high_x, high_y] = ends_of(walls[i]);
      const IndexLanes meets = (Lanes{} + high_x >= left) & (Lanes{} + low_x <= right) & (Lanes{} + high_y >= bottom) &
                               (Lanes{} + low_y <= top);
      const IndexLanes index = IndexLanes{} + as_whole<Index>(i);
      last = (index & meets) | (last & ~meets);
      first |= index & meets & (count == 0);
      count -= meets;
    }
    std::memcpy(&count_[lane], &count, sizeof count);
    std::memcpy(&first_[lane], &first, sizeof first);
    std::memcpy(&last_[lane], &last, sizeof last);
  }
}

template <class T>
void MotionBunch<T>::sift_baseline(std::span<const WallOf<T>> walls) noexcept {
  sift_with<16>(walls);
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

template <class T>
[[gnu::target("avx2")]] void MotionBunch<T>::sift_avx2(std::span<const WallOf<T>> walls) noexcept {
  sift_with<32>(walls);
}

// By the machine's own functions: its comparisons give bits, not lanes, which the compilers' vectors can't say well.
template <>
[[gnu::target("avx512f")]] void MotionBunch<float>::sift_avx512(std::span<const WallOf<float>> walls) noexcept {
  const __m512 left = _mm512_load_ps(left_.data());
  const __m512 bottom = _mm512_load_ps(bottom_.data());
  const __m512 right = _mm512_load_ps(right_.data());
  const __m512 top = _mm512_load_ps(top_.data());
  __m512i count = _mm512_setzero_si512();
  __m512i first = _mm512_setzero_si512();
  __m512i last = _mm512_setzero_si512();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto [low_x, low_y, high_x, high_y] = ends_of(walls[i]);
    __mmask16 meets = _mm512_cmp_ps_mask(_mm512_set1_ps(high_x), left, _CMP_GE_OQ);
    meets = _mm512_mask_cmp_ps_mask(meets, _mm512_set1_ps(low_x), right, _CMP_LE_OQ);
    meets = _mm512_mask_cmp_ps_mask(meets, _mm512_set1_ps(high_y), bottom, _CMP_GE_OQ);
    meets = _mm512_mask_cmp_ps_mask(meets, _mm512_set1_ps(low_y), top, _CMP_LE_OQ);
    const __m512i index = _mm512_set1_epi32(as_whole<int>(i));
    last = _mm512_mask_mov_epi32(last, meets, index);
    first = _mm512_mask_mov_epi32(first, _mm512_mask_testn_epi32_mask(meets, count, count), index);
    count = _mm512_mask_add_epi32(count, meets, count, _mm512_set1_epi32(1));
  }
  _mm512_store_si512(count_.data(), count);
  _mm512_store_si512(first_.data(), first);
  _mm512_store_si512(last_.data(), last);
}

template <>
[[gnu::target("avx512f")]] void MotionBunch<double>::sift_avx512(std::span<const WallOf<double>> walls) noexcept {
  for (std::size_t lane = 0; lane < most; lane += 8) {
    const __m512d left = _mm512_load_pd(&left_[lane]);
    const __m512d bottom = _mm512_load_pd(&bottom_[lane]);
    const __m512d right = _mm512_load_pd(&right_[lane]);
    const __m512d top = _mm512_load_pd(&top_[lane]);
    __m512i count = _mm512_setzero_si512();
    __m512i first = _mm512_setzero_si512();
    __m512i last = _mm512_setzero_si512();
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const auto [low_x, low_y, high_x, high_y] = ends_of(walls[i]);
      __mmask8 meets = _mm512_cmp_pd_mask(_mm512_set1_pd(high_x), left, _CMP_GE_OQ);
      meets = _mm512_mask_cmp_pd_mask(meets, _mm512_set1_pd(low_x), right, _CMP_LE_OQ);
      meets = _mm512_mask_cmp_pd_mask(meets, _mm512_set1_pd(high_y), bottom, _CMP_GE_OQ);
      meets = _mm512_mask_cmp_pd_mask(meets, _mm512_set1_pd(low_y), top, _CMP_LE_OQ);
      const __m512i index = _mm512_set1_epi64(as_whole<std::int64_t>(i));
      last = _mm512_mask_mov_epi64(last, meets, index);
      first = _mm512_mask_mov_epi64(first, _mm512_mask_testn_epi64_mask(meets, count, count), index);
      count = _mm512_mask_add_epi64(count, meets, count, _mm512_set1_epi64(1));
    }
    _mm512_store_si512(&count_[lane], count);
    _mm512_store_si512(&first_[lane], first);
    _mm512_store_si512(&last_[lane], last);
  }
}

template <class T>
void MotionBunch<T>::sift(std::span<const WallOf<T>> walls, InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::baseline:
      return sift_baseline(walls);
    case InstructionSet::avx2:
      return sift_avx2(walls);
    case InstructionSet::avx512:
      return sift_avx512(walls);
  }
}

#else

template <class T>
void MotionBunch<T>::sift(std::span<const WallOf<T>> walls, InstructionSet /*set*/) noexcept {
  sift_baseline(walls);
}

#endif

template class MotionBunch<float>;
template class MotionBunch<double>;

}  // namespace warren::detail
