// SPDX-License-Identifier: BSD-3-Clause
// How far a body stands from all that a scene holds, told the plainest way: every obstacle as a closed polygon or a
// segment, every cell of a map as a square, distances of points and segments by hand. Shares no code with the judges.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"
#include "tests/worlds/poses/body_scenes.hpp"

namespace warren::body_oracle {

/// A point, a segment or a polygon: its corners.
using Shape = std::vector<Vec2>;

inline double point_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double length_sq = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  const double along = (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
  const double t = length_sq > 0.0 ? std::min(1.0, std::max(0.0, along / length_sq)) : 0.0;
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

inline double turn_of(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

inline double segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (turn_of(a, b, c) * turn_of(a, b, d) < 0.0 && turn_of(c, d, a) * turn_of(c, d, b) < 0.0) return 0.0;
  return std::min(
      {point_to_segment(a, c, d), point_to_segment(b, c, d), point_to_segment(c, a, b), point_to_segment(d, a, b)});
}

/// By the winding of its corners about the point.
inline bool holds(const Shape& shape, Vec2 p) {
  double angle = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vec2 a = shape[i] - p;
    const Vec2 b = shape[(i + 1) % shape.size()] - p;
    angle += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return std::abs(angle) > 3.0;
}

/// 0 where they overlap or one holds the other.
inline double between(const Shape& a, const Shape& b) {
  if (holds(a, b.front()) || holds(b, a.front())) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      least = std::min(least, segments(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]));
    }
  }
  return least;
}

/// All obstacles; what lies outside of bounds and maps is what lies outside of `room`.
struct Obstacles {
  std::vector<Shape> shapes;
  Shape room;  // empty: none

  explicit Obstacles(const Scene& scene) {
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
      shapes.push_back({scene.walls.segment(i).a, scene.walls.segment(i).b});
    }
    for (const ScenePolygon& polygon : scene.polygons) shapes.push_back(polygon.corners);
    if (scene.bounds) room = square(scene.bounds->min, scene.bounds->width(), scene.bounds->height(), 0.0);
    if (!scene.map) return;
    const OccupancyMap& map = *scene.map;
    room = square(map.origin, map.cell * map.width(), map.cell * map.height(), map.yaw_rad);
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (!map.blocked.test(x, y)) continue;
        const double c = std::cos(map.yaw_rad);
        const double s = std::sin(map.yaw_rad);
        const Vec2 low{map.cell * x, map.cell * y};
        shapes.push_back(
            square(map.origin + Vec2{c * low.x - s * low.y, s * low.x + c * low.y}, map.cell, map.cell, map.yaw_rad));
      }
    }
  }

  /// A body of one corner is a disc's middle.
  double distance(const Shape& body) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& shape : shapes) least = std::min(least, between(body, shape));
    for (std::size_t i = 0; i < room.size(); ++i) {
      const Shape side{room[i], room[(i + 1) % room.size()]};
      least = std::min(least, between(body, side));
    }
    const bool is_out = !room.empty() && std::any_of(body.begin(), body.end(), [&](Vec2 p) { return !holds(room, p); });
    return is_out ? 0.0 : least;
  }

  static Shape square(Vec2 low, double width, double height, double yaw) {
    const Vec2 u{std::cos(yaw), std::sin(yaw)};
    const Vec2 v{-u.y, u.x};
    return {low, low + width * u, low + width * u + height * v, low + height * v};
  }
};

}  // namespace warren::body_oracle
