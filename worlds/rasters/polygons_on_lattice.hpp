// SPDX-License-Identifier: BSD-3-Clause
// Marks lattice points that lie in, or near, convex and simple polygons: row by row, an interval each. Doubt is
// resolved towards marking: a point within a billionth of the lattice's size of an edge counts as in.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// Point (i, j) lies at origin + cell (i, j).
class LatticeMarking {
 public:
  LatticeMarking(Vec2 origin, double cell, std::uint32_t width, std::uint32_t height);

  /// The points nearer than `radius` to a convex polygon (counter-clockwise; a point or two corners too), those on it
  /// included. O(corners * rows).
  void mark_near(std::span<const Vec2> convex, double radius);
  /// The positions at which a piece, widened by `radius`, touches or leaves the bounds.
  void mark_outside(std::span<const Vec2> piece, double radius, const Box& bounds);
  /// The positions p for which p + `offset` lies inside a simple polygon. O(corners * rows that it meets). Throws
  /// Stopped.
  void mark_inside(std::span<const Vec2> polygon, Vec2 offset, const Execution& execution);

  Bitmap take() { return std::move(marked_); }

 private:
  void mark_run(std::int64_t row, double from, double to);
  double row_y(std::int64_t j) const { return origin_.y + static_cast<double>(j) * cell_; }

  Vec2 origin_;
  double cell_;
  double rounding_;  // world units
  Bitmap marked_;
};

}  // namespace warren
