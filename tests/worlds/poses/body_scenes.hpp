// SPDX-License-Identifier: BSD-3-Clause
// Scenes and poses for the tests of bodies that turn.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::body_scenes {

inline const std::vector<Vec2> kite = {{0.10, 0.63}, {0.22, 0.41}, {0.49, 0.20}, {0.48, 0.82}};
inline const std::vector<Vec2> hook = {{-0.3, -0.3}, {0.5, -0.3}, {0.5, 0.5}, {0.3, 0.5}, {0.3, -0.1}, {-0.3, -0.1}};

/// A star-shaped polygon, mostly not convex.
inline std::vector<Vec2> star(std::uint64_t seed, std::uint64_t index, Vec2 centre, double size) {
  const std::uint64_t corners = 3 + random_bits(seed, index, 100) % 7;
  std::vector<Vec2> polygon;
  for (std::uint64_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = size * (0.3 + 0.7 * uniform(seed, index, 2 * i));
    polygon.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  if (random_bits(seed, index, 101) % 2 == 0) return {polygon.rbegin(), polygon.rend()};
  return polygon;
}

/// Polygons and walls scattered over a square of 10 with bounds.
inline Scene scattered(std::uint64_t seed, std::size_t polygons = 12, std::size_t walls = 6) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  const auto place = [&](std::uint64_t i) { return Vec2{10.0 * uniform(seed, i, 200), 10.0 * uniform(seed, i, 201)}; };
  for (std::size_t i = 0; i < polygons; ++i) scene.polygons.push_back({star(seed, i, place(i), 0.9)});
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < walls; ++i) {
    const Vec2 a = place(1000 + i);
    segments.push_back({a, a + Vec2{uniform(seed, i, 300) - 0.5, uniform(seed, i, 301) - 0.5}});
  }
  scene.walls = WallSet::narrowest(segments);
  return scene;
}

/// A bay by a street, `room` longer than the car that stands `inside` of it, half of that behind the car; lengths are
/// times `scale`, and `origin` is where the car's reference point stands.
struct ParkingBay {
  Scene scene;
  std::vector<Vec2> car;  ///< whose turning radius is 3 * scale
  Se2 inside;
  Se2 street;
};
inline ParkingBay parking_bay(double room, double scale = 1.0, Vec2 origin = {}) {
  const auto box = [&](double left, double low, double right, double high) {
    return std::vector<Vec2>{origin + scale * Vec2{left, low}, origin + scale * Vec2{right, low},
                             origin + scale * Vec2{right, high}, origin + scale * Vec2{left, high}};
  };
  const double behind = -0.93 - 0.5 * room;
  const double ahead = 3.76 + 0.5 * room;
  const double curb = -1.05;
  const double side = 1.0;
  ParkingBay bay;
  bay.car = {scale * Vec2{-0.93, -0.97}, scale * Vec2{3.76, -0.97}, scale * Vec2{3.76, 0.97},
             scale * Vec2{-0.93, 0.97}};
  bay.scene.polygons = {{box(behind - 8, curb - 1, ahead + 8, curb)},
                        {box(behind - 8, curb, behind, side)},
                        {box(ahead, curb, ahead + 8, side)},
                        {box(behind - 8, side + 6, ahead + 8, side + 7)}};
  const std::vector<Vec2> all = box(behind - 8, curb - 1, ahead + 8, side + 7);
  bay.scene.bounds = Box{all[0], all[2]};
  bay.inside = {origin.x, origin.y, 0.0};
  bay.street = {origin.x + scale * 5.0, origin.y + scale * 3.0, 0.1};
  return bay;
}

inline Se2 random_pose(std::uint64_t seed, std::uint64_t index) {
  return {10.0 * uniform(seed, index, 0), 10.0 * uniform(seed, index, 1), 7.0 * uniform(seed, index, 2) - 3.5};
}

/// The corners of a body, turned by complex numbers.
inline std::vector<Vec2> corners_at(const std::vector<Vec2>& outline, const Se2& pose) {
  std::vector<Vec2> corners;
  for (const Vec2 p : outline) {
    const double angle = std::atan2(p.y, p.x) + pose.theta;
    const double radius = std::hypot(p.x, p.y);
    corners.push_back({pose.x + radius * std::cos(angle), pose.y + radius * std::sin(angle)});
  }
  return corners;
}

}  // namespace warren::body_scenes
