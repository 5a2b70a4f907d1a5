// SPDX-License-Identifier: BSD-3-Clause
// Eight floats or four doubles side by side, of operations that every processor rounds alike: +, -, *, /, square roots,
// comparisons, selections. What a lane holds never depends on the instruction set. All of it is inlined by force, so
// that it becomes code of the instruction set of the function that it ends in; no value of these types passes a real
// call.
#pragma once

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <emmintrin.h>
#endif

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/base/whole.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"  // what is always inlined has no way of passing values that could change

namespace warren::detail {

/// Aligned by hand: without AVX compilers would put them at any 16 bytes, where code for AVX fails.
template <class T>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  using Numbers = float __attribute__((vector_size(32), aligned(32)));
  using Whole = std::int32_t __attribute__((vector_size(32), aligned(32)));
  using Half = float __attribute__((vector_size(16)));
};
template <>
struct LaneTypes<double> {
  using Numbers = double __attribute__((vector_size(32), aligned(32)));
  using Whole = std::int64_t __attribute__((vector_size(32), aligned(32)));
  using Half = double __attribute__((vector_size(16)));
};
template <class T>
using Lanes = typename LaneTypes<T>::Numbers;
/// What comparisons give: all bits of a lane, or none.
template <class T>
using LaneMask = typename LaneTypes<T>::Whole;
template <class T>
inline constexpr unsigned lane_count = 32 / sizeof(T);
template <class T>
inline constexpr unsigned all_lanes = (1U << lane_count<T>)-1U;
/// Unit of rounding: of a sum, a product, a quotient, a root as a part of it.
template <class T>
inline constexpr T unit_rounding = std::numeric_limits<T>::epsilon() / 2;

template <class T>
[[gnu::always_inline]] inline Lanes<T> all_of(T value) {
  return Lanes<T>{} + value;
}
template <class T>
[[gnu::always_inline]] inline Lanes<T> lanes_at(const T* from) {
  Lanes<T> lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class T>
[[gnu::always_inline]] inline Lanes<T> lesser(Lanes<T> a, Lanes<T> b) {
  return a < b ? a : b;
}
template <class T>
[[gnu::always_inline]] inline Lanes<T> greater(Lanes<T> a, Lanes<T> b) {
  return a > b ? a : b;
}
template <class T>
[[gnu::always_inline]] inline Lanes<T> clamped(Lanes<T> a, T most) {
  return lesser<T>(greater<T>(a, all_of<T>(-most)), all_of<T>(most));
}
template <class T>
[[gnu::always_inline]] inline Lanes<T> magnitude(Lanes<T> a) {
  using Whole = LaneMask<T>;
  using Bits = std::remove_reference_t<decltype(Whole{}[0])>;
  return reinterpret_cast<Lanes<T>>(reinterpret_cast<Whole>(a) & std::numeric_limits<Bits>::max());
}

/// A bit a lane.
template <class T>
[[gnu::always_inline]] inline unsigned bits_of(LaneMask<T> mask) {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  if constexpr (sizeof(T) == 4) {
    const auto low = __builtin_shufflevector(mask, mask, 0, 1, 2, 3);
    const auto high = __builtin_shufflevector(mask, mask, 4, 5, 6, 7);
    return as_whole<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(low)) |
                              _mm_movemask_ps(reinterpret_cast<__m128>(high)) << 4);
  } else {
    const auto low = __builtin_shufflevector(mask, mask, 0, 1);
    const auto high = __builtin_shufflevector(mask, mask, 2, 3);
    return as_whole<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(low)) |
                              _mm_movemask_pd(reinterpret_cast<__m128d>(high)) << 2);
  }
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < lane_count<T>; ++i) bits |= (mask[i] != 0 ? 1U : 0U) << i;
  return bits;
#endif
}

template <class T>
[[gnu::always_inline]] inline Lanes<T> root_of(Lanes<T> a) {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  typename LaneTypes<T>::Half low;
  typename LaneTypes<T>::Half high;
  std::memcpy(&low, &a, sizeof low);
  std::memcpy(&high, reinterpret_cast<const char*>(&a) + sizeof low, sizeof high);
  if constexpr (sizeof(T) == 4) {
    low = _mm_sqrt_ps(low);
    high = _mm_sqrt_ps(high);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  } else {
    low = _mm_sqrt_pd(low);
    high = _mm_sqrt_pd(high);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
  }
#else
  for (unsigned i = 0; i < lane_count<T>; ++i) a[i] = std::sqrt(a[i]);
  return a;
#endif
}

/// The least of all lanes, in every lane.
template <class T>
[[gnu::always_inline]] inline Lanes<T> least_lane(Lanes<T> a) {
  if constexpr (sizeof(T) == 4) {
    a = lesser<T>(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
    a = lesser<T>(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
    return lesser<T>(a, __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6));
  } else {
    a = lesser<T>(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
    return lesser<T>(a, __builtin_shufflevector(a, a, 1, 0, 3, 2));
  }
}

/// Sines and cosines of angles up to 1000 turns. Float: the polynomials of Cephes, double: Taylor's up to x^19 and
/// x^18. Errors below 3e-7 and 1.5e-15 (largest_sine_error; arm_certificate_test).
template <class T>
inline constexpr T largest_sine_error = sizeof(T) == 4 ? T(3e-7) : T(1.5e-15);
template <class T>
[[gnu::always_inline]] inline void sines_of(const Lanes<T>& angle, Lanes<T>& sine, Lanes<T>& cosine) {
  constexpr bool is_float = sizeof(T) == 4;
  constexpr T to_whole = is_float ? T(0x1.8p23) : T(0x1.8p52);  // added, rounds to whole numbers, in the lowest bits
  const Lanes<T> shifted = angle * T(0.63661977236758134308) + to_whole;
  const Lanes<T> quarters = shifted - to_whole;
  Lanes<T> x = angle - quarters * (is_float ? T(1.5703125) : T(1.57079632673412561417e+00));
  x = x - quarters * (is_float ? T(4.837512969970703125e-4) : T(6.07710050630396597660e-11));
  x = x - quarters * (is_float ? T(7.549789948768648e-8) : T(2.02226624879595063154e-21));
  const Lanes<T> z = x * x;
  Lanes<T> s;
  Lanes<T> c;
  if constexpr (is_float) {
    s = x + x * z * (z * (z * T(-1.9515295891e-4) + T(8.3321608736e-3)) + T(-1.6666654611e-1));
    c = (z * (z * T(2.443315711809948e-5) + T(-1.388731625493765e-3)) + T(4.166664568298827e-2)) * z * z - T(0.5) * z +
        T(1);
  } else {
    s = all_of<T>(T(-1.0 / 121645100408832000.0));
    c = all_of<T>(T(-1.0 / 6402373705728000.0));
    constexpr double down[] = {355687428096000.0, -1307674368000.0, 6227020800.0, -39916800.0,
                               362880.0,          -5040.0,          120.0,        -6.0};
    constexpr double across[] = {20922789888000.0, -87178291200.0, 479001600.0, -3628800.0,
                                 40320.0,          -720.0,         24.0,        -2.0};
    for (int i = 0; i < 8; ++i) {
      s = s * z + T(1.0 / down[i]);
      c = c * z + T(1.0 / across[i]);
    }
    s = x + x * z * s;
    c = z * c + T(1);
  }
  using Whole = LaneMask<T>;
  constexpr int to_sign = is_float ? 30 : 62;  // from bit 1 to the highest
  const Whole turns = reinterpret_cast<Whole>(shifted);
  const Whole odd = (turns & 1) != 0;
  sine = reinterpret_cast<Lanes<T>>(reinterpret_cast<Whole>(odd ? c : s) ^ ((turns & 2) << to_sign));
  cosine = reinterpret_cast<Lanes<T>>(reinterpret_cast<Whole>(odd ? s : c) ^ (((turns + 1) & 2) << to_sign));
}

/// A vector of space in every lane.
template <class T>
struct alignas(32) Lanes3 {
  Lanes<T> x, y, z;
};
template <class T>
[[gnu::always_inline]] inline Lanes<T> dot_of(const Lanes3<T>& a, const Lanes3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[gnu::always_inline]] inline void subtract(const Lanes3<T>& a, const Lanes3<T>& b, Lanes3<T>& to) {
  to.x = a.x - b.x;
  to.y = a.y - b.y;
  to.z = a.z - b.z;
}
/// a x b + c.
template <class T>
[[gnu::always_inline]] inline void cross_and_add(const Lanes3<T>& a, const Lanes3<T>& b, const Lanes3<T>& c,
                                                 Lanes3<T>& to) {
  to.x = a.y * b.z - a.z * b.y + c.x;
  to.y = a.z * b.x - a.x * b.z + c.y;
  to.z = a.x * b.y - a.y * b.x + c.z;
}

}  // namespace warren::detail
