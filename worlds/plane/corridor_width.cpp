// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/corridor_width.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/whole.hpp"

namespace warren {
namespace {

/// From `from`, a step off the wall, along the unit vector `normal`.
double look(const WallIndex& index, const Box& box, Vec2 from, Vec2 normal, double step, const Execution& execution) {
  const double farthest = box.width() + box.height();
  const auto blocked = [&](double t) {
    execution.check();
    return index.blocks(from + step * normal, from + t * normal);
  };
  double far = 2.0 * step;
  while (far < farthest && !blocked(far)) far *= 2.0;
  if (far >= farthest) return 0.0;
  double near = 0.5 * far;
  while (far - near > 0.01 * far) {
    const double t = 0.5 * (near + far);
    (blocked(t) ? far : near) = t;
  }
  return far;
}

/// How far one sees from the middle of a wall (or beside it, where another wall ends there), square to it (side = 1: to
/// its left, -1: right), before the next wall, to a percent; 0 where nothing is in the way within the box.
double free_width(const WallIndex& index, const Box& box, const Segment& wall, double side,
                  const Execution& execution) {
  const Vec2 along = wall.b - wall.a;
  const double length = norm(along);
  if (length == 0.0) return 0.0;
  const Vec2 normal = (side / length) * Vec2{-along.y, along.x};
  const double breadth = std::min(box.width(), box.height());
  const double step = 1e-3 * std::min(length, breadth > 0.0 ? breadth : box.width() + box.height());
  const double width = look(index, box, 0.5 * (wall.a + wall.b), normal, step, execution);
  if (width == 0.0 || width > 2.0 * step) return width;
  constexpr double aside = 0.381966;  // a wall that ends in the middle of this one is not across the way
  return look(index, box, wall.a + aside * along, normal, step, execution);
}

}  // namespace

double samples_for_width(double width, double area, double clearance) {
  constexpr double samples_a_square = 4.5;
  const double free = std::max(width - 2.0 * clearance, 0.1 * width);
  return samples_a_square * area / (free * free);
}

double most_samples_for(const Box& box, double width, double clearance, std::size_t walls) {
  constexpr double least = 500.0;
  constexpr double samples_a_wall = 16.0;
  const double breadth = std::min(box.width(), box.height());
  return std::max(samples_for_width(width, breadth * breadth, clearance),
                  least + samples_a_wall * static_cast<double>(walls));
}

double typical_width(const WallIndex& index, const Box& box, const PolygonIndex* polygons, const Execution& execution) {
  constexpr std::size_t probes = 64;
  std::vector<double> widths;
  for (const Segment& wall : index.some_walls(probes)) {
    const Vec2 along = wall.b - wall.a;
    for (const double side : {-1.0, 1.0}) {
      const Vec2 beside = 0.5 * (wall.a + wall.b) + (side * 1e-3) * Vec2{-along.y, along.x};
      if (polygons != nullptr && polygons->polygon_around(beside)) continue;
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
