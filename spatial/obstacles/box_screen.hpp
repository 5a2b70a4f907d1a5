// SPDX-License-Identifier: BSD-3-Clause
// Does a wall's box meet a query's box? The question that nine of ten walls near a motion fail, asked of all four
// coordinates at once and with one branch (keeps_clearance in bench/wall_index_bench.cpp). Exact for walls in double;
// for walls in float the query's box is rounded outward once, so that no wall is missed.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"

namespace warren {

namespace detail {
/// Four coordinates as one vector of the compiler's own kind (g++ and clang++ have them for every machine), what its
/// comparisons give, and the same bits as words of 64.
template <class T>
struct FourOf;
template <>
struct FourOf<float> {
  using Ends = float __attribute__((vector_size(16)));
  using Flags = int __attribute__((vector_size(16)));
  using Words = long long __attribute__((vector_size(16)));
};
template <>
struct FourOf<double> {
  using Ends = double __attribute__((vector_size(32)));
  using Flags = long long __attribute__((vector_size(32)));
  using Words = Flags;
};
}  // namespace detail

template <class T>
class BoxScreen {
 public:
  using Four = typename detail::FourOf<T>::Ends;
  using FourDoubles = typename detail::FourOf<double>::Ends;

  explicit BoxScreen(const Box& box) {
    Four corners{};
    outward(FourDoubles{box.min.x, box.min.y, box.max.x, box.max.y}, Four{-1, -1, 1, 1}, corners);
    low_ = Four{corners[0], corners[1], corners[0], corners[1]};
    high_ = Four{corners[2], corners[3], corners[2], corners[3]};
  }

  /// Four coordinates in T, moved down where the direction is -1 and up where it is 1: by less than two units in the
  /// last place and half a one of the smallest numbers, from wherever rounding, or the end of the range, had put them.
  static void outward(const FourDoubles& given, const Four& directions, Four& moved) noexcept {
    if constexpr (std::is_same_v<T, double>) {
      moved = given;
    } else {
      constexpr T largest = std::numeric_limits<T>::max();
      Four near = __builtin_convertvector(given, Four);
      near = near > largest ? Four{} + largest : near;
      near = near < -largest ? Four{} - largest : near;
      const Four sizes = near < 0 ? -near : near;
      moved = near + directions * (sizes * std::numeric_limits<T>::epsilon() + std::numeric_limits<T>::min());
    }
  }

  bool meets(const WallOf<T>& wall) const noexcept {
    Four ends;
    std::memcpy(&ends, &wall, sizeof ends);
    const Flags left = ends < low_;  // -1 where it holds: both ends left of, or both below, the box
    const Flags right = ends > high_;
    return (both(left) | both(right)) == 0;
  }

 private:
  using Flags = typename detail::FourOf<T>::Flags;
  using Words = typename detail::FourOf<T>::Words;

  /// Nonzero where the flags of x, or those of y, are set for both ends.
  static long long both(const Flags& flags) noexcept {
    const auto words = reinterpret_cast<Words>(flags);
    if constexpr (std::is_same_v<T, float>) {
      return words[0] & words[1];
    } else {
      return (words[0] & words[2]) | (words[1] & words[3]);
    }
  }
  Four low_;
  Four high_;
};

}  // namespace warren
