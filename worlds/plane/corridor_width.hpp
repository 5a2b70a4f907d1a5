// SPDX-License-Identifier: BSD-3-Clause
// How wide the free ways between walls are, by looking from the middles of some walls to either side; and how many
// uniform samples ways of that width need. What `--samples auto` begins with: a guess that need not be right.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// How far one sees from the middle of a wall (or beside it, where another wall ends there), square to it (side = 1: to
/// its left, -1: right), before the next wall, to a percent; 0 where nothing is in the way within the box. Throws
/// Stopped: a look among crowded walls takes long.
double free_width(const WallIndex& index, const Box& box, const Segment& wall, double side, const Execution& execution);

/// 4.5 samples for each square as wide as what the clearance leaves of `width`.
double samples_for_width(double width, double area, double clearance);

/// What so many walls in such a box are worth, however long the box is: what a square as broad as the box would need,
/// since a long world of few walls is no harder than the same one pushed together, or some samples for each wall, since
/// a long corridor may have a cell for each.
double most_samples_for(const Box& box, double width, double clearance, std::size_t walls);

/// The lower quartile of the free widths on those sides of some walls that begin in a point p with is_outside(p); the
/// side of a square of the box's area where no other wall is seen.
template <class IsOutside>
double typical_width(const WallIndex& index, const Box& box, const IsOutside& is_outside, const Execution& execution) {
  constexpr std::size_t probes = 64;
  std::vector<double> widths;
  for (const Segment& wall : index.some_walls(probes)) {
    const Vec2 along = wall.b - wall.a;
    for (const double side : {-1.0, 1.0}) {
      if (!is_outside(0.5 * (wall.a + wall.b) + (side * 1e-3) * Vec2{-along.y, along.x})) continue;
      const double width = free_width(index, box, wall, side, execution);
      if (width > 0.0) widths.push_back(width);
    }
  }
  const double whole = std::sqrt(box.width() * box.height());
  if (widths.empty()) return whole;
  const auto quartile = widths.begin() + as_whole<std::ptrdiff_t>(widths.size() / 4);
  std::nth_element(widths.begin(), quartile, widths.end());
  return std::min(whole, *quartile);
}

}  // namespace warren
