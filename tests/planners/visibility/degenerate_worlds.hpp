// SPDX-License-Identifier: BSD-3-Clause
// Small polygon worlds on the integer grid, where shared corners, touching and common sides, collinear sides, equal x,
// walls that end on polygons, overlap or have no length are the rule.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"

namespace warren {

class DegenerateWorlds {
 public:
  static constexpr int size = 12;

  explicit DegenerateWorlds(std::uint64_t seed) : seed_(seed) {}

  /// crossing: polygons may overlap and walls cross anything; else they only touch.
  PlaneObstacles make(bool crossing) {
    PlaneObstacles world;
    const int polygons = 2 + number(4);
    for (int tries = 0; tries < 40 && static_cast<int>(world.polygons.size()) < polygons; ++tries) {
      const std::vector<Vec2> ring = number(2) == 0 ? rectangle() : star();
      if (ring.size() >= 3 && (crossing || fits(world, ring))) world.polygons.add(ring);
    }
    const int walls = number(6);
    for (int tries = 0; tries < 40 && static_cast<int>(world.walls.size()) < walls; ++tries) {
      const Segment wall = random_wall(world);
      if (crossing || fits(world, wall)) world.walls.push_back(wall);
    }
    if (number(2) == 0) world.bounds = Box{{0, 0}, {size, size}};
    return world;
  }
  Vec2 random_point() { return {static_cast<double>(number(size + 1)), static_cast<double>(number(size + 1))}; }

 private:
  int number(int below) { return static_cast<int>(uniform(seed_, count_++, 0) * below); }

  std::vector<Vec2> rectangle() {
    const Vec2 a = random_point();
    const Vec2 size_of{1.0 + number(4), 1.0 + number(4)};
    const Vec2 b{std::min<double>(size, a.x + size_of.x), std::min<double>(size, a.y + size_of.y)};
    if (!(a.x < b.x && a.y < b.y)) return {};
    std::vector<Vec2> ring{a, {b.x, a.y}, b, {a.x, b.y}};
    if (number(3) == 0 && b.x - a.x >= 2) ring.insert(ring.begin() + 1, {a.x + 1, a.y});  // a corner on a side
    return ring;
  }

  /// Grid points around a centre by angle; simple because it is star-shaped.
  std::vector<Vec2> star() {
    const Vec2 c = random_point();
    std::vector<Vec2> ring;
    for (int i = 0, n = 3 + number(4); i < n; ++i) {
      const Vec2 p{c.x + number(9) - 4, c.y + number(9) - 4};
      if (p == c || p.x < 0 || p.y < 0 || p.x > size || p.y > size) continue;
      ring.push_back(p);
    }
    const auto angle = [&](Vec2 p) { return std::atan2(p.y - c.y, p.x - c.x); };
    std::sort(ring.begin(), ring.end(), [&](Vec2 p, Vec2 q) { return angle(p) < angle(q); });
    ring.erase(std::unique(ring.begin(), ring.end(), [&](Vec2 p, Vec2 q) { return angle(p) == angle(q); }), ring.end());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (orient2d(c, ring[i], ring[(i + 1) % ring.size()]) <= 0) return {};  // the centre is not inside
    }
    return ring;
  }

  Segment random_wall(const PlaneObstacles& world) {
    const auto end = [&] {
      const auto& corners = world.polygons.corners;
      if (corners.empty() || number(2) == 0) return random_point();
      return corners[static_cast<std::size_t>(number(static_cast<int>(corners.size())))];
    };
    const Vec2 a = end();
    switch (number(6)) {
      case 0:
        return {a, a};
      case 1:
        return {a, {a.x, static_cast<double>(number(size + 1))}};
      default:
        return {a, end()};
    }
  }

  static std::vector<Segment> sides(const PlaneObstacles& world) {
    std::vector<Segment> result = world.walls;
    for (std::size_t p = 0; p < world.polygons.size(); ++p) {
      const auto ring = world.polygons[p];
      for (std::size_t i = 0; i < ring.size(); ++i) result.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
    return result;
  }
  static bool fits(const PlaneObstacles& world, const Segment& s) {
    const auto all = sides(world);
    return std::none_of(all.begin(), all.end(), [&](const Segment& t) { return segments_cross(s, t); });
  }
  static bool fits(const PlaneObstacles& world, const std::vector<Vec2>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!fits(world, Segment{ring[i], ring[(i + 1) % ring.size()]})) return false;
    }
    return true;
  }

  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace warren
