// SPDX-License-Identifier: BSD-3-Clause
// For the tests of what screens walls: random paths and walls, and distances by definition, in long double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/types.hpp"

namespace warren::test_screens {

using Real = long double;

// ---- the oracle: distances in long double, by definition ------------------------------------------------------------

struct Point {
  Real x, y;
};
inline Point point(Vec2 p) { return {p.x, p.y}; }
inline Real length(Real x, Real y) { return std::sqrt(x * x + y * y); }
inline Real distance_of(Point p, Point a, Point b) {
  const Real run_x = b.x - a.x;
  const Real run_y = b.y - a.y;
  const Real length_sq = run_x * run_x + run_y * run_y;
  if (length_sq == 0) return length(p.x - a.x, p.y - a.y);
  const Real t = ((p.x - a.x) * run_x + (p.y - a.y) * run_y) / length_sq;
  if (t <= 0) return length(p.x - a.x, p.y - a.y);
  if (t >= 1) return length(p.x - b.x, p.y - b.y);
  return std::abs(run_x * (p.y - a.y) - run_y * (p.x - a.x)) / std::sqrt(length_sq);
}
inline Real side(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
inline Real distance_of(const Segment& s, const Segment& t) {
  const Point a = point(s.a);
  const Point b = point(s.b);
  const Point c = point(t.a);
  const Point d = point(t.b);
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return 0;
  return std::min({distance_of(a, c, d), distance_of(b, c, d), distance_of(c, a, b), distance_of(d, a, b)});
}
inline Real distance_of(const Segment& wall, const std::vector<Vec2>& path) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg)
    least = std::min(least, distance_of({path[leg], path[leg + 1]}, wall));
  return least;
}

// ---- worlds ---------------------------------------------------------------------------------------------------------

struct World {
  std::vector<Vec2> path;
  std::vector<Segment> walls;
};

inline Vec2 somewhere(std::uint64_t seed, std::uint64_t i, double size) {
  return {uniform(seed, i, 0) * size, uniform(seed, i, 1) * size};
}

/// A path of steps along the axes or in all directions, now and then of length zero, now and then long; walls of all
/// lengths, some of them points.
inline World random_world(std::uint64_t seed, bool on_lattice) {
  constexpr double size = 24.0;
  const auto snapped = [&](Vec2 p, double offset) {
    return on_lattice ? Vec2{std::floor(p.x) + offset, std::floor(p.y) + offset} : p;
  };
  World w{{snapped(somewhere(seed, 0, size), 0.0)}, {}};
  const std::uint64_t legs = 1 + seed % 60;
  for (std::uint64_t i = 1; i <= legs; ++i) {
    const double step = i % 11 == 0 ? size : 2.0;
    Vec2 to = snapped(w.path.back() + somewhere(seed + 100, i, step) - Vec2{0.5 * step, 0.5 * step}, 0.0);
    if (on_lattice && i % 2 == 0) to.x = w.path.back().x;
    if (on_lattice && i % 2 == 1) to.y = w.path.back().y;
    if (i % 7 == 0) to = w.path.back();
    w.path.push_back(to);
  }
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double reach = i % 13 == 0 ? 60.0 : 2.0;
    const Vec2 a = snapped(somewhere(seed + 200, i, 2.0 * size) - Vec2{0.5 * size, 0.5 * size}, 0.5);
    Vec2 b = snapped(a + somewhere(seed + 300, i, reach) - Vec2{0.5 * reach, 0.5 * reach}, 0.5);
    if (i % 3 == 0) b.x = a.x;
    if (i % 3 == 1) b.y = a.y;
    if (i % 17 == 0) b = a;
    w.walls.push_back({a, b});
  }
  return w;
}

inline std::vector<Real> distances_of(const World& w) {
  std::vector<Real> distances;
  for (const Segment& wall : w.walls) distances.push_back(distance_of(wall, w.path));
  return distances;
}

template <class Map>
World mapped(World w, const Map& map) {
  for (Vec2& p : w.path) p = map(p);
  for (Segment& s : w.walls) s = {map(s.a), map(s.b)};
  return w;
}

/// The world as it is, and moved, scaled and turned. error: of the oracle, times the unit.
struct Variant {
  std::string name;
  World world;
  double unit;  ///< how long its steps of length 1 are now
  Real error;
};
inline std::vector<Variant> variants(const World& w, std::uint64_t seed) {
  std::vector<Variant> all{{"as it is", w, 1.0, 1e-16L}};
  for (const double shift : {0.25, 0.5, 1e6, -1e6 / 3.0, 1e15}) {
    all.push_back({"moved", mapped(w, [&](Vec2 p) { return p + Vec2{shift, -shift}; }), 1.0, 1e-16L});
  }
  for (const double scale : {1e-3, 0.125, 3.0, 1e30}) {
    all.push_back({"scaled", mapped(w, [&](Vec2 p) { return scale * p; }), scale, scale * 1e-15L});
  }
  const double angle = uniform(seed, 1, 7) * 2.0 * std::numbers::pi;
  const auto turned = [&](Vec2 p) {
    return Vec2{std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
  };
  all.push_back({"turned", mapped(w, turned), 1.0, 1e-15L});
  return all;
}

}  // namespace warren::test_screens
