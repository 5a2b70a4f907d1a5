// SPDX-License-Identifier: BSD-3-Clause
// A path as a service keeps it, to be looked at again and again. One that goes from cell to cell of a lattice is held
// as two bits a step instead of sixteen bytes a point, to the bit: the paths of a maze of 10^8 cells have millions of
// them, and to touch so much fresh memory takes longer than to find them. Points come in blocks, each with the box
// around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "solve/answer/answer.hpp"
#include "solve/paths/timed_path.hpp"

namespace warren::serve {

/// Immutable; any number of threads may look.
class KeptCurve {
 public:
  static constexpr std::size_t block_points = 4096;

  KeptCurve() = default;
  /// Throws Stopped.
  KeptCurve(Path<Vec2> path, const Execution& execution);

  std::size_t size() const { return size_; }
  std::size_t bytes() const;
  /// Of block_points points each, and the next block's first.
  std::size_t block_count() const { return blocks_.size(); }
  /// Around all points of a block.
  const Box& box(std::size_t block) const { return blocks_[block].box; }
  /// How long the curve is up to a block's first point.
  double length_before(std::size_t block) const;
  /// The points of a block; `room` may hold them.
  std::span<const Vec2> points(std::size_t block, std::vector<Vec2>& room) const;
  /// All of them. Throws Stopped.
  Path<Vec2> whole(const Execution& execution) const;

 private:
  struct Block {
    Vec2 first;  // where the first of its steps begins: that of block 0 at the path's second point
    Box box;
    double length_before = 0.0;  // of points; steps say theirs by themselves
  };
  std::size_t points_in(std::size_t block) const;

  std::size_t size_ = 0;
  Path<Vec2> points_;                 // empty where there are steps
  std::vector<std::uint64_t> steps_;  // two bits a leg: 0 right, 1 up, 2 left, 3 down; of first and last leg nothing
  Vec2 ends_[2] = {};
  std::vector<Block> blocks_;
};

// A path as it can be seen: its pieces in a box, without points that lie in the same pixel as the one before. Of a path
// of millions of points that is what a screen shows of it.

/// The curve of a car's reference point as straight pieces: arcs as chords that turn by at most five degrees. Throws
/// Stopped.
Path<Vec2> curve_of(const Answer& answer, const Execution& execution);

struct PathView {
  Box box = {};        ///< legs that don't meet it are left out
  double pixel = 0.0;  ///< points nearer than that to the last one that was kept are, too; 0: none
  std::size_t most_points = std::numeric_limits<std::size_t>::max();  ///< of all that are left
};

/// Chains of at least two points, in the path's order; a path of one point is one chain of it. The ends of the path and
/// of each chain are kept, and the last point of each block. Memory: of those that are left, and of 64 blocks; the rest
/// of a path that has too many is not looked at. Throws HttpError for more than view.most_points, Stopped.
std::vector<std::vector<Vec2>> seen_of(const KeptCurve& curve, const PathView& view, const Execution& execution);

/// The body's state somewhere on a path.
struct PathPlace {
  double along;  ///< length of the reference point's way from the start
  PathState state;
};

/// Places along a path, evenly apart: where a profile is taken. count >= 2 places, start and goal among them, even by
/// PathLegs::length(), so that turns on the spot have some, too; of a path without length its one place. The answer has
/// a path. O(states + count). Throws Stopped.
std::vector<PathPlace> places_along(const Answer& answer, std::size_t count, const Execution& execution);

// The body at places along a kept path, as far as they can be seen: what the page draws as its sweep.

/// No more are told at once; where there were more, they are farther apart.
inline constexpr std::size_t most_swept_bodies = 1000;

struct SweptBodies {
  double apart = 0.0;  ///< by PathLegs::length(), half the body's reach at least
  std::vector<PathState> places;
};

/// The farthest point of a body of the plane from its reference point; 0 of a point.
double reach_of(const RobotSpec& robot);

/// Those that may touch the view's box, in the path's order, start and goal among them. way: body and states, which may
/// be none: then the curve is the path. Of a curve of several blocks, only those near the box are looked at. Throws
/// UsageError where the body is a point, Stopped.
SweptBodies swept_bodies(const Answer& way, const KeptCurve& curve, const PathView& view, const Execution& execution);

}  // namespace warren::serve
