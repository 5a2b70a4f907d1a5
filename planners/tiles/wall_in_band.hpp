// SPDX-License-Identifier: BSD-3-Clause
// Where a wall passes a horizontal band: what keeps the cost of a long slanted wall at the cells that it passes instead
// of all cells of its box.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/types.hpp"

namespace warren {

struct BandInterval {
  double low;
  double high;
};

/// Contains the x of every point of the wall with low <= y <= high (there must be one); widened by the rounding error,
/// never beyond the wall's box.
inline BandInterval x_range_in_band(const Segment& wall, double low, double high) noexcept {
  const Box box = box_of(wall);
  if (box.min.y >= low && box.max.y <= high) return {box.min.x, box.max.x};
  const Vec2 along = wall.b - wall.a;
  const auto x_at = [&](double y) { return wall.a.x + std::clamp((y - wall.a.y) / along.y, 0.0, 1.0) * along.x; };
  const double x1 = x_at(low);
  const double x2 = x_at(high);
  const double reach_y = std::abs(wall.a.y) + std::abs(wall.b.y) + std::abs(low) + std::abs(high);
  const double error =
      16 * std::numeric_limits<double>::epsilon() *
      (std::abs(wall.a.x) + std::abs(wall.b.x) + std::abs(along.x) * (1 + reach_y / std::abs(along.y)));
  if (!(error < box.width())) return {box.min.x, box.max.x};
  return {std::max(box.min.x, std::min(x1, x2) - error), std::min(box.max.x, std::max(x1, x2) + error)};
}

}  // namespace warren
