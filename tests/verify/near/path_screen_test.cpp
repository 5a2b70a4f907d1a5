// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/path_screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/worlds/plane/near_walls.hpp"

namespace warren {
namespace {

using test_screens::distances_of;
using test_screens::random_world;
using test_screens::Real;
using test_screens::World;

bool fits_float(const Segment& s) {
  const auto fits = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  return fits(s.a.x) && fits(s.a.y) && fits(s.b.x) && fits(s.b.y);
}

/// Those of the walls that can be packed, asked in doubles and packed: both must say the same.
void expect_same_packed(const PathScreen& screen, const std::vector<Segment>& walls) {
  std::vector<DoubleWall> doubles;
  std::vector<PackedWall> packed;
  for (const Segment& s : walls) {
    if (!PackedWall::fits(s.a.x, s.a.y, s.b.x, s.b.y)) continue;
    doubles.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
    packed.push_back(PackedWall::of(s.a.x, s.a.y, s.b.x, s.b.y));
  }
  PathScreen::Rest expected;
  PathScreen::Rest found;
  screen.sift(std::span<const DoubleWall>(doubles), 7, expected);
  screen.sift(std::span<const PackedWall>(packed), 7, found);
  EXPECT_EQ(found.doubtful, expected.doubtful);
  EXPECT_EQ(found.box.min, expected.box.min);
  EXPECT_EQ(found.box.max, expected.box.max);
}

/// Numbers of the walls that the screen drops, asked in doubles and, where they fit, in floats: both must say the same.
std::vector<std::size_t> clear_walls(const PathScreen& screen, const std::vector<Segment>& walls) {
  constexpr std::size_t first_number = 1000;
  std::vector<DoubleWall> doubles;
  std::vector<FloatWall> floats;
  Box box;
  for (const Segment& s : walls) {
    doubles.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
    floats.push_back(
        {static_cast<float>(s.a.x), static_cast<float>(s.a.y), static_cast<float>(s.b.x), static_cast<float>(s.b.y)});
    box.include(box_of(s));
  }
  PathScreen::Rest rest;
  screen.sift(std::span<const DoubleWall>(doubles), first_number, rest);
  EXPECT_EQ(rest.box.min, box.min);
  EXPECT_EQ(rest.box.max, box.max);
  if (std::all_of(walls.begin(), walls.end(), fits_float)) {
    PathScreen::Rest rest_of_floats;
    screen.sift(std::span<const FloatWall>(floats), first_number, rest_of_floats);
    EXPECT_EQ(rest_of_floats.doubtful, rest.doubtful);
    EXPECT_EQ(rest_of_floats.box.min, box.min);
    EXPECT_EQ(rest_of_floats.box.max, box.max);
  }
  expect_same_packed(screen, walls);
  EXPECT_TRUE(std::is_sorted(rest.doubtful.begin(), rest.doubtful.end()));
  std::vector<std::size_t> clear;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!std::binary_search(rest.doubtful.begin(), rest.doubtful.end(), first_number + i)) clear.push_back(i);
  }
  return clear;
}

PathScreen screen_of(const std::vector<Vec2>& path, std::size_t walls, double unit) {
  return {LegBoxes(path, {}), {walls, unit}, {}};
}

TEST(PathScreen, NoNearWallIsDropped) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::size_t dropped = 0;
    for (const auto& [name, w, unit, error] : variants(random_world(seed, seed % 2 == 0), seed)) {
      SCOPED_TRACE(name + " by " + std::to_string(unit));
      const std::vector<Real> distances = distances_of(w);
      for (const std::size_t free_cells : {std::size_t{0}, std::size_t{1} << 16}) {
        PathScreen screen = screen_of(w.path, free_cells, unit);
        for (const auto& [least, clearance] : {std::pair{0.5, 0.1}, {0.3, 0.0}, {0.05, 0.7}, {2.5, 0.0}, {0.0, 0.0}}) {
          SCOPED_TRACE(testing::Message() << "reach " << least << " " << clearance);
          screen.set_reach(unit * least, unit * clearance);
          const Real reach = unit * std::max(least, clearance);
          for (const std::size_t i : clear_walls(screen, w.walls)) {
            ++dropped;
            EXPECT_GE(distances[i], reach - error) << i;
            EXPECT_GT(distances[i], 0.0L) << i;
          }
        }
      }
    }
    EXPECT_GT(dropped, 1000U);
  }
}

TEST(PathScreen, SaysOfPackedWallsWhatItSaysOfTheirNumbers) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const double middle = seed % 4 == 0 ? 261000.0 : seed % 4 == 1 ? -700.0 : 0.0;
    const auto number = [&](std::uint64_t axis, std::uint64_t i, double spread) {
      return std::floor(spread * (uniform(seed, i, axis) - 0.5) * PackedWall::per_unit) / PackedWall::per_unit;
    };
    std::vector<Vec2> path;
    for (std::uint64_t i = 0; i < 50; ++i) path.push_back({middle + number(0, i, 90.0), middle + number(1, i, 90.0)});
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Vec2 a{middle + number(2, i, 100.0), middle + number(3, i, 100.0)};
      const double length = number(4, i, i % 40 == 0 ? 400.0 : i % 7 == 0 ? 0.1 : 4.0);
      walls.push_back({a, i % 2 == 0 ? Vec2{a.x + length, a.y} : Vec2{a.x, a.y + length}});
    }
    for (const double unit : {0.125, 0.5, 1.0, 16.0, 256.0}) {
      PathScreen screen = screen_of(path, 1 << 16, unit);
      screen.set_reach(0.4 * unit, 0.1);
      expect_same_packed(screen, walls);
    }
  }
}

TEST(PathScreen, SaysTheSameInPlainInstructions) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const World w = random_world(seed, seed % 2 == 0);
    std::vector<DoubleWall> doubles;
    std::vector<FloatWall> floats;
    std::vector<PackedWall> packed;
    for (std::uint64_t i = 0; i < 5; ++i) {
      for (const Segment& s : w.walls) {
        const auto at = [](double x) { return static_cast<float>(x); };
        doubles.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
        floats.push_back({at(s.a.x), at(s.a.y), at(s.b.x), at(s.b.y)});
        const auto steps = [&](double x) { return static_cast<std::int32_t>(x * PackedWall::per_unit); };
        packed.push_back(i % 2 == 0 ? PackedWall::level(steps(s.a.x), steps(s.a.y), steps(s.b.x - s.a.x))
                                    : PackedWall::upright(steps(s.a.x), steps(s.a.y), steps(s.b.y - s.a.y)));
      }
    }
    const LegBoxes legs(w.path, {});
    PathScreen fast(legs, {.walls = 1 << 16, .typical_wall = 1.0}, {});
    PathScreen plain(legs, {.walls = 1 << 16, .typical_wall = 1.0, .plain = true}, {});
    const auto expect_same = [&](const auto& walls) {
      PathScreen::Rest found;
      PathScreen::Rest expected;
      fast.sift(std::span(walls), 3, found);
      plain.sift(std::span(walls), 3, expected);
      EXPECT_EQ(found.doubtful, expected.doubtful);
      EXPECT_EQ(found.box.min, expected.box.min);
      EXPECT_EQ(found.box.max, expected.box.max);
    };
    for (const double reach : {0.3, 0.5, 2.0}) {
      fast.set_reach(reach, 0.1);
      plain.set_reach(reach, 0.1);
      expect_same(doubles);
      expect_same(floats);
      expect_same(packed);
    }
  }
}

TEST(PathScreen, AWallOneUlpTooNearIsNotDropped) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    // A leg along an axis and walls on both sides of it, at numbers of all sizes.
    const double y =
        seed % 3 == 0 ? static_cast<double>(seed) : std::ldexp(1.0 + uniform(seed, 0, 0), static_cast<int>(seed) - 30);
    const double gap = seed % 3 == 0 ? 0.5 : uniform(seed, 1, 0);
    const bool turned = seed % 2 == 0;
    const auto at = [&](double u, double v) { return turned ? Vec2{v, u} : Vec2{u, v}; };
    PathScreen screen = screen_of({at(0.0, y), at(3.0, y), at(3.0, y)}, 0, 1.0);
    screen.set_reach(gap, 0.0);
    for (const double far : {y + gap, y - gap}) {
      for (const double v : {far, std::nextafter(far, y), std::nextafter(std::nextafter(far, y), y)}) {
        const Real d = std::abs(static_cast<Real>(v) - static_cast<Real>(y));  // exact: 64 bits hold it
        if (d >= static_cast<Real>(gap)) continue;
        EXPECT_TRUE(clear_walls(screen, {{at(1.0, v), at(2.0, v)}}).empty()) << v - y << " " << gap;
      }
    }
  }
}

TEST(PathScreen, WallsThatTieWithTheLeastDistanceAreDroppedAlongALatticePath) {
  for (const Vec2 shift : {Vec2{0.0, 0.0}, Vec2{0.5, 0.5}, Vec2{1048576.0, -33554432.0}, Vec2{-3e9, 0.5}}) {
    SCOPED_TRACE(testing::Message() << shift.x << " " << shift.y);
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
    PathScreen screen = screen_of(w.path, 0, 1.0);
    screen.set_reach(0.5, 0.1);
    EXPECT_EQ(clear_walls(screen, w.walls).size(), w.walls.size());
    EXPECT_TRUE(clear_walls(screen, {{shift + Vec2{3.5, 2.5}, shift + Vec2{3.5, 3.5}}}).empty());  // across
    for (Segment& wall : w.walls) wall.b.x += 9.0;
    EXPECT_EQ(clear_walls(screen, {w.walls[0], w.walls[17]}).size(), 2U);  // long ones
    for (Segment& wall : w.walls) wall.b.y = wall.a.y + 40.0;
    EXPECT_TRUE(clear_walls(screen, w.walls).empty());  // wide boxes
  }
}

TEST(PathScreen, NoRowOfALongWallIsSkipped) {
  for (const bool turned : {false, true}) {
    const auto at = [&](double u, double v) { return turned ? Vec2{v, u} : Vec2{u, v}; };
    for (double place = 10.0; place < 90.0; place += 0.5) {  // where the path passes the wall, and keeps off otherwise
      SCOPED_TRACE(place);
      PathScreen screen =
          screen_of({at(0.0, 0.0), at(0.0, 100.0), at(10.0, 100.0), at(10.0, place), at(4.0, place)}, 0, 1.0);
      screen.set_reach(0.3, 0.0);
      EXPECT_TRUE(clear_walls(screen, {{at(5.0, 5.0), at(5.0, 95.0)}}).empty());
      EXPECT_TRUE(clear_walls(screen, {{at(5.5, 5.5), at(5.5, 94.5)}}).empty());
    }
  }
}

TEST(PathScreen, ThreadsMarkTheSameCells) {
  const World w = random_world(7, false);
  std::vector<Vec2> path;
  for (int i = 0; i < 40; ++i) {  // wide enough for many stripes
    for (const Vec2 p : w.path) path.push_back(p + Vec2{30.0 * i, 0.0});
  }
  std::vector<Segment> walls;
  for (int i = 0; i < 40; ++i) {
    for (const Segment& s : w.walls) walls.push_back({s.a + Vec2{30.0 * i, 0.0}, s.b + Vec2{30.0 * i, 0.0}});
  }
  Execution execution;
  execution.threads = 1;
  PathScreen one(LegBoxes(path, execution), {walls.size(), 0.25}, execution);
  one.set_reach(0.1, 0.0);
  const std::vector<std::size_t> clear = clear_walls(one, walls);
  EXPECT_GT(clear.size(), 1000U);
  for (const unsigned threads : {2U, 3U, 8U}) {
    execution.threads = threads;
    PathScreen many(LegBoxes(path, execution), {walls.size(), 0.25}, execution);
    many.set_reach(0.1, 0.0);
    EXPECT_EQ(clear_walls(many, walls), clear);
  }
}

}  // namespace
}  // namespace warren
