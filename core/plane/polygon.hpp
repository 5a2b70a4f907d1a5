// SPDX-License-Identifier: BSD-3-Clause
// Polygons as flat arrays, and everything that blocks the plane: the plain data that worlds and planners share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// Simple polygons whose open interiors are blocked, corners in order. Polygon p has the corners
/// corners[first[p]] .. corners[first[p + 1] - 1]. Fewer than 2^32 corners in all.
struct PolygonSet {
  std::vector<Vec2> corners;            ///< of all polygons, one after the other
  std::vector<std::uint32_t> first{0};  ///< size() + 1 numbers, ascending from 0

  std::size_t size() const { return first.size() - 1; }  ///< polygons
  bool empty() const { return size() == 0; }             ///< are there none?
  /// The corners of polygon p; p < size().
  std::span<const Vec2> operator[](std::size_t p) const {
    return std::span(corners).subspan(first[p], first[p + 1] - first[p]);
  }
  /// Appends a polygon.
  void add(std::span<const Vec2> outline) {
    corners.insert(corners.end(), outline.begin(), outline.end());
    first.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

/// Of all of them; empty where there are none.
inline Box box_around(std::span<const Vec2> points) {
  Box box;
  for (const Vec2 p : points) box.include(p);
  return box;
}

/// How far the farthest corner is from the reference point, (0, 0); 0 where there is none.
inline double outline_reach(std::span<const Vec2> outline) {
  double reach = 0.0;
  for (const Vec2 corner : outline) reach = std::max(reach, norm(corner));
  return reach;
}

/// What blocks the plane: polygons that run anticlockwise, each simple, with three or more corners, no two in a
/// row equal (checked where they are read, not here); walls; and the bounds, whose four sides are walls.
struct PlaneObstacles {
  PolygonSet polygons;         ///< whose insides are blocked
  std::vector<Segment> walls;  ///< without the sides of the bounds
  std::optional<Box> bounds;   ///< the box that nothing may leave; none: the plane has no end
};

/// The bounds, or else the box of polygons and walls; empty where there is nothing.
inline Box box_around(const PlaneObstacles& obstacles) {
  if (obstacles.bounds) return *obstacles.bounds;
  Box box = box_around(obstacles.polygons.corners);
  for (const Segment& wall : obstacles.walls) box.include(box_of(wall));
  return box;
}

// Distances of closed polygons, convex or not, either orientation: every pair of sides, decided by the exact predicates
// of core/plane/geometry. Exactly 0 where they touch, overlap or one lies in the other; else within 1e-14 of the
// coordinate differences. O(n m): the plain form; worlds/poses/obstacle_tree is the fast one.

/// The side of a polygon from corner i to the next one.
inline Segment polygon_side(std::span<const Vec2> polygon, std::size_t i) {
  return {polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]};
}

/// Calls visit(a, b) for the corners of each side, in their order.
template <class Visit>
void for_each_side(std::span<const Vec2> polygon, const Visit& visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]);
}

/// Does a simple outline run clockwise? Exact. One corner or more; equal ones in a row count once.
bool runs_clockwise(std::span<const Vec2> outline) noexcept;

/// Is p in the closed polygon? Exact.
bool contains(std::span<const Vec2> polygon, Vec2 p) noexcept;
/// Is p in the polygon and on no side of it? Exact.
bool strictly_inside(std::span<const Vec2> polygon, Vec2 p) noexcept;
/// The same of one of the polygons.
bool strictly_inside(const PolygonSet& polygons, Vec2 p) noexcept;

/// Of a closed polygon from a segment; 0 where they meet.
double distance(std::span<const Vec2> polygon, const Segment& s) noexcept;
/// Of two closed polygons; 0 where they meet.
double distance(std::span<const Vec2> a, std::span<const Vec2> b) noexcept;

}  // namespace warren
