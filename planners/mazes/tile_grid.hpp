// SPDX-License-Identifier: BSD-3-Clause
// How a lattice of milestones is cut into square tiles. Lattice point (col, row), both from 0, stands at
// (col + 1, row + 1); tile t holds side x side of them, fewer at the right and upper rim. The side is a power of two
// that grows with the number of points: large enough that few milestones lie on a border, small enough that a tile
// stays in the second-level cache and that there are many tiles for the cores.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "planners/graph/roadmap_options.hpp"

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <emmintrin.h>
#endif

namespace warren {

/// A wall as tiles hold it where that is exact: multiples of 1/128 from the middle of the tile. Half the size of a
/// FloatWall, and walls of the same shape at different places differ by a whole number of cells.
struct NarrowWall {
  std::int16_t x1, y1, x2, y2;
};
inline constexpr int narrow_bits = 7;
inline constexpr int narrow_unit = 1 << narrow_bits;  ///< steps between lattice points

struct TileGrid {
  std::uint32_t cols = 0;  ///< of the lattice
  std::uint32_t rows = 0;
  unsigned side_log2 = 6;
  std::uint32_t tile_cols = 0;
  std::uint32_t tile_rows = 0;

  static TileGrid of(LatticeSize lattice) {
    const std::uint64_t points = std::uint64_t{lattice.rows} * lattice.cols;
    const unsigned log2 = points <= (1U << 18) ? 6 : points <= (1U << 22) ? 7 : 8;
    return of(lattice, log2);
  }
  static TileGrid of(LatticeSize lattice, unsigned side_log2) {
    const std::uint32_t side = 1U << side_log2;
    return {lattice.cols, lattice.rows, side_log2, (lattice.cols - 1) / side + 1, (lattice.rows - 1) / side + 1};
  }

  std::uint32_t side() const { return 1U << side_log2; }
  std::size_t count() const { return std::size_t{tile_cols} * tile_rows; }
  std::size_t tile_at(std::uint32_t col, std::uint32_t row) const {
    return std::size_t{row >> side_log2} * tile_cols + (col >> side_log2);
  }
  /// The tile of the lattice point that is nearest to p.
  std::size_t tile_near(Vec2 p) const {
    const auto index = [](double x, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
    };
    return tile_at(index(p.x, cols), index(p.y, rows));
  }
  std::uint32_t first_col(std::size_t tile) const { return static_cast<std::uint32_t>(tile % tile_cols) << side_log2; }
  std::uint32_t first_row(std::size_t tile) const { return static_cast<std::uint32_t>(tile / tile_cols) << side_log2; }
  std::uint32_t width(std::size_t tile) const { return std::min(side(), cols - first_col(tile)); }
  std::uint32_t height(std::size_t tile) const { return std::min(side(), rows - first_row(tile)); }

  /// Where a lattice point stands.
  static Vec2 point(std::int64_t col, std::int64_t row) {
    return {static_cast<double>(col + 1), static_cast<double>(row + 1)};
  }
  /// The area that the tiles cover: half a step around the lattice points.
  Box area() const { return {{0.5, 0.5}, {cols + 0.5, rows + 0.5}}; }

  /// Where narrow walls of a tile count from.
  Vec2 middle_of(std::size_t tile) const { return point(first_col(tile) + side() / 2, first_row(tile) + side() / 2); }

  /// The wall that a tile's narrow wall stands for. Exact.
  Segment segment(std::size_t tile, const NarrowWall& w) const {
    constexpr double unit = 1.0 / narrow_unit;
    const Vec2 middle = middle_of(tile);
    return {{middle.x + w.x1 * unit, middle.y + w.y1 * unit}, {middle.x + w.x2 * unit, middle.y + w.y2 * unit}};
  }
};

}  // namespace warren

// A wall's four coordinates in steps of 1/128, what filing a wall asks of them, all four at once, and its shape. Where
// one instruction of SSE2 does what the compilers find none for, plain code with the same answers stands beside it.
namespace warren::detail {

/// Beyond so many steps coordinates count as not exact: differences of two must fit into 32 bits.
inline constexpr double most_steps = 0x1p29;

/// From the steps of a packed wall to these.
inline constexpr int packed_shift = 5;
static_assert(PackedWall::per_unit << packed_shift == narrow_unit && PackedWall::most + 1 < most_steps / 64);

using Four [[gnu::vector_size(16)]] = float;
using FourSteps [[gnu::vector_size(16)]] = std::int32_t;  // x1 y1 x2 y2
using TwoCorners [[gnu::vector_size(16)]] = long long;    // the same, x in the lower half of each

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

inline WallShape plain_wall_shape(const NarrowWall& w, std::int16_t stride) {
  const int col = std::min(w.x1, w.x2) >> narrow_bits;
  const int row = std::min(w.y1, w.y2) >> narrow_bits;
  const auto part = [](int end, int cell) {
    return std::uint64_t{static_cast<std::uint16_t>(end - cell * narrow_unit)};
  };
  return {part(w.x1, col) | part(w.y1, row) << 16 | part(w.x2, col) << 32 | part(w.y2, row) << 48, col + row * stride};
}

#if defined(__x86_64__) && !defined(WARREN_PLAIN)

inline NarrowWall narrowed(FourSteps steps) {
  const auto both = reinterpret_cast<__m128i>(steps);
  NarrowWall wall;
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&wall), _mm_packs_epi32(both, both));
  return wall;
}

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

inline NarrowWall narrowed(FourSteps steps) {
  const auto narrow = [&](int i) { return static_cast<std::int16_t>(steps[i]); };
  return {narrow(0), narrow(1), narrow(2), narrow(3)};
}

inline std::array<WallShape, 2> wall_shapes(const NarrowWall* walls, bool single, std::int16_t stride) {
  return {plain_wall_shape(walls[0], stride), plain_wall_shape(walls[single ? 0 : 1], stride)};
}

#endif

class WallSteps {
 public:
  template <class T>
  explicit WallSteps(const WallOf<T>& w) {
    using Ends [[gnu::vector_size(4 * sizeof(T))]] = T;
    constexpr T limit = most_steps;
    Ends scaled;
    std::memcpy(&scaled, &w, sizeof scaled);
    scaled = scaled * T{narrow_unit};
    const Ends below = scaled < limit ? scaled : Ends{} + limit;
    steps_ = __builtin_convertvector(below > -limit ? below : Ends{} - limit, FourSteps);
    const auto off = __builtin_convertvector(steps_, Ends) != scaled;
    exact_ = (off[0] | off[1] | off[2] | off[3]) == 0;
    const FourSteps other = __builtin_shufflevector(steps_, steps_, 2, 3, 0, 1);
    low_ = steps_ < other ? steps_ : other;
    high_ = steps_ < other ? other : steps_;
  }
  /// The corners follow from the first end and the length, without a comparison.
  explicit WallSteps(const PackedWall& w) {
    const FourSteps end = lanes(w.raised_end(), 0) - (PackedWall::most + 1);
    const auto length = static_cast<std::uint32_t>(w.length());
    const FourSteps way = lanes(std::uint64_t{length} << (w.is_upright() ? 32 : 0), 0);
    const FourSteps back = way & way >> 31;
    const FourSteps other = end + way;
    steps_ = __builtin_shufflevector(end, other, 0, 1, 4, 5) << packed_shift;
    low_ = (end + back) << packed_shift;
    high_ = (other - back) << packed_shift;
  }

  /// Are all coordinates whole numbers of steps, and not too many? What follows is of use only then.
  bool exact() const { return exact_; }
  /// x1 y1 x2 y2 in steps, rounded; of a packed wall exact.
  Four numbers() const { return __builtin_convertvector(steps_, Four); }
  /// Is the wall at most `longest` steps long along each axis?
  bool is_short(std::int32_t longest) const { return corner(high_ - low_ > longest) == 0; }
  /// Which tiles of 2^log2 steps hold the lower left corner of the wall's box less so many steps, and the upper right
  /// corner and so many steps more?
  TileCorner first(std::int32_t less, int log2) const { return tile((low_ - less) >> log2); }
  TileCorner last(std::int32_t more, int log2) const { return tile((high_ + more) >> log2); }
  /// Relative to (x, y), in steps: x is the lower half of `origin`, y the upper one.
  NarrowWall from(std::uint64_t origin) const { return narrowed(steps_ - lanes(origin, origin)); }

 private:
  static FourSteps lanes(std::uint64_t first, std::uint64_t second) {
    return reinterpret_cast<FourSteps>(TwoCorners{static_cast<long long>(first), static_cast<long long>(second)});
  }
  static long long corner(FourSteps steps) { return reinterpret_cast<TwoCorners>(steps)[0]; }
  static TileCorner tile(FourSteps steps) { return std::bit_cast<TileCorner>(corner(steps)); }

  FourSteps steps_;
  FourSteps low_;   // x y of the lower left corner of the box
  FourSteps high_;  // and of the upper right one; the other halves are as far apart, or not at all
  bool exact_ = true;
};

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
