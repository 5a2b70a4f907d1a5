// SPDX-License-Identifier: BSD-3-Clause
// Casts to whole numbers, the only ones in spatial/, worlds/ and verify/ (check_layers.cmake says so): a double becomes
// one by bounded_whole alone, which has an answer for every double; a plain cast is undefined beyond its type.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace warren {

/// A whole number, or the number of an enumerator, as another type of whole numbers. Doubles don't compile.
template <std::integral Whole, class From>
requires std::integral<From> || std::is_enum_v<From>
[[gnu::always_inline]] constexpr Whole as_whole(From number) noexcept { return static_cast<Whole>(number); }

/// The largest number that all doubles up to it tell from the next one: the type's, or 2^53.
template <std::integral Whole>
inline constexpr double most_whole = std::numeric_limits<Whole>::digits < 53
                                         ? static_cast<double>(std::numeric_limits<Whole>::max())
                                         : 0x1p53;
/// Its negative, or 0.
template <std::integral Whole>
inline constexpr double least_whole = std::is_signed_v<Whole> ? -most_whole<Whole> : 0.0;

/// The double without its fraction, or the end that it lies beyond; `least` for NaN. The ends are numbers of the type.
/// One instruction after two for the ends; in lanes, too, where the type is int32.
template <std::integral Whole>
[[gnu::always_inline]] constexpr Whole bounded_whole(double x, double least = least_whole<Whole>,
                                                     double most = most_whole<Whole>) noexcept {
  using Direct = std::conditional_t<(std::numeric_limits<Whole>::digits < 32), std::int32_t, std::int64_t>;
  const double above = least < x ? x : least;
  return static_cast<Whole>(static_cast<Direct>(above < most ? above : most));
}

}  // namespace warren
