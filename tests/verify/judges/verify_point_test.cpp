// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/verify/judges/paths_among_walls.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

using namespace paths_among_walls;

// ---- the oracle: everything against everything in 128-bit integers --------------------------------------------------

bool touch_int(const Segment& s, const Segment& t) {
  if (on(s, t.a) || on(s, t.b) || on(t, s.a) || on(t, s.b)) return true;
  return sign(cross_int(s.a, s.b, t.a)) * sign(cross_int(s.a, s.b, t.b)) < 0 &&
         sign(cross_int(t.a, t.b, s.a)) * sign(cross_int(t.a, t.b, s.b)) < 0;
}
/// Is the distance of p from s below the root of r_sq?
bool nearer_int(Vec2 p, const Segment& s, Int r_sq) {
  const Int length_sq = dot_int(s.a, s.b, s.b);
  const Int t = dot_int(s.a, s.b, p);
  if (t <= 0) return dot_int(s.a, p, p) < r_sq;
  if (t >= length_sq) return dot_int(s.b, p, p) < r_sq;
  const Int c = cross_int(s.a, s.b, p);
  return c * c < r_sq * length_sq;
}
bool nearer_int(const Segment& s, const Segment& t, Int r) {
  return touch_int(s, t) || nearer_int(s.a, t, r * r) || nearer_int(s.b, t, r * r) || nearer_int(t.a, s, r * r) ||
         nearer_int(t.b, s, r * r);
}
double distance_of(Vec2 p, const Segment& s) {
  const double length_sq = dot(s.b - s.a, s.b - s.a);
  const double t = length_sq > 0.0 ? std::clamp(dot(p - s.a, s.b - s.a) / length_sq, 0.0, 1.0) : 0.0;
  return norm(p - (s.a + t * (s.b - s.a)));
}
double distance_of(const Segment& s, const Segment& t) {
  if (touch_int(s, t)) return 0.0;
  return std::min({distance_of(s.a, t), distance_of(s.b, t), distance_of(t.a, s), distance_of(t.b, s)});
}

struct Expected {
  std::size_t leg = SIZE_MAX;
  std::size_t wall = 0;
  double least = std::numeric_limits<double>::infinity();
};
Expected by_brute_force(const std::vector<Segment>& walls, const std::vector<Vec2>& path, Int r) {
  Expected e;
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const Segment s{path[leg], path[leg + 1]};
      e.least = std::min(e.least, distance_of(s, walls[w]));
      const bool bad = r > 0 ? nearer_int(s, walls[w], r) : touch_int(s, walls[w]);
      if (bad && e.leg == SIZE_MAX) e.leg = leg, e.wall = w;
    }
  }
  return e;
}

/// Walls of very mixed lengths, some of them points, some parallel to the axes.
std::vector<Segment> random_walls(std::uint64_t seed, std::size_t count, double size) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = std::pow(size, uniform(seed + 1, i, 2));
    Segment s{random_point(seed, 2 * i, size), {}};
    s.b = s.a + random_point(seed + 2, 2 * i, reach);
    if (i % 3 == 0) s.b.x = s.a.x;
    if (i % 7 == 0) s.b = s.a;
    walls.push_back(s);
  }
  return with_far_box(walls, -2.0 * size, 4.0 * size);
}

std::vector<Vec2> random_path(std::uint64_t seed, std::size_t count, double size, double step) {
  std::vector<Vec2> path{random_point(seed, 0, size)};
  for (std::size_t i = 1; i < count; ++i) {
    const double reach = i % 9 == 0 ? size : step;
    Vec2 next = path.back() + random_point(seed, i, reach) - Vec2{std::floor(0.5 * reach), std::floor(0.5 * reach)};
    next.x = std::clamp(next.x, -size, 2.0 * size);
    next.y = std::clamp(next.y, -size, 2.0 * size);
    path.push_back(next);
  }
  return path;
}

void expect_same(const Verification& v, const Expected& e, const std::vector<Segment>& walls) {
  EXPECT_EQ(v.verified, e.leg == SIZE_MAX);
  EXPECT_NEAR(v.min_clearance, e.least, 1e-12 * (1.0 + e.least));
  ASSERT_EQ(v.first_violation.has_value(), e.leg != SIZE_MAX);
  if (!v.first_violation) return;
  EXPECT_EQ(v.first_violation->leg, e.leg);
  EXPECT_EQ(v.first_violation->obstacle.rfind("wall " + std::to_string(e.wall) + ":", 0), 0U)
      << v.first_violation->obstacle << " instead of " << e.wall << " of " << walls.size();
}

TEST(Verify, AgreesWithBruteForceInIntegers) {
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const double size = seed % 2 == 0 ? 40.0 : 2000.0;
    const std::vector<Segment> walls = random_walls(10 * seed, 3 + seed * 7, size);
    for (const double r : {0.0, 1.0, 5.0, 25.0}) {
      SCOPED_TRACE(r);
      const std::vector<Vec2> path = random_path(seed + 77, 2 + seed % 40, size, seed % 3 == 0 ? 3.0 : 30.0);
      const Verification v = verified(scene_of(walls), path, r);
      expect_same(v, by_brute_force(walls, path, static_cast<Int>(r)), walls);
      solved += v.verified ? 1 : 0;
    }
  }
  EXPECT_GT(solved, 10);  // else nothing but refusals was compared
}

/// There the middle of two coordinates is rounded; the oracle sees the same near the origin.
TEST(Verify, AgreesWithBruteForceFarFromTheOrigin) {
  constexpr Vec2 off{0x1p52, 0x1p52};
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 6; ++i)
      walls.push_back({random_point(seed, 2 * i, 60.0), random_point(seed, 2 * i + 1, 60.0)});
    walls = with_far_box(walls, -200.0, 200.0);
    std::vector<Vec2> path = random_path(seed + 500, 90, 8.0, 3.0);
    for (Vec2& p : path) p = p + random_point(seed, 99, 50.0);
    std::vector<Segment> far_walls;
    for (const Segment& wall : walls) far_walls.push_back({wall.a + off, wall.b + off});
    std::vector<Vec2> far_path;
    for (const Vec2 p : path) far_path.push_back(p + off);
    for (const double r : {0.0, 1.0, 5.0}) {
      const Verification v = verified(scene_of(far_walls), far_path, r);
      expect_same(v, by_brute_force(walls, path, static_cast<Int>(r)), walls);
      solved += v.verified ? 1 : 0;
    }
  }
  EXPECT_GT(solved, 10);
}

TEST(Verify, FindsTheFirstViolationOfAPathThatStaysLong) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Vec2> path;  // many short legs far from all walls, then one that isn't
    for (int i = 0; i < 3000; ++i) path.push_back({static_cast<double>(i % 40), 10.0 + static_cast<double>(i / 40)});
    std::vector<Segment> walls = with_far_box({}, -1000.0, 1000.0);
    EXPECT_TRUE(verified(scene_of(walls), path, 3.0).verified);
    const auto leg = static_cast<std::size_t>(uniform(seed, 0, 0) * 2999.0);
    const Vec2 at = 0.5 * (path[leg] + path[leg + 1]);
    walls.push_back({at, at + Vec2{200.0, 1.0}});
    const Expected e = by_brute_force(
        {{{2.0 * at.x, 2.0 * at.y}, {2.0 * at.x + 400.0, 2.0 * at.y + 2.0}}},
        [&] {
          std::vector<Vec2> doubled = path;
          for (Vec2& p : doubled) p = 2.0 * p;
          return doubled;
        }(),
        6);
    const Verification v = verified(scene_of(walls), path, 3.0);
    ASSERT_TRUE(v.first_violation);
    EXPECT_EQ(v.first_violation->leg, e.leg);
    EXPECT_EQ(v.min_clearance, 0.0);
  }
}

TEST(Verify, LeastClearanceIsRightHoweverFarTheWallsAre) {
  std::vector<Vec2> path;
  for (int i = 0; i < 1000; ++i) path.push_back({0.001 * i, (i % 2) * 0.001});
  const Scene scene = scene_of(with_far_box({}, -5000.0, 70000.0));
  EXPECT_EQ(verified(scene, path, 0.1).min_clearance, 5000.0);
  EXPECT_EQ(verified(scene, std::vector<Vec2>{{3.0, 4.0}}, 0.1).min_clearance, 5003.0);
}

TEST(Verify, DistanceEqualToTheClearanceIsFree) {
  const Scene scene = scene_of(with_far_box({{{0.0, 0.0}, {4.0, 3.0}}}, -20.0, 20.0));
  const std::vector<Vec2> path{{-3.0, 4.0}, {1.0, 7.0}};  // parallel, exactly 5 away
  EXPECT_TRUE(verified(scene, path, 5.0).verified);
  EXPECT_FALSE(verified(scene, path, std::nextafter(5.0, 6.0)).verified);
  EXPECT_EQ(verified(scene, path, 5.0).min_clearance, 5.0);
  const Scene flat = scene_of(with_far_box({{{0.0, 0.1}, {1.0, 0.1}}, {{0.0, -5.0}, {1.0, -5.0}}}, -20.0, 20.0));
  EXPECT_TRUE(verified(flat, {{0.0, -4.5}, {1.0, -4.5}}, 0.5).verified);
  // 0.3 - 0.1 is below 0.2 in the exact numbers that these doubles are, and above it after rounding
  EXPECT_FALSE(verified(flat, {{0.0, 0.3}, {1.0, 0.3}}, 0.2).verified);
}

TEST(Verify, ADistanceThatRoundsToTheClearanceIsComparedExactly) {
  int rounded_up = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const auto point = [&](std::uint64_t i) { return Vec2{1e3 * uniform(seed, i, 0), 1e3 * uniform(seed, i, 1)}; };
    const Segment wall{point(0), point(1)};
    const Segment leg{point(2), point(2) + 1e-3 * (point(3) - point(2))};
    const double d = exact::distance(leg, wall);
    if (d == 0.0) continue;
    const Scene scene = scene_of(with_far_box({wall}, -1e4, 1e4));
    for (const double r : {std::nextafter(d, 0.0), d, std::nextafter(d, 1e4)}) {
      const bool closer = exact::closer_than(leg, wall, r);
      EXPECT_EQ(verified(scene, {leg.a, leg.b}, r).verified, !closer) << r - d;
      rounded_up += closer && d > r ? 1 : 0;
    }
  }
  EXPECT_GT(rounded_up, 10);
}

TEST(Verify, AMutatedPathIsRefuted) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Segment> walls;  // corridors: a snake path is free until one corner is moved through a wall
    for (int i = 0; i < 60; ++i) {
      const double low = i % 2 == 0 ? 0.5 : 1.5;
      walls.push_back({{i + 0.5, low}, {i + 0.5, low + 9.0}});
    }
    walls = with_far_box(walls, -2.0, 70.0);
    std::vector<Vec2> path;
    for (int i = 0; i < 60; ++i) {
      const double turn = i % 2 == 0 ? 10.0 : 0.75;
      path.push_back({static_cast<double>(i), path.empty() ? 1.0 : path.back().y});
      path.push_back({static_cast<double>(i), turn});
    }
    ASSERT_TRUE(verified(scene_of(walls), path, 0.2).verified);
    const auto moved = 2 + 2 * static_cast<std::size_t>(uniform(seed, 1, 0) * 57.0);
    path[moved + 1].y = 5.0;
    const Verification v = verified(scene_of(walls), path, 0.2);
    ASSERT_FALSE(v.verified);
    EXPECT_EQ(v.first_violation->leg, moved + 1);
    EXPECT_EQ(v.first_violation->distance, 0.0);
  }
}

TEST(Verify, TranslationAndScaleDoNotMatter) {
  for (const double shift : {0.0, 1048576.0, -33554432.0}) {
    for (const double scale : {1.0, 1.0 / 1024.0, 1024.0}) {
      SCOPED_TRACE(testing::Message() << shift << " " << scale);
      const auto at = [&](double x, double y) { return Vec2{shift + scale * x, shift + scale * y}; };
      std::vector<Segment> walls;
      for (int i = 0; i < 200; ++i) walls.push_back({at(i, 0.0), at(i, 1.0)});
      walls.push_back({at(0.0, -5.0), at(200.0, 6.0)});
      const Scene scene = scene_of(walls);
      std::vector<Vec2> path;
      for (int i = 0; i < 200; ++i) path.push_back(at(i, 1.5));
      EXPECT_FALSE(verified(scene, path, scale * 0.5).verified);  // the long wall is in the way
      path.resize(100);
      EXPECT_TRUE(verified(scene, path, scale * 0.5).verified);
      EXPECT_FALSE(verified(scene, path, scale * 0.501).verified);
      EXPECT_EQ(verified(scene, path, scale * 0.5).min_clearance, scale * 0.5);
      path[50] = at(50.0, 0.5);
      EXPECT_EQ(verified(scene, path, scale * 0.25).first_violation->leg, 49U);
    }
  }
}

TEST(Verify, HugeWallsAndTinyLegsMeet) {
  const Scene scene = scene_of({{{-1e15, -1e15}, {1e15, 1e15}}, {{-1e15, 0.0}, {-1e15, 1e15}}, {{0, 0}, {0, -1.0}}});
  EXPECT_FALSE(verified(scene, {{0.001, 0.002}, {0.002, 0.001}}, 0.0).verified);
  EXPECT_TRUE(verified(scene, {{0.001, 0.002}, {0.0015, 0.0016}}, 0.0).verified);
  EXPECT_TRUE(verified(scene, {{0.001, 0.002}, {0.0015, 0.0016}}, 1e-5).verified);
  EXPECT_FALSE(verified(scene, {{0.001, 0.002}, {0.0015, 0.0016}}, 1e-3).verified);
}

/// Whose squares are 0 as doubles: nothing may be left out by them.
TEST(Verify, LegsOfAnyLengthAreKeptFromWallsFarAway) {
  const Scene scene = scene_of({{{1e30, -1e31}, {1e30, 1e31}},
                                {{3e26, -1e31}, {3e26, 1e31}},
                                {{-1e31, 1e31}, {1e31, 1e31}},
                                {{-1e31, -1e31}, {1e31, -1e31}}});
  const ObstacleIndex index(scene, {});
  for (double length = 1e-100; length > 0.0; length *= 1e-3) {
    SCOPED_TRACE(length);
    VerifyOptions options;
    options.clearance = 1e28;
    for (const std::vector<Vec2>& path : {std::vector<Vec2>{{0, 0}, {0, length}}, {{0, length}, {0, 0}, {0, length}}}) {
      for (const ObstacleIndex* by : {static_cast<const ObstacleIndex*>(nullptr), &index}) {
        const Verification v = verify_path(scene, path, options, {}, by);
        EXPECT_FALSE(v.verified) << (by != nullptr ? "by the index" : "by the pass");
        EXPECT_EQ(v.min_clearance, 3e26);
      }
    }
  }
}

TEST(Verify, AnyClearanceIsKeptOrNot) {
  const Scene scene = scene_of(with_far_box({{{2.0, 3.0}, {3.0, 3.0}}, {{400.0, 1.0}, {900.0, 9.0}}}, -1e6, 1e6));
  const std::vector<Vec2> path{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
  for (double clearance = 4.0; clearance < 1e60; clearance *= 16.0) {
    SCOPED_TRACE(clearance);
    const Verification v = verified(scene, path, clearance);
    EXPECT_FALSE(v.verified);
    EXPECT_EQ(v.min_clearance, std::hypot(1.0, 2.0));
  }
  EXPECT_FALSE(verified(scene, path, 1e60).verified);
}

TEST(Verify, ThePathStaysInTheBox) {
  const Scene scene = scene_of({{{0.0, 0.0}, {1.0, 0.0}}, {{10.0, 10.0}, {9.0, 10.0}}});
  EXPECT_TRUE(verified(scene, {{0.0, 1.0}, {10.0, 5.0}}, 0.5).verified);  // on its border
  const Verification v = verified(scene, {{2.0, 1.0}, {10.0, 5.0}, {10.5, 5.0}, {10.0, 5.0}}, 0.5);
  ASSERT_FALSE(v.verified);
  EXPECT_EQ(v.first_violation->leg, 1U);
  EXPECT_EQ(v.first_violation->obstacle, "box: 0 0 10 10");
}

TEST(Verify, BoundsAreWalls) {
  Scene scene = scene_of({{{5.0, 5.0}, {6.0, 5.0}}});
  scene.bounds = Box{{0.0, 0.0}, {10.0, 10.0}};
  EXPECT_TRUE(verified(scene, {{1.0, 1.0}, {9.0, 1.0}}, 1.0).verified);
  const Verification v = verified(scene, {{1.0, 2.0}, {9.0, 0.5}}, 1.0);
  ASSERT_FALSE(v.verified);
  EXPECT_EQ(v.first_violation->obstacle.rfind("bounds", 0), 0U);
  EXPECT_EQ(v.first_violation->distance, 0.5);
  EXPECT_FALSE(verified(scene, {{0.0, 1.0}, {9.0, 1.0}}, 0.0).verified);
  EXPECT_TRUE(verified(scene, {{0.0, 1.0}, {0.0, 9.0}, {5.0, 5.0}}, 0.0, Contact::allowed).verified);
  EXPECT_FALSE(verified(scene, {{0.0, 1.0}, {-1.0, 9.0}}, 0.0, Contact::allowed).verified);
}

// ---- the rest
// --------------------------------------------------------------------------------------------------------

TEST(Verify, ThreadsDoNotChangeTheResult) {
  std::vector<Segment> walls;
  for (int i = 0; i < 400000; ++i) {
    const Vec2 at = random_point(3, static_cast<std::uint64_t>(i), 3000.0);
    walls.push_back({at, at + (i % 2 == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0})});
  }
  walls = with_far_box(walls, -10.0, 3010.0);
  const Scene scene = scene_of(walls);
  const std::vector<Vec2> path = random_path(8, 2000, 3000.0, 9.0);
  for (const double r : {0.0, 0.25}) {
    for (const Contact contact : {Contact::blocked, Contact::allowed}) {
      VerifyOptions options;
      options.clearance = r;
      options.contact = contact;
      Execution execution;
      execution.threads = 1;
      const Verification one = verify_path(scene, path, options, execution);
      ASSERT_TRUE(one.first_violation);
      for (const unsigned threads : {2U, 3U, 8U}) {
        execution.threads = threads;
        const Verification many = verify_path(scene, path, options, execution);
        EXPECT_EQ(many.min_clearance, one.min_clearance);
        EXPECT_EQ(many.first_violation->leg, one.first_violation->leg);
        EXPECT_EQ(many.first_violation->obstacle, one.first_violation->obstacle);
      }
    }
  }
}

TEST(Verify, ManyWallsAreComparedAsByBruteForce) {  // enough of them for the sample that sets the reach
  std::vector<Segment> walls;
  for (int i = 0; i < 300000; ++i) {
    const Vec2 at = random_point(4, static_cast<std::uint64_t>(i), 6000.0);
    walls.push_back({at, at + (i % 2 == 0 ? Vec2{4.0, 0.0} : Vec2{0.0, 4.0})});
  }
  walls = with_far_box(walls, -100.0, 6100.0);
  for (const std::uint64_t seed : test::seeds(6, 2, 0)) {
    SCOPED_TRACE(seed);
    const std::vector<Vec2> path = random_path(seed, 3, 6000.0, 9.0);
    expect_same(verified(scene_of(walls), path, 2.0), by_brute_force(walls, path, 2), walls);
  }
}

TEST(Verify, StartAndGoalAreChecked) {
  const Scene scene = scene_of(with_far_box({}, -10.0, 10.0));
  const std::vector<Vec2> path{{0.0, 0.0}, {3.0, 4.0}};
  VerifyOptions options;
  options.start = Vec2{0.0, 0.0};
  options.goal = Vec2{3.0, 4.0};
  const Verification good = verify_path(scene, path, options, {});
  EXPECT_TRUE(good.verified);
  EXPECT_EQ(good.length, 5.0);
  options.goal = Vec2{3.0, 4.5};
  EXPECT_EQ(verify_path(scene, path, options, {}).first_violation->obstacle, "goal: 3 4.5");
  options.start = Vec2{1.0, 0.0};
  EXPECT_EQ(verify_path(scene, path, options, {}).first_violation->obstacle, "start: 1 0");
}

TEST(Verify, RefusesBadInput) {
  const Scene scene = scene_of(with_far_box({}, -10.0, 10.0));
  EXPECT_THROW(verified(scene, {}, 0.1), InputError);
  EXPECT_THROW(verified(scene, {{0.0, std::nan("")}}, 0.1), InputError);
  EXPECT_THROW(verified(scene, {{0.0, 0.0}, {1e300, 0.0}}, 0.1), InputError);
  EXPECT_THROW(verified(scene, {{0.0, 0.0}}, -0.1), InputError);
  EXPECT_THROW(verified(scene, {{0.0, 0.0}}, std::nan("")), InputError);
}

TEST(Verify, StopsAtTheDeadline) {
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  const std::vector<Vec2> path{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_THROW(verify_path(scene_of(with_far_box({}, -10.0, 10.0)), path, {}, execution), Stopped);
}

TEST(Verify, AWorldWithoutObstaclesAndBoundsIsRefusedAndBoundsAloneConfine) {
  const std::vector<Vec2> path{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_THROW(verified({}, path, 0.1), InputError);
  Scene room;
  room.bounds = Box{{-1.0, -1.0}, {2.0, 1.0}};
  EXPECT_DOUBLE_EQ(verified(room, path, 0.1).min_clearance, 1.0);
}

TEST(Verify, OnAMapTheCellsAreJudged) {
  Scene scene;
  scene.map.emplace().blocked = Bitmap(4, 1);
  scene.map->blocked.set(2, 0);
  const std::vector<Vec2> path{{0.5, 0.5}, {1.5, 0.5}};
  EXPECT_DOUBLE_EQ(verified(scene, path, 0.1).min_clearance, 0.5);
  EXPECT_EQ(verified(scene, {{0.5, 0.5}, {2.5, 0.5}}, 0.1).first_violation->obstacle, "cell 2, 0");
  EXPECT_THROW(verify_path(scene, path, {.contact = Contact::allowed}, {}), InputError);
}

}  // namespace
}  // namespace warren
