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
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/wall_grid.hpp"

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

}  // namespace warren
