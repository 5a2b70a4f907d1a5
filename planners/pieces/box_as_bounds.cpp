// SPDX-License-Identifier: BSD-3-Clause
#include "planners/pieces/box_as_bounds.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace warren {

Box box_around(const PlaneObstacles& obstacles) {
  if (obstacles.bounds) return *obstacles.bounds;
  Box box;
  for (const Vec2 p : obstacles.polygons.corners) box.include(p);
  for (const Segment& wall : obstacles.walls) box.include(box_of(wall));
  return box;
}

PlaneObstacles confined(PlaneObstacles obstacles) {
  if (obstacles.bounds) return obstacles;
  const Box box = box_around(obstacles);
  const Box outer = box.grown(std::max(box.width(), box.height()));
  for (const Segment& wall : obstacles.walls) {
    const BoxSide side = side_under(wall, box);
    if (side == BoxSide::none) continue;
    Box behind = box_of(wall);
    if (side == BoxSide::left) behind.min.x = outer.min.x;
    if (side == BoxSide::right) behind.max.x = outer.max.x;
    if (side == BoxSide::bottom) behind.min.y = outer.min.y;
    if (side == BoxSide::top) behind.max.y = outer.max.y;
    obstacles.polygons.add(
        std::array{behind.min, Vec2{behind.max.x, behind.min.y}, behind.max, Vec2{behind.min.x, behind.max.y}});
    obstacles.bounds = outer;
  }
  return obstacles;
}

}  // namespace warren
