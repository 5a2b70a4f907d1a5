// SPDX-License-Identifier: BSD-3-Clause
// The plain words of the plane: point, segment, box, vertex id. Aggregates of doubles, no invariants.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace warren {

/// A point or vector of the plane; units of the world.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec2 a, Vec2 b) { return norm(b - a); }

/// A closed straight segment; may have length zero.
struct Segment {
  Vec2 a;
  Vec2 b;
  friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

/// A closed axis-aligned box; the default is empty (min > max) and grows by include().
struct Box {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  constexpr bool empty() const { return min.x > max.x || min.y > max.y; }
  constexpr double width() const { return max.x - min.x; }
  constexpr double height() const { return max.y - min.y; }
  constexpr bool contains(Vec2 p) const { return min.x <= p.x && p.x <= max.x && min.y <= p.y && p.y <= max.y; }
  constexpr bool meets(const Box& o) const {
    return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y;
  }
  constexpr void include(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  constexpr void include(const Box& o) {
    if (o.empty()) return;
    include(o.min);
    include(o.max);
  }
  constexpr Box grown(double by) const { return {{min.x - by, min.y - by}, {max.x + by, max.y + by}}; }
};

inline Box box_of(const Segment& s) {
  return {{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)}, {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}};
}

/// The side of a box, of width and height > 0, that the segment lies on.
enum class BoxSide : std::uint8_t { none, left, right, bottom, top };
inline BoxSide side_under(const Segment& s, const Box& box) {
  if (!(box.width() > 0.0) || !(box.height() > 0.0) || s.a == s.b) return BoxSide::none;
  if (s.a.x == s.b.x) {
    return s.a.x == box.min.x ? BoxSide::left : s.a.x == box.max.x ? BoxSide::right : BoxSide::none;
  }
  if (s.a.y != s.b.y) return BoxSide::none;
  return s.a.y == box.min.y ? BoxSide::bottom : s.a.y == box.max.y ? BoxSide::top : BoxSide::none;
}

/// Number of a vertex in a Graph, and of a milestone in a roadmap.
using VertexId = std::uint32_t;
inline constexpr VertexId no_vertex = std::numeric_limits<VertexId>::max();

/// Coordinates beyond this magnitude are refused on input, so that squares and cubes of them stay finite;
/// coordinates closer to zero than `smallest_coordinate` are read as zero, so that products of them stay exact.
inline constexpr double largest_coordinate = 1e60;
inline constexpr double smallest_coordinate = 1e-100;

}  // namespace warren
