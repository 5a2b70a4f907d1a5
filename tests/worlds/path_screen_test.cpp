// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/path_screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/rng.hpp"

namespace warren {
namespace {

using Real = long double;

// ---- the oracle: distances in long double, by definition ------------------------------------------------------------

struct Point {
  Real x, y;
};
Point point(Vec2 p) { return {p.x, p.y}; }
Real length(Real x, Real y) { return std::sqrt(x * x + y * y); }
Real distance_of(Point p, Point a, Point b) {
  const Real run_x = b.x - a.x;
  const Real run_y = b.y - a.y;
  const Real length_sq = run_x * run_x + run_y * run_y;
  if (length_sq == 0) return length(p.x - a.x, p.y - a.y);
  const Real t = ((p.x - a.x) * run_x + (p.y - a.y) * run_y) / length_sq;
  if (t <= 0) return length(p.x - a.x, p.y - a.y);
  if (t >= 1) return length(p.x - b.x, p.y - b.y);
  return std::abs(run_x * (p.y - a.y) - run_y * (p.x - a.x)) / std::sqrt(length_sq);
}
Real side(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
Real distance_of(const Segment& s, const Segment& t) {
  const Point a = point(s.a);
  const Point b = point(s.b);
  const Point c = point(t.a);
  const Point d = point(t.b);
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return 0;
  return std::min({distance_of(a, c, d), distance_of(b, c, d), distance_of(c, a, b), distance_of(d, a, b)});
}
Real distance_of(const Segment& wall, const std::vector<Vec2>& path) {
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

Vec2 somewhere(std::uint64_t seed, std::uint64_t i, double size) {
  return {uniform(seed, i, 0) * size, uniform(seed, i, 1) * size};
}

/// A path of steps along the axes or in all directions, now and then of length zero, now and then long; walls of all
/// lengths, some of them points.
World random_world(std::uint64_t seed, bool on_lattice) {
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
  for (std::uint64_t i = 0; i < 400; ++i) {
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

template <class Map>
World mapped(World w, const Map& map) {
  for (Vec2& p : w.path) p = map(p);
  for (Segment& s : w.walls) s = {map(s.a), map(s.b)};
  return w;
}

bool is_clear(const PathScreen& screen, const Segment& wall) {
  std::size_t budget = 1'000'000;
  return screen.is_clear(box_of(wall), budget);
}

/// `unit`: the length of a lattice step; `error`: of the oracle.
std::size_t expect_no_near_wall_is_clear(const World& w, double unit, Real error) {
  PathScreen screen(w.path, unit, {});
  std::size_t clear = 0;
  for (const auto& [least, clearance] : {std::pair{0.5, 0.1}, {0.3, 0.0}, {0.05, 0.7}, {2.5, 0.0}, {0.0, 0.0}}) {
    SCOPED_TRACE(testing::Message() << "reach " << least << " " << clearance);
    screen.set_reach(unit * least, unit * clearance);
    const Real reach = unit * std::max(least, clearance);
    for (const Segment& wall : w.walls) {
      if (!is_clear(screen, wall)) continue;
      ++clear;
      const Real d = distance_of(wall, w.path);
      EXPECT_GE(d, reach - error) << wall.a.x << " " << wall.a.y << " " << wall.b.x << " " << wall.b.y;
      EXPECT_GT(d, 0.0L);
    }
  }
  return clear;
}

TEST(PathScreen, NoNearWallIsClear) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const World w = random_world(seed, seed % 2 == 0);
    EXPECT_GT(expect_no_near_wall_is_clear(w, 1.0, 1e-16L), 100U);
    for (const double shift : {0.25, 1e6, -1e6 / 3.0}) {
      SCOPED_TRACE(shift);
      const auto moved = mapped(w, [&](Vec2 p) { return p + Vec2{shift, -shift}; });
      EXPECT_GT(expect_no_near_wall_is_clear(moved, 1.0, 1e-16L), 100U);
    }
    for (const double scale : {1e-3, 1e3, 1e30}) {
      SCOPED_TRACE(scale);
      const auto scaled = mapped(w, [&](Vec2 p) { return scale * p; });
      EXPECT_GT(expect_no_near_wall_is_clear(scaled, scale, scale * 1e-15L), 100U);
    }
    const double angle = uniform(seed, 1, 7) * 2.0 * std::numbers::pi;
    const auto turned = mapped(w, [&](Vec2 p) {
      return Vec2{std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
    });
    EXPECT_GT(expect_no_near_wall_is_clear(turned, 1.0, 1e-15L), 100U);
  }
}

TEST(PathScreen, AWallOneUlpTooNearIsNotClear) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    // A leg along x and walls above and below it, at numbers of all sizes.
    const double y = std::ldexp(1.0 + uniform(seed, 0, 0), static_cast<int>(seed) - 20);
    const double gap = uniform(seed, 1, 0);
    const std::vector<Vec2> path{{0.0, y}, {3.0, y}, {3.0, y}};
    PathScreen screen(path, 1.0, {});
    screen.set_reach(gap, 0.0);
    for (const double at : {y + gap, y - gap}) {
      for (const double wall_y : {at, std::nextafter(at, y), std::nextafter(std::nextafter(at, y), y)}) {
        const Real d = std::abs(static_cast<Real>(wall_y) - static_cast<Real>(y));  // exact: 64 bits hold it
        if (d < static_cast<Real>(gap)) {
          EXPECT_FALSE(is_clear(screen, {{1.0, wall_y}, {2.0, wall_y}})) << wall_y - y << " " << gap;
        }
      }
    }
  }
}

TEST(PathScreen, WallsThatTieWithTheLeastDistanceAreClearAlongALatticePath) {
  for (const Vec2 shift : {Vec2{0.0, 0.0}, Vec2{0.5, 0.5}, Vec2{1048576.0, -1048576.0}}) {
    World w;  // a meander of unit steps, walls half a step off on both sides
    for (int i = 0; i < 400; ++i) {
      const int turn = i / 20;
      const int along = turn % 2 == 0 ? i % 20 : 19 - i % 20;
      w.path.push_back(shift + Vec2{static_cast<double>(along), static_cast<double>(turn)});
    }
    for (int i = 0; i < 18; ++i) {
      for (int k = 1; k < 18; ++k) {
        w.walls.push_back({shift + Vec2{k - 0.5, i + 0.5}, shift + Vec2{k + 0.5, i + 0.5}});
      }
    }
    PathScreen screen(w.path, 1.0, {});
    screen.set_reach(0.5, 0.1);
    for (const Segment& wall : w.walls) EXPECT_TRUE(is_clear(screen, wall)) << wall.a.x << " " << wall.a.y;
    EXPECT_FALSE(is_clear(screen, {shift + Vec2{3.5, 2.5}, shift + Vec2{3.5, 3.5}}));  // across
  }
}

TEST(PathScreen, TheDistanceOfSomeLegsIsNoLessThanThatOfThePath) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const World w = random_world(seed, seed % 2 == 0);
    const PathScreen screen(w.path, 1.0, {});
    for (const Segment& wall : w.walls) {
      const double some = screen.distance_of_some(wall);
      EXPECT_GE(static_cast<Real>(some), distance_of(wall, w.path) - 1e-12L);
      found += std::isfinite(some) ? 1 : 0;
    }
  }
  EXPECT_GT(found, 300);
}

}  // namespace
}  // namespace warren
