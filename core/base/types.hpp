// SPDX-License-Identifier: BSD-3-Clause
// The plain words of the plane: point, segment, box, vertex id. Aggregates of doubles, no invariants.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace warren {

/// A point or vector of the plane; units of the world.
struct Vec2 {
  double x = 0.0;  ///< to the right
  double y = 0.0;  ///< upwards

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

/// The scalar product.
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Twice the area from a to b: above 0 where b lies to the left of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// Its length.
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// Between two points.
inline double distance(Vec2 a, Vec2 b) { return norm(b - a); }

/// A closed straight segment; may have length zero.
struct Segment {
  Vec2 a;  ///< its first end
  Vec2 b;  ///< its second end
  friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

/// A closed axis-aligned box; the default is empty (min > max) and grows by include().
struct Box {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};    ///< lower left corner
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};  ///< upper right corner

  /// Holds it no point?
  constexpr bool empty() const { return min.x > max.x || min.y > max.y; }
  constexpr double width() const { return max.x - min.x; }   ///< below 0: empty
  constexpr double height() const { return max.y - min.y; }  ///< below 0: empty
  /// Anticlockwise from the lower left one.
  constexpr std::array<Vec2, 4> corners() const { return {{min, {max.x, min.y}, max, {min.x, max.y}}}; }
  /// Is the point inside or on a side?
  constexpr bool contains(Vec2 p) const { return min.x <= p.x && p.x <= max.x && min.y <= p.y && p.y <= max.y; }
  /// Have the two a point in common?
  constexpr bool meets(const Box& o) const {
    return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y;
  }
  /// Grows until it holds the point.
  constexpr void include(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  /// Grows until it holds the other box.
  constexpr void include(const Box& o) {
    if (o.empty()) return;
    include(o.min);
    include(o.max);
  }
  /// Each side moved outwards by so much.
  constexpr Box grown(double by) const { return {{min.x - by, min.y - by}, {max.x + by, max.y + by}}; }
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// The box of a segment.
inline Box box_of(const Segment& s) {
  return {{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)}, {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}};
}

/// The side of a box, of width and height > 0, that the segment lies on.
enum class BoxSide : std::uint8_t { none, left, right, bottom, top };
/// Which side of the box the segment lies on, as its file would give it: no rounding is forgiven.
inline BoxSide side_under(const Segment& s, const Box& box) {
  if (!(box.width() > 0.0) || !(box.height() > 0.0) || s.a == s.b) return BoxSide::none;
  if (s.a.x == s.b.x) {
    return s.a.x == box.min.x ? BoxSide::left : s.a.x == box.max.x ? BoxSide::right : BoxSide::none;
  }
  if (s.a.y != s.b.y) return BoxSide::none;
  return s.a.y == box.min.y ? BoxSide::bottom : s.a.y == box.max.y ? BoxSide::top : BoxSide::none;
}

/// A base of what is neither copied nor moved.
struct NotCopied {
  NotCopied() = default;                            ///< of nothing
  NotCopied(const NotCopied&) = delete;             ///< never
  NotCopied& operator=(const NotCopied&) = delete;  ///< never
};

/// Number of a vertex in a Graph, and of a milestone in a roadmap.
using VertexId = std::uint32_t;
/// No vertex has this number.
inline constexpr VertexId no_vertex = std::numeric_limits<VertexId>::max();

/// Coordinates beyond this magnitude are refused on input, so that squares and cubes of them stay finite;
/// coordinates closer to zero than `smallest_coordinate` are read as zero, so that products of them stay exact.
inline constexpr double largest_coordinate = 1e60;
/// See largest_coordinate.
inline constexpr double smallest_coordinate = 1e-100;

}  // namespace warren
