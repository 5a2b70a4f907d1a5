// SPDX-License-Identifier: BSD-3-Clause
// Up to sixteen motions near each other as boxes side by side, and the walls that may matter to each of them. Every
// wall near the bunch is held against all boxes at once, without a branch; each motion remembers how many walls meet
// its box, and the first and the last of them. Most motions are left with none or one, which the caller puts to the
// exact test. A motion of a roadmap costs 8 to 20 ns this way, 40 to 75 alone (connect in bench/connection_bench.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/wall_set.hpp"
#include "spatial/obstacles/wall_grid.hpp"
#include "spatial/points/disc_points.hpp"

namespace warren::detail {

/// Scratch of one thread. The same answers as one BoxScreen a motion, with any instruction set.
template <class T>
class MotionBunch {
 public:
  static constexpr std::size_t most = 16;
  using Index = std::conditional_t<std::is_same_v<T, float>, std::int32_t, std::int64_t>;

  /// The motions' boxes, each grown by r; at most `most`.
  MotionBunch(std::span<const Segment> motions, double r) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    std::array<double, most> left, bottom, right, top;
    left.fill(nowhere);
    bottom.fill(nowhere);
    right.fill(-nowhere);
    top.fill(-nowhere);
    const Two growth = Two{} + r;
    Two low = Two{} + nowhere;
    Two high = Two{} - nowhere;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      Two from;
      Two to;
      std::memcpy(&from, &motions[i].a, sizeof from);
      std::memcpy(&to, &motions[i].b, sizeof to);
      const Two min = (from < to ? from : to) - growth;
      const Two max = (from > to ? from : to) + growth;
      left[i] = min[0];
      bottom[i] = min[1];
      right[i] = max[0];
      top[i] = max[1];
      low = low < min ? low : min;
      high = high > max ? high : max;
    }
    around_ = {{low[0], low[1]}, {high[0], high[1]}};
    round_outward(left, -1, left_);
    round_outward(bottom, -1, bottom_);
    round_outward(right, 1, right_);
    round_outward(top, 1, top_);
  }

  /// The box of all the motions' boxes.
  const Box& around() const { return around_; }

  /// Holds the walls against all boxes.
  void sift(std::span<const WallOf<T>> walls, InstructionSet set = best_instruction_set()) noexcept;

  /// How many of the walls meet the box of motion i, and which is the first and the last of them.
  std::size_t count(std::size_t i) const { return as_whole<std::size_t>(count_[i]); }
  std::size_t first(std::size_t i) const { return as_whole<std::size_t>(first_[i]); }
  std::size_t last(std::size_t i) const { return as_whole<std::size_t>(last_[i]); }

 private:
  using Ends = std::array<T, most>;
  using Two = double __attribute__((vector_size(16)));

  static void round_outward(const std::array<double, most>& given, T direction, Ends& ends) {
    using Screen = BoxScreen<T>;
    for (std::size_t i = 0; i < most; i += 4) {
      typename Screen::Four rounded{};
      Screen::outward(typename Screen::FourDoubles{given[i], given[i + 1], given[i + 2], given[i + 3]},
                      typename Screen::Four{} + direction, rounded);
      std::memcpy(&ends[i], &rounded, sizeof rounded);
    }
  }

  template <std::size_t bytes>
  void sift_with(std::span<const WallOf<T>> walls) noexcept;
  void sift_baseline(std::span<const WallOf<T>> walls) noexcept;
  void sift_avx2(std::span<const WallOf<T>> walls) noexcept;
  void sift_avx512(std::span<const WallOf<T>> walls) noexcept;

  Box around_;
  alignas(64) Ends left_, bottom_, right_, top_;
  alignas(64) std::array<Index, most> count_, first_, last_;
};

}  // namespace warren::detail
