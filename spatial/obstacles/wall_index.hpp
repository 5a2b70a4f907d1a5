// SPDX-License-Identifier: BSD-3-Clause
// Where the walls are. A uniform grid over any segments: crossing, overlapping, collinear, of length zero, long and
// short, in any order.
//
// Cell size h, chosen from the data: the mean gap between walls (area / total length) or the square root of area a
// wall, whichever is smaller, and the walls' median length where that is near. Each wall is cut into pieces of at most
// h an axis, each piece is filed under the cell of its midpoint, and a query grows its box by half a piece. Bounds,
// for N walls: h is raised until the pieces are at most 5 N + 65536 and the cells at most 2 N + 65536, so long walls in
// a fine grid can't blow up memory; a cell with more than 64 short pieces gets a finer grid of its own, at most
// 16 deep and only where that shrinks them, so short walls in a coarse grid can't blow up time.
//
// Build: two passes of counting sort, first into bands of rows, then within each band in cache; no atomics, the same
// arrays for any thread count. 16 bytes a piece (32 for walls that are not exact in float) and 4 a cell.
// Measured in bench/wall_index_bench.cpp. Lost: one entry in each cell that a wall meets (faster queries by a third,
// twice the memory and three times the build), packed R-tree (queries 10 times slower).
//
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
#include <variant>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/wall_grid.hpp"
#include "spatial/points/disc_points.hpp"

namespace warren {

/// Immutable after construction; any number of threads may query.
class WallIndex {
 public:
  /// Copies what it keeps; `more` are further walls (the bounds). Throws Stopped at the deadline or before memory would
  /// pass its limit, InputError for more than 2^31 walls. O(N).
  WallIndex(const WallSet& walls, std::span<const Segment> more, const Execution& execution);
  WallIndex(const WallSet& walls, const Execution& execution) : WallIndex(walls, {}, execution) {}

  std::size_t wall_count() const { return wall_count_; }
  /// Box of all walls; empty if there are none.
  const Box& box() const { return box_; }
  std::size_t bytes() const;
  /// At most `most` walls, spread evenly over the index; long ones come more often.
  std::vector<Segment> some_walls(std::size_t most) const;

  /// Does the closed segment a-b touch a wall? Exact.
  bool blocks(Vec2 a, Vec2 b) const noexcept;
  /// Distance from p to the nearest wall, or at_most if none is nearer.
  double clearance(Vec2 p, double at_most = std::numeric_limits<double>::infinity()) const noexcept;
  /// Is every point of a-b at least r from every wall? r > 0: distance >= r, in double. r = 0: same as !blocks(a, b).
  bool keeps_clearance(Vec2 a, Vec2 b, double r) const noexcept;
  /// The same for up to most_motions motions: bit i is set if the i-th keeps its distance. Best for motions near each
  /// other: the walls around all of them are looked up once, and held against all of them at once.
  std::uint32_t keep_clearance(std::span<const Segment> motions, double r) const noexcept;
  static constexpr std::size_t most_motions = 16;

  /// Calls visit(const Segment&) -> bool for each wall whose own box meets `box`, some more than once, and perhaps for
  /// others nearby, in an order that depends on the walls alone; stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    std::visit([&](const auto& grid) { grid.for_each_near(box, visit); }, grid_);
  }

 private:
  std::size_t wall_count_ = 0;
  Box box_;
  std::variant<WallGrid<float>, WallGrid<double>> grid_;
};

/// Is the distance between the segments at least r? r > 0. The plain double test that every faster one must agree with.
bool segments_keep_distance(const Segment& s, const Segment& t, double r) noexcept;

namespace detail {

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

}  // namespace detail

}  // namespace warren
