// SPDX-License-Identifier: BSD-3-Clause
// A wall's four coordinates in steps of 1/128, what filing a wall asks of them, and its shape: with SSE2 all four at
// once, else one by one; the same answers. WallSteps and wall_shapes are what this machine has.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "planners/mazes/tile_grid.hpp"

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <emmintrin.h>
#endif

namespace warren::detail {

/// Beyond so many steps coordinates count as not exact: differences of two must fit into 32 bits.
inline constexpr double most_steps = 0x1p29;

/// From the steps of a packed wall to these.
inline constexpr int packed_shift = 5;
static_assert(PackedWall::per_unit << packed_shift == narrow_unit && PackedWall::most + 1 < most_steps / 64);

using Four = float __attribute__((vector_size(16)));

/// Middle of a tile in steps: x in the lower half, y in the upper one.
inline std::uint64_t middle_of(const TileGrid& grid, std::size_t tile) {
  const auto steps = [&](std::uint32_t first) { return (first + grid.side() / 2 + 1) * narrow_unit; };
  return steps(grid.first_col(tile)) | (std::uint64_t{steps(grid.first_row(tile))} << 32);
}

/// A tile's place, or a place before or after the tiles.
struct TileCorner {
  std::int32_t col;
  std::int32_t row;
};

/// A wall relative to its cell, the one that its lower left corner is in: its ends in steps, 16 bits each, and where
/// the cell is in a plane of that stride.
struct WallShape {
  std::uint64_t key;
  std::int32_t place;
};

class PlainWallSteps {
 public:
  template <class T>
  explicit PlainWallSteps(const WallOf<T>& w) {
    constexpr T limit = most_steps;
    const std::array<T, 4> ends{w.x1, w.y1, w.x2, w.y2};
    for (std::size_t i = 0; i < 4; ++i) {
      const T scaled = ends[i] * narrow_unit;
      const T below = scaled < limit ? scaled : limit;
      steps_[i] = static_cast<std::int32_t>(below > -limit ? below : -limit);
      exact_ = exact_ && static_cast<T>(steps_[i]) == scaled;
    }
  }
  explicit PlainWallSteps(const PackedWall& w) {
    const PackedWall::Ends e = w.ends();
    constexpr std::int32_t steps = 1 << packed_shift;
    steps_ = {e.x1 * steps, e.y1 * steps, e.x2 * steps, e.y2 * steps};
  }

  /// Are all coordinates whole numbers of steps, and not too many? What follows is of use only then.
  bool exact() const { return exact_; }
  /// x1 y1 x2 y2 in steps, rounded; of a packed wall exact.
  Four numbers() const {
    const auto number = [this](std::size_t i) { return static_cast<float>(steps_[i]); };
    return Four{number(0), number(1), number(2), number(3)};
  }
  /// Is the wall at most `longest` steps long along each axis?
  bool is_short(std::int32_t longest) const {
    return std::abs(steps_[0] - steps_[2]) <= longest && std::abs(steps_[1] - steps_[3]) <= longest;
  }
  /// Which tiles of 2^log2 steps hold the lower left corner of the wall's box less so many steps, and the upper right
  /// corner and so many steps more?
  TileCorner first(std::int32_t less, int log2) const {
    return {(std::min(steps_[0], steps_[2]) - less) >> log2, (std::min(steps_[1], steps_[3]) - less) >> log2};
  }
  TileCorner last(std::int32_t more, int log2) const {
    return {(std::max(steps_[0], steps_[2]) + more) >> log2, (std::max(steps_[1], steps_[3]) + more) >> log2};
  }
  /// Relative to (x, y), in steps: x is the lower half of `origin`, y the upper one.
  NarrowWall from(std::uint64_t origin) const {
    const auto x = static_cast<std::int32_t>(origin);
    const auto y = static_cast<std::int32_t>(origin >> 32);
    return {narrow(steps_[0] - x), narrow(steps_[1] - y), narrow(steps_[2] - x), narrow(steps_[3] - y)};
  }

 private:
  static std::int16_t narrow(std::int32_t x) {
    return static_cast<std::int16_t>(std::clamp<std::int32_t>(x, std::numeric_limits<std::int16_t>::min(),
                                                              std::numeric_limits<std::int16_t>::max()));
  }

  std::array<std::int32_t, 4> steps_;  // x1 y1 x2 y2
  bool exact_ = true;
};

inline WallShape plain_wall_shape(const NarrowWall& w, std::int16_t stride) {
  const int col = std::min(w.x1, w.x2) >> narrow_bits;
  const int row = std::min(w.y1, w.y2) >> narrow_bits;
  const auto part = [](int end, int cell) {
    return std::uint64_t{static_cast<std::uint16_t>(end - cell * narrow_unit)};
  };
  return {part(w.x1, col) | part(w.y1, row) << 16 | part(w.x2, col) << 32 | part(w.y2, row) << 48, col + row * stride};
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

class WallSteps {
 public:
  /// The corners follow from the first end and the length, without a comparison.
  explicit WallSteps(const PackedWall& w) : exact_(true) {
    const auto lanes = [](std::uint64_t both) { return _mm_cvtsi64_si128(static_cast<long long>(both)); };
    const __m128i end = _mm_sub_epi32(lanes(w.raised_end()), _mm_set1_epi32(PackedWall::most + 1));
    const auto length = static_cast<std::uint32_t>(w.length());
    const __m128i way = lanes(std::uint64_t{length} << (w.is_upright() ? 32 : 0));
    const __m128i back = _mm_and_si128(way, _mm_srai_epi32(way, 31));
    const __m128i other = _mm_add_epi32(end, way);
    steps_ = _mm_slli_epi32(_mm_unpacklo_epi64(end, other), packed_shift);
    low_ = _mm_slli_epi32(_mm_add_epi32(end, back), packed_shift);
    high_ = _mm_slli_epi32(_mm_sub_epi32(other, back), packed_shift);
  }
  explicit WallSteps(const FloatWall& w) {
    const __m128 limit = _mm_set1_ps(most_steps);
    const __m128 scaled = _mm_mul_ps(_mm_loadu_ps(&w.x1), _mm_set1_ps(narrow_unit));
    const __m128 clamped = _mm_max_ps(_mm_min_ps(scaled, limit), _mm_sub_ps(_mm_setzero_ps(), limit));
    steps_ = _mm_cvtps_epi32(clamped);
    exact_ = _mm_movemask_ps(_mm_cmpeq_ps(_mm_cvtepi32_ps(steps_), scaled)) == 15;
    find_corners();
  }
  explicit WallSteps(const DoubleWall& w) {
    const __m128d limit = _mm_set1_pd(most_steps);
    const auto half = [&](const double* at, int& whole) {
      const __m128d scaled = _mm_mul_pd(_mm_loadu_pd(at), _mm_set1_pd(narrow_unit));
      const __m128d clamped = _mm_max_pd(_mm_min_pd(scaled, limit), _mm_sub_pd(_mm_setzero_pd(), limit));
      const __m128i steps = _mm_cvtpd_epi32(clamped);
      whole += _mm_movemask_pd(_mm_cmpeq_pd(_mm_cvtepi32_pd(steps), scaled));
      return steps;
    };
    int whole = 0;
    const __m128i low = half(&w.x1, whole);
    const __m128i high = half(&w.x2, whole);
    steps_ = _mm_unpacklo_epi64(low, high);
    exact_ = whole == 6;
    find_corners();
  }

  bool exact() const { return exact_; }
  Four numbers() const { return _mm_cvtepi32_ps(steps_); }
  bool is_short(std::int32_t longest) const {
    return _mm_movemask_epi8(_mm_cmpgt_epi32(_mm_sub_epi32(high_, low_), _mm_set1_epi32(longest))) == 0;
  }
  TileCorner first(std::int32_t less, int log2) const { return tile(_mm_sub_epi32(low_, _mm_set1_epi32(less)), log2); }
  TileCorner last(std::int32_t more, int log2) const { return tile(_mm_add_epi32(high_, _mm_set1_epi32(more)), log2); }
  NarrowWall from(std::uint64_t origin) const {
    const __m128i local = _mm_sub_epi32(steps_, _mm_set1_epi64x(static_cast<long long>(origin)));
    NarrowWall wall;
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&wall), _mm_packs_epi32(local, local));
    return wall;
  }

 private:
  void find_corners() {
    const __m128i swapped = _mm_shuffle_epi32(steps_, 0x4E);
    const __m128i greater = _mm_cmpgt_epi32(steps_, swapped);
    low_ = _mm_or_si128(_mm_and_si128(greater, swapped), _mm_andnot_si128(greater, steps_));
    high_ = _mm_or_si128(_mm_and_si128(greater, steps_), _mm_andnot_si128(greater, swapped));
  }
  static TileCorner tile(__m128i steps, int log2) {
    const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_sra_epi32(steps, _mm_cvtsi32_si128(log2))));
    return {static_cast<std::int32_t>(both), static_cast<std::int32_t>(both >> 32)};
  }

  __m128i steps_;
  __m128i low_;   // x y of the lower left corner of the box
  __m128i high_;  // and of the upper right one; the other halves are as far apart, or not at all
  bool exact_;
};

/// Of two walls; of one twice where it is the last one.
inline std::array<WallShape, 2> wall_shapes(const NarrowWall* walls, bool single, std::int16_t stride) {
  const __m128i to_place = _mm_set_epi16(0, 0, stride, 1, 0, 0, stride, 1);
  const auto* at = reinterpret_cast<const __m128i*>(walls);
  const __m128i ends = single ? _mm_unpacklo_epi64(_mm_loadl_epi64(at), _mm_loadl_epi64(at)) : _mm_loadu_si128(at);
  const __m128i cell = _mm_srai_epi16(_mm_min_epi16(ends, _mm_shuffle_epi32(ends, 0xB1)), narrow_bits);
  const __m128i key = _mm_sub_epi16(ends, _mm_slli_epi16(cell, narrow_bits));
  const __m128i place = _mm_madd_epi16(cell, to_place);
  const auto shape = [](__m128i k, __m128i p) {
    return WallShape{static_cast<std::uint64_t>(_mm_cvtsi128_si64(k)), _mm_cvtsi128_si32(p)};
  };
  return {shape(key, place), shape(_mm_unpackhi_epi64(key, key), _mm_unpackhi_epi64(place, place))};
}

#else

using WallSteps = PlainWallSteps;

inline std::array<WallShape, 2> wall_shapes(const NarrowWall* walls, bool single, std::int16_t stride) {
  return {plain_wall_shape(walls[0], stride), plain_wall_shape(walls[single ? 0 : 1], stride)};
}

#endif

}  // namespace warren::detail

namespace warren {

/// The box of all walls, found while they are gone through for another reason: four coordinates at once.
class GrowingBox {
 public:
  void include(const PackedWall& w) { include(detail::WallSteps(w).numbers() * (1.0F / narrow_unit)); }
  void include(const FloatWall& w) {
    detail::Four ends;
    std::memcpy(&ends, &w, sizeof ends);
    include(ends);
  }
  void include(const DoubleWall& w) { doubles_.include(box_of(w.segment())); }
  Box box() const {
    Box box = doubles_;
    box.include({{std::min(low_[0], low_[2]), std::min(low_[1], low_[3])},
                 {std::max(high_[0], high_[2]), std::max(high_[1], high_[3])}});
    return box;
  }

 private:
  void include(detail::Four ends) {
    low_ = low_ < ends ? low_ : ends;
    high_ = high_ > ends ? high_ : ends;
  }

  detail::Four low_ = detail::Four{} + std::numeric_limits<float>::infinity();
  detail::Four high_ = detail::Four{} - std::numeric_limits<float>::infinity();
  Box doubles_;
};

}  // namespace warren
