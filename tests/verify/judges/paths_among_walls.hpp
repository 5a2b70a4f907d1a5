// SPDX-License-Identifier: BSD-3-Clause
// Walls, paths and exact signs for the tests of verify/judges/verify_point.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/rng.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren::paths_among_walls {

__extension__ using Int = __int128;

inline Scene scene_of(const std::vector<Segment>& walls) {
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

inline Verification verified(const Scene& scene, const std::vector<Vec2>& path, double r,
                             Contact contact = Contact::blocked) {
  VerifyOptions options;
  options.clearance = r;
  options.contact = contact;
  return verify_path(scene, path, options, {});
}

/// The four sides of a square around everything, so that the box confines nothing.
inline std::vector<Segment> with_far_box(std::vector<Segment> walls, double low, double high) {
  walls.push_back({{low, low}, {high, low}});
  walls.push_back({{low, high}, {high, high}});
  walls.push_back({{low, low}, {low, high}});
  walls.push_back({{high, low}, {high, high}});
  return walls;
}

inline Int cross_int(Vec2 a, Vec2 b, Vec2 c) {
  const auto i = [](double x) { return static_cast<Int>(x); };
  return (i(b.x) - i(a.x)) * (i(c.y) - i(a.y)) - (i(b.y) - i(a.y)) * (i(c.x) - i(a.x));
}
inline Int dot_int(Vec2 a, Vec2 b, Vec2 c) {
  const auto i = [](double x) { return static_cast<Int>(x); };
  return (i(b.x) - i(a.x)) * (i(c.x) - i(a.x)) + (i(b.y) - i(a.y)) * (i(c.y) - i(a.y));
}
inline int sign(Int x) { return (x > 0) - (x < 0); }
inline bool on(const Segment& s, Vec2 p) { return cross_int(s.a, s.b, p) == 0 && dot_int(p, s.a, s.b) <= 0; }

inline Vec2 random_point(std::uint64_t seed, std::uint64_t i, double size) {
  return {std::floor(uniform(seed, i, 0) * size), std::floor(uniform(seed, i, 1) * size)};
}

}  // namespace warren::paths_among_walls
