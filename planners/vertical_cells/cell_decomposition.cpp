// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_decomposition.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/plane/geometry.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/vertical_cells/cell_sweep.hpp"
#include "planners/visibility/noding.hpp"

namespace warren {
namespace {

std::string name_of(std::size_t obstacle, std::size_t polygon_count) {
  if (obstacle == ObstacleClash::bounds) return "the bounds";
  if (obstacle < polygon_count) return "polygon " + std::to_string(obstacle);
  return "wall " + std::to_string(obstacle - polygon_count);
}

std::string complaint(std::size_t obstacle, std::size_t other, std::size_t polygon_count) {
  const std::string rule = "; vertical cells need obstacles that touch at most";
  if (obstacle == other) return "crosses itself" + rule;
  if (other == ObstacleClash::bounds) return "reaches out of the bounds" + rule + " their sides";
  const bool overlap = obstacle < polygon_count && other < polygon_count;
  return (overlap ? "overlaps " : "crosses ") + name_of(other, polygon_count) + rule;
}

void add_box(const Box& box, PolygonSet& to) {
  to.add(std::array{box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}});
}

/// The polygons, and the outside of the bounds as four more.
PolygonSet framed(const PlaneObstacles& obstacles) {
  PolygonSet polygons = obstacles.polygons;
  if (!obstacles.bounds) return polygons;
  const Box& inner = *obstacles.bounds;
  Box outer = inner;
  for (const Vec2 p : polygons.corners) outer.include(p);
  outer = outer.grown(std::max({outer.width(), outer.height(), std::abs(outer.min.x), std::abs(outer.max.y)}));
  add_box({outer.min, {inner.min.x, outer.max.y}}, polygons);
  add_box({{inner.max.x, outer.min.y}, outer.max}, polygons);
  add_box({{inner.min.x, outer.min.y}, {inner.max.x, inner.min.y}}, polygons);
  add_box({{inner.min.x, inner.max.y}, {inner.max.x, outer.max.y}}, polygons);
  return polygons;
}

bool is_blocked(const PolygonSet& polygons, Vec2 p) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (strictly_inside(polygons[i], p)) return true;
  }
  return false;
}

}  // namespace

ObstacleClash::ObstacleClash(std::size_t obstacle, std::size_t other, std::size_t polygon_count)
    : InputError(name_of(obstacle, polygon_count), complaint(obstacle, other, polygon_count)),
      obstacle_(obstacle),
      other_(other) {}

Graph CellDecomposition::graph(std::size_t further_vertices, std::span<const Edge> further_edges,
                               const Execution& execution) const {
  std::vector<Edge> edges;
  edges.reserve(doors.size() + further_edges.size());
  for (const Door& door : doors) {
    if (!door.shut) edges.push_back({door.left, door.right});
  }
  edges.insert(edges.end(), further_edges.begin(), further_edges.end());
  return assemble_graph(cells.size() + further_vertices, edges, execution);
}

int CellDecomposition::side(std::uint32_t segment, Vec2 p) const noexcept {
  if (segment == floor_segment) return p.y > box.min.y ? 1 : p.y < box.min.y ? -1 : 0;
  if (segment == ceiling_segment) return p.y > box.max.y ? 1 : p.y < box.max.y ? -1 : 0;
  return orient2d(segments[segment].a, segments[segment].b, p);
}

double CellDecomposition::height(std::uint32_t segment, double x) const noexcept {
  if (segment == floor_segment) return box.min.y;
  if (segment == ceiling_segment) return box.max.y;
  const Segment& s = segments[segment];
  const double width = s.b.x - s.a.x;
  if (!(width > 0.0)) return x > s.a.x ? s.b.y : s.a.y;
  const double y = s.a.y + (x - s.a.x) / width * (s.b.y - s.a.y);
  return std::clamp(y, std::min(s.a.y, s.b.y), std::max(s.a.y, s.b.y));
}

Segment CellDecomposition::door_line(std::uint32_t door) const {
  const Vec2 corner = corners[doors[door].corner];
  const Vec2 far{corner.x, height(far_segment(door), corner.x)};
  return doors[door].above ? Segment{corner, far} : Segment{far, corner};
}

std::array<Vec2, 4> CellDecomposition::outline(std::uint32_t cell) const {
  const VerticalCell& c = cells[cell];
  const double left = c.left == no_number ? box.min.x : corners[c.left].x;
  const double right = c.right == no_number ? box.max.x : corners[c.right].x;
  return {{{left, height(c.lower, left)},
           {right, height(c.lower, right)},
           {right, height(c.upper, right)},
           {left, height(c.upper, left)}}};
}

CellDecomposition decompose(const PlaneObstacles& obstacles, std::span<const Vec2> points, const Execution& execution) {
  CellSweep sweep(obstacles, points, Overlaps::refused, execution);
  sweep.run();
  return sweep.take();
}

CellDecomposition decompose_united(const PlaneObstacles& obstacles, std::span<const Vec2> points,
                                   const Execution& execution) {
  assert(obstacles.walls.empty());
  PlaneObstacles united{node_polygons(framed(obstacles), execution).polygons, {}, std::nullopt};
  CellSweep sweep(united, points, Overlaps::united, execution);
  sweep.run();
  CellDecomposition cells = sweep.take();
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells.places[i].blocked = is_blocked(united.polygons, points[i]) || !cells.box.contains(points[i]);
  }
  return cells;
}

namespace {

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
