// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cells/cell_locator.hpp"

#include "core/plane/geometry.hpp"
#include "core/plane/polygon_distance.hpp"

namespace warren {
namespace {

bool is_blocked(const PolygonSet& polygons, Vec2 p) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (strictly_inside(polygons[i], p)) return true;
  }
  return false;
}

/// The cell is open when the sweep comes to p, or when it leaves it, and p lies between its segments or on them.
bool holds(const CellDecomposition& cells, const VerticalCell& cell, Vec2 p) {
  if (cell.left != no_number && is_before(p, cells.corners[cell.left])) return false;
  if (cell.right != no_number && is_before(cells.corners[cell.right], p)) return false;
  return cells.side(cell.lower, p) >= 0 && cells.side(cell.upper, p) <= 0;
}

}  // namespace

CellPlace locate(const CellDecomposition& cells, const PlaneObstacles& obstacles, Vec2 p) {
  CellPlace place;
  if (!cells.box.contains(p)) {
    place.blocked = true;
    return place;
  }
  place.blocked = is_blocked(obstacles.polygons, p);
  for (std::uint32_t i = 0; i < cells.cells.size(); ++i) {
    if (holds(cells, cells.cells[i], p) && !is_flat(cells, obstacles, cells.cells[i])) place.cells.push_back(i);
  }
  return place;
}

bool is_flat(const CellDecomposition& cells, const PlaneObstacles& obstacles, const VerticalCell& cell) {
  const bool on_floor = cell.lower == CellDecomposition::floor_segment;
  const bool on_ceiling = cell.upper == CellDecomposition::ceiling_segment;
  if (on_floor == on_ceiling) return false;
  const std::uint32_t segment = on_floor ? cell.upper : cell.lower;
  const bool is_wall = segment >= obstacles.polygons.corners.size();
  const Segment& s = cells.segments[segment];
  const Box& box = cells.box;
  if (!obstacles.bounds && (!is_wall || side_under(s, box) == BoxSide::none)) return false;
  const double y = on_floor ? box.min.y : box.max.y;
  const double x = on_floor ? box.max.x : box.min.x;
  return (s.a.y == y && s.b.y == y) || (s.a.x == x && s.b.x == x);
}

}  // namespace warren
