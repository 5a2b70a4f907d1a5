// SPDX-License-Identifier: BSD-3-Clause
// Judges and numbers of all sizes that readers admit: coordinates from 1e-60 to 1e60, ends outside of everything, steps
// of one ulp, paths along obstacles. Points, discs and bodies that don't turn are judged once more by rationals, which
// share nothing with the judges; bodies that turn, cars and arms, by bounds of the room on pieces of each leg. Where a
// judge allows for rounding, both verdicts are right within it. More of them:
// WARREN_SEEDS=all; WARREN_JUDGED_LEGS=30000 besides: 10^5 legs, a minute of an optimised build.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/run/execution.hpp"
#include "core/run/trace.hpp"
#include "tests/seeds.hpp"
#include "tests/verify/judges/bounding_judge.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "verify/judges/verify_arm.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"
#include "verify/near/obstacle_index.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren::any_number {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// Of a kind, where all are asked.
const std::uint64_t legs = test::environment("WARREN_JUDGED_LEGS").empty()
                               ? 3000
                               : std::strtoull(test::environment("WARREN_JUDGED_LEGS").data(), nullptr, 10);

struct Point {
  Rational x, y;
};
Point exactly(Vec2 p) { return {Rational(p.x), Rational(p.y)}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
Rational dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
Rational cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }

Rational square_from(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const Rational length = dot(along, along);
  const Rational place = dot(p - a, along);
  if (place <= 0) return dot(p - a, p - a);
  if (place >= length) return dot(p - b, p - b);
  const Rational off = cross(p - a, along);
  return off * off / length;
}

/// Square of the distance of two closed segments.
Rational square_between(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto side = [](const Point& p, const Point& q, const Point& r) { return cross(q - p, r - p).sign(); };
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return 0;
  return std::min({square_from(a, c, d), square_from(b, c, d), square_from(c, a, b), square_from(d, a, b)});
}

/// A number of any size that readers admit; half of them near those of the world.
double any_number(std::uint64_t seed, std::uint64_t i, double size) {
  const double u = uniform(seed, i, 0);
  const double sign = random_bits(seed, i, 1) % 2 == 0 ? 1.0 : -1.0;
  switch (random_bits(seed, i, 2) % 8) {
    case 0:
      return sign * std::pow(10.0, 120.0 * u - 60.0);
    case 1:
      return std::round(size * u);
    case 2:
      return std::nextafter(std::round(size * u), sign * 1e60);
    case 3:
      return std::round(2.0 * size * u) / 2.0 * (1.0 + sign * 1e-15);
    case 4:
      return sign * std::ldexp(1.0, static_cast<int>(random_bits(seed, i, 3) % 70));
    default:
      return size * u;
  }
}
Vec2 any_point(std::uint64_t seed, std::uint64_t i) {
  return {any_number(seed, 2 * i, 6.0), any_number(seed, 2 * i + 1, 5.0)};
}

/// Half of them short, within the world: of others hardly one in thirty is free.
Segment any_leg(std::uint64_t seed) {
  const Vec2 a = any_point(seed, 100);
  if (random_bits(seed, 0, 63) % 2 == 0) return {a, any_point(seed, 101)};
  const Vec2 from{std::round(12.0 * uniform(seed, 0, 64)) / 2.0, std::round(10.0 * uniform(seed, 0, 65)) / 2.0};
  return {from, {from.x, std::clamp(a.y, from.y - 1.0, from.y + 1.0)}};
}

/// Works as fast, by the processor's time, and as small as a small question may be. The clock sees loops without end.
struct Limits : NotCopied {
  ~Limits() { EXPECT_LT(process_cpu_s() - began_cpu_s, 20.0); }
  const double began_cpu_s = process_cpu_s();
  static constexpr std::size_t bytes = std::size_t{test::memory_is_ours() ? 200 : 2000} << 20;
  Deadline deadline{120.0, resident_bytes() + bytes};
  Execution execution{.threads = 1, .deadline = &deadline};
};

OccupancyMap map_of(std::uint64_t seed) {
  OccupancyMap map;
  map.blocked = Bitmap(6, 5);
  for (std::uint64_t i = 0; i < 4; ++i) {
    map.blocked.set(static_cast<std::uint32_t>(random_bits(seed, i, 50) % 6),
                    static_cast<std::uint32_t>(random_bits(seed, i, 51) % 5));
  }
  constexpr double cells[] = {1.0, 1.0, 0.25, 0.05};
  map.cell = cells[random_bits(seed, 0, 52) % 4];
  if (random_bits(seed, 0, 53) % 2 == 0) map.origin = {-51.2, 4e5};
  return map;
}

/// The square of a leg's distance from all that is blocked; below 0 with an end outside.
Rational square_on_map(const OccupancyMap& map, const Point& a, const Point& b) {
  const Rational cell(map.cell);
  const auto corner = [&](unsigned x, unsigned y) { return exactly(map.origin) + Point{x * cell, y * cell}; };
  const Point origin = exactly(map.origin);
  const Point far = corner(map.width(), map.height());
  const auto holds = [](const Point& low, const Point& high, const Point& p) {
    return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
  };
  Rational least = dot(far - origin, far - origin);
  const auto keep_off = [&](const Point& low, const Point& high) {
    const Point corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    for (int side = 0; side < 4; ++side) {
      least = std::min(least, square_between(a, b, corners[side], corners[(side + 1) % 4]));
    }
  };
  if (!holds(origin, far, a) || !holds(origin, far, b)) return -1;
  keep_off(origin, far);
  for (unsigned y = 0; y < map.height(); ++y) {
    for (unsigned x = 0; x < map.width(); ++x) {
      if (!map.blocked.test(x, y)) continue;
      const Point low = corner(x, y);
      const Point high = corner(x + 1, y + 1);
      if (holds(low, high, a) || holds(low, high, b)) return 0;
      keep_off(low, high);
    }
  }
  return least;
}

TEST(JudgesOfAnyNumber, OnAMapAreThoseOfRationals) {
  std::size_t free = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(legs, 300);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = map_of(seed);
    const auto placed = [&](Vec2 p) { return map.origin + map.cell * p; };
    const Segment leg = any_leg(seed);
    const Vec2 path[] = {placed(leg.a), placed(leg.b)};
    const double wanted = random_bits(seed, 0, 54) % 2 == 0 ? 0.5 : any_number(seed, 300, 1.0);
    const double radius =
        std::abs(wanted) * map.cell * (1.0 + 1e-15 * static_cast<double>(random_bits(seed, 0, 55) % 3) - 1e-15);
    Limits limits;
    const bool verified = verify_on_map(map, path, {.radius = radius}, limits.execution).verified;
    const Rational square = square_on_map(map, exactly(path[0]), exactly(path[1]));
    const bool is_plain = map.origin == Vec2{} && map.cell != 0.05;
    const double size = norm(path[0]) + norm(path[1]) + 2.0 * norm(map.origin);
    const Rational rounding = is_plain ? Rational(0) : Rational(1e-14 * size);
    const Rational needed(radius);
    const Rational least = std::max(Rational(needed - rounding), Rational(0));
    const Rational most = needed + rounding;
    if (verified) {
      ++free;
      EXPECT_TRUE(square >= 0 && square >= least * least && (!is_plain || square > 0));
    } else {
      EXPECT_TRUE(square < most * most || square <= rounding * rounding);
    }
  }
  EXPECT_GT(free, seeds.size() / 40);
}

TEST(JudgesOfAnyNumber, GiveNothingAwayAlongACorridor) {
  OccupancyMap map;
  map.blocked = Bitmap(9, 3);
  for (std::uint32_t x = 0; x < 9; ++x) {
    map.blocked.set(x, 0);
    map.blocked.set(x, 2);
  }
  const auto is_free = [&](double y, double radius) {
    return verify_on_map(map, std::vector<Vec2>{{1.5, y}, {7.5, y}}, {.radius = radius}, {}).verified;
  };
  EXPECT_TRUE(is_free(1.5, 0.5));
  EXPECT_FALSE(is_free(1.5, std::nextafter(0.5, 1.0)));
  EXPECT_FALSE(is_free(1.5, 0.50000000049));
  EXPECT_FALSE(is_free(std::nextafter(1.5, 2.0), 0.5));
  EXPECT_TRUE(is_free(1.5 + 1e-15, 0.5 - 2e-15));
  for (const double x : {1e16, 1e19, 1e20, 1e21, 1e60}) {  // a leg to far outside
    Limits limits;
    for (const std::vector<Vec2>& path :
         {std::vector<Vec2>{{1.5, 1.5}, {x, 1.5}}, {{-x, 1.5}}, {{1.5, 1.5}, {x, -x}, {1.5, 1.5}}}) {
      const Verification far = verify_on_map(map, path, {.radius = 0.4}, limits.execution);
      EXPECT_FALSE(far.verified);
      EXPECT_EQ(far.first_violation->leg, 0U);
    }
  }
}

Scene plane_of(std::uint64_t seed) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {6, 5}};
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const auto place = [&](std::uint64_t n) { return std::round(10.0 * uniform(seed, n, 60)) / 2.0; };
    const Vec2 a{place(4 * i), place(4 * i + 1)};
    const Vec2 b{place(4 * i + 2), place(4 * i + 3)};
    walls.push_back({a, distance(a, b) < 1.0 ? a + Vec2{1.0, 0.0} : b});  // no body of the tests holds a whole one
  }
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

/// The sides of walls and bounds.
std::vector<Segment> sides_of(const Scene& scene, bool with_bounds) {
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) sides.push_back(scene.walls.segment(i));
  const auto [low, high] = scene.bounds.value_or(Box{});
  const std::vector<Segment> bounds{
      {low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
  if (with_bounds) sides.insert(sides.end(), bounds.begin(), bounds.end());
  return sides;
}

TEST(JudgesOfAnyNumber, AmongWallsAreThoseOfRationals) {
  std::size_t free = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(legs, 400);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const Scene scene = plane_of(seed);
    const auto [a, b] = any_leg(seed);
    const Vec2 path[] = {a, b};
    const double radius = std::abs(random_bits(seed, 0, 54) % 2 == 0 ? 0.5 : any_number(seed, 300, 1.0));
    Limits limits;
    const ObstacleIndex index(scene, limits.execution);
    const bool verified = verify_path(scene, path, {.radius = radius}, limits.execution).verified;
    EXPECT_EQ(verified, verify_path(scene, path, {.radius = radius}, limits.execution, &index).verified);
    bool expected = true;
    for (const Segment& s : sides_of(scene, true)) {
      const Rational square = square_between(exactly(path[0]), exactly(path[1]), exactly(s.a), exactly(s.b));
      expected = expected && square > 0 && square >= Rational(radius) * Rational(radius);
    }
    for (const Vec2 p : path) expected = expected && scene.bounds->contains(p);
    EXPECT_EQ(verified, expected);
    free += verified ? 1 : 0;
  }
  EXPECT_GT(free, seeds.size() / 40);
}

const std::vector<Vec2> kite = {{-0.25, 0.0}, {0.0, -0.125}, {0.5, 0.0}, {0.0, 0.125}};

/// Of a body that goes straight, by what it sweeps.
Rational square_of_sweep(const Scene& scene, Vec2 a, Vec2 b) {
  Rational least = 1000;
  for (const Segment& s : sides_of(scene, true)) {
    for (std::size_t i = 0; i < kite.size(); ++i) {
      const Point p = exactly(kite[i]);
      const Point q = exactly(kite[(i + 1) % kite.size()]);
      least = std::min(least, square_between(exactly(a) + p, exactly(b) + p, exactly(s.a), exactly(s.b)));
      for (const Vec2 end : {a, b}) {
        least = std::min(least, square_between(exactly(end) + p, exactly(end) + q, exactly(s.a), exactly(s.b)));
      }
      const Point ring[] = {exactly(a) + p, exactly(b) + p, exactly(b) + q, exactly(a) + q};
      int left = 0;
      int right = 0;
      for (int side = 0; side < 4; ++side) {
        const int sign = cross(ring[(side + 1) % 4] - ring[side], exactly(s.a) - ring[side]).sign();
        left += sign > 0 ? 1 : 0;
        right += sign < 0 ? 1 : 0;
      }
      if (left == 0 || right == 0) least = left + right == 4 ? Rational(0) : least;
    }
  }
  return least;
}

TEST(JudgesOfAnyNumber, OfBodiesThatGoStraightAreThoseOfRationals) {
  std::size_t free = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(legs, 200);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const Scene scene = plane_of(seed);
    const Vec2 a = any_point(seed, 100);
    const Vec2 b = random_bits(seed, 0, 54) % 4 == 0 ? Vec2{std::nextafter(a.x, 9.0), a.y} : any_point(seed, 101);
    const Se2 path[] = {{a.x, a.y, 0.0}, {b.x, b.y, 0.0}};
    Limits limits;
    const bool verified = verify_se2(scene, kite, path, {}, limits.execution).verified;
    bool inside = true;
    for (const Vec2 end : {a, b}) {
      for (const Vec2 p : kite) inside = inside && scene.bounds->contains(end + p);
    }
    const Rational square = inside ? square_of_sweep(scene, a, b) : Rational(-1);
    const Rational rounding(1e-12);
    if (verified) EXPECT_GT(square, 0);
    if (!verified) EXPECT_LE(square, rounding * rounding);
    free += verified ? 1 : 0;
  }
  EXPECT_GT(free, seeds.size() / 40);
}

/// In the plane of the scene, or on its map, whose blocked cells are boxes.
test::PlaneJudge second_judge(const Scene& scene, const std::vector<Vec2>& outline, double needed) {
  test::PlaneJudge judge{.outline = outline, .needed = needed};
  if (scene.map) {
    const Bitmap& cells = scene.map->blocked;
    judge.bounds = {{0, 0}, {static_cast<double>(cells.width()), static_cast<double>(cells.height())}};
    for (unsigned y = 0; y < cells.height(); ++y) {
      for (unsigned x = 0; x < cells.width(); ++x) {
        if (cells.test(x, y)) judge.blocked.push_back({{double(x), double(y)}, {x + 1.0, y + 1.0}});
      }
    }
    for (const auto& [low, high] : judge.blocked) {
      const Vec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
      for (int i = 0; i < 4; ++i) judge.sides.push_back({corners[i], corners[(i + 1) % 4]});
    }
  } else {
    judge.bounds = scene.bounds.value_or(Box{{-1e70, -1e70}, {1e70, 1e70}});
    judge.sides = sides_of(scene, false);
  }
  return judge;
}

void expect_as(test::Bounded bounded, bool verified, std::size_t& decided) {
  if (bounded == test::Bounded::unsure) return;
  ++decided;
  EXPECT_EQ(verified, bounded == test::Bounded::free);
}

constexpr double headings[] = {0.0, 0.387, -1.36, 3.14159265358979, 990.1, 1e-60, 9007199254740992.0};

/// What a car with this turning radius drives with its wheel still, at times but nearly: a step of one ulp, far away,
/// a little tighter, a little aside.
std::vector<Se2> any_drive(std::uint64_t seed, double radius) {
  const auto u = [&](std::uint64_t axis) { return uniform(seed, 5, axis); };
  Se2 a{6.0 * u(0), 5.0 * u(1), random_bits(seed, 5, 2) % 2 == 0 ? headings[random_bits(seed, 5, 3) % 6] : 6.0 * u(4)};
  const double way = (random_bits(seed, 5, 5) % 3 == 0 ? -1.0 : 1.0) * 1.5 * u(6);
  const double at = radius * (random_bits(seed, 5, 7) % 3 == 0 ? 1.0 - 1e-15 : 0.95 + 2.0 * u(8));
  const double turn = random_bits(seed, 5, 9) % 3 == 0 ? 0.0 : (u(10) < 0.5 ? 1.0 : -1.0) * std::abs(way) / at;
  const double chord = turn == 0.0 ? way : way * std::sin(0.5 * turn) / (0.5 * turn);
  Se2 b{a.x + chord * std::cos(a.theta + 0.5 * turn), a.y + chord * std::sin(a.theta + 0.5 * turn), a.theta + turn};
  switch (random_bits(seed, 5, 11) % 12) {
    case 0:
      return {a, {std::nextafter(a.x, 9.0), a.y, a.theta}};
    case 1:
      return {a, {any_number(seed, 400, 6.0), any_number(seed, 401, 5.0), b.theta}};
    case 2:
      return {{a.x, a.y, 0.0}, {any_number(seed, 400, 6.0), a.y, 0.0}};
    case 3:
      return {a, {b.x, b.y, b.theta + 1e-3 * u(12)}};
    default:
      return {a, b};
  }
}

TEST(JudgesOfAnyNumber, OfCarsAgreeWithASecondJudge) {
  constexpr double radius = 0.5;
  constexpr double off = 1e-9 * radius;
  std::size_t decided = 0;
  std::size_t free = 0;
  std::size_t asked = 0;
  for (const std::uint64_t seed : test::seeds(legs / 5, 200)) {
    const double size =
        std::abs(random_bits(seed, 6, 0) % 4 == 0 ? any_number(seed, 300, 0.1) : 0.4 * uniform(seed, 6, 1));
    const bool is_disc = random_bits(seed, 6, 2) % 2 == 0;
    const std::vector<Vec2> body{{0.0, 0.0}, {size, 0.0}, {0.0, size}};
    const std::vector<Se2> path = any_drive(seed, radius);
    Scene map;
    map.map.emplace(map_of(seed)).cell = 1.0;
    map.map->origin = {};
    for (const Scene& scene : {plane_of(seed), map}) {
      for (const bool reverses : {false, true}) {
        SCOPED_TRACE(testing::Message() << seed << (scene.map ? " map" : " walls") << (reverses ? " reverses" : ""));
        RobotSpec car{.kind = RobotKind::car,
                      .turning_radius = radius,
                      .steering = reverses ? SteeringKind::reeds_shepp : SteeringKind::dubins};
        if (is_disc) car.radius = size;
        if (!is_disc) car.outline = body;
        Limits limits;
        const bool verified = verify_car(scene, car, path, {}, limits.execution).verified;
        test::PlaneJudge judge = second_judge(scene, is_disc ? std::vector<Vec2>{{}} : body, car.radius);
        judge.unsure = 4.0 * off + 1e-12 * (10.0 + size);
        expect_as(bounded_car(judge, path[0], path[1], radius, reverses, off), verified, decided);
        free += verified ? 1 : 0;
        ++asked;
      }
    }
  }
  EXPECT_GT(decided, asked * 9 / 10);
  EXPECT_GT(free, asked / 10);
}

TEST(JudgesOfAnyNumber, OfArmsAgreeWithASecondJudge) {
  std::size_t decided = 0;
  std::size_t free = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(legs / 10, 100);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const DhTable table =
        seed % 2 == 0 ? puma560_table(0.1) : arm_oracle::modified_puma_table(0.3, PumaLimits::symmetric);
    const auto u = [&](std::uint64_t i, std::uint64_t axis) { return uniform(seed, i, axis); };
    Scene scene;
    for (std::uint64_t i = 0; i < 3; ++i) {
      const double size = i == 0 ? std::abs(any_number(seed, 500, 0.2)) : 0.2 * u(i, 20);
      scene.spheres.push_back({2.0 * u(i, 21) - 1.0, 2.0 * u(i, 22) - 1.0, u(i, 23), size});
      const std::array<double, 3> low{2.0 * u(i, 24) - 1.0, 2.0 * u(i, 25) - 1.0, 1.5 * u(i, 26) - 0.7};
      scene.boxes.push_back({low, {low[0] + 0.3 * u(i, 27), low[1] + 0.3 * u(i, 28), low[2] + 0.3 * u(i, 29)}});
    }
    std::vector<JointState> path(2);
    for (std::size_t j = 0; j < 6; ++j) {
      const DhJoint& joint = table.joints[j];
      path[0][j] = joint.low_rad + u(7, j) * (joint.high_rad - joint.low_rad);
      path[1][j] = std::clamp(path[0][j] + 0.4 * (u(8, j) - 0.5), joint.low_rad, joint.high_rad);
    }
    if (seed % 5 == 0) path[1][seed % 6] = any_number(seed, 501, 1.0);
    if (seed % 7 == 0) path[1] = path[0], path[1][seed % 6] = std::nextafter(path[0][seed % 6], 0.0);
    constexpr double radius = 0.05;
    Limits limits;
    const ArmVerifyOptions options;
    const ArmModel model = model_of(table, radius, false);
    const bool verified = verify_arm(scene, model, path, options, limits.execution).verified;
    expect_as(test::bounded_arm(scene, table, radius, path[0], path[1], options.tolerance), verified, decided);
    free += verified ? 1 : 0;
  }
  EXPECT_GT(decided, seeds.size() * 9 / 10);
  EXPECT_GT(free, seeds.size() / 20);
}

TEST(JudgesOfAnyNumber, OfTurningBodiesAndCarsAnswerOrRefuseInTimeAndMemory) {
  std::size_t free = 0;
  std::size_t decided = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(legs / 10, 60);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    Scene scene = plane_of(seed);
    if (random_bits(seed, 0, 57) % 2 == 0) scene.bounds.reset();
    Box room;
    for (const Segment& s : sides_of(scene, scene.bounds.has_value())) room.include(box_of(s));
    std::vector<Se2> path;
    for (std::uint64_t i = 0; i < 2; ++i) {
      Vec2 p = any_point(seed, 100 + i);
      if (random_bits(seed, 0, 59) % 4 != 0) {  // a short leg within
        p = Vec2{6.0 * uniform(seed, 0, 61), 5.0 * uniform(seed, 0, 62)} +
            static_cast<double>(i) * Vec2{uniform(seed, 1, 61) - 0.5, uniform(seed, 1, 62) - 0.5};
      }
      path.push_back({p.x, p.y, headings[random_bits(seed, i, 58) % 7]});
    }
    const double size = std::abs(any_number(seed, 300, 0.1));
    const std::vector<Vec2> body{{0.0, 0.0}, {size, 0.0}, {0.0, size}};
    Limits limits;
    if (std::max(path[0].theta, path[1].theta) > 1000.0) {
      EXPECT_THROW(verify_se2(scene, body, path, {}, limits.execution), InputError);
      EXPECT_THROW(verify_car(scene, {.turning_radius = 0.5}, path, {}, limits.execution), InputError);
      continue;
    }
    const bool is_inside = room.contains(path[0].position()) && room.contains(path[1].position());
    const bool verified = verify_se2(scene, body, path, {}, limits.execution).verified;
    EXPECT_TRUE(!verified || is_inside);
    if (is_inside) {
      test::PlaneJudge judge = second_judge(scene, body, 0.0);
      judge.unsure = 1e-5 * size + 1e-12;
      expect_as(bounded_turning(judge, path[0], path[1]), verified, decided);
    }
    free += verified ? 1 : 0;
    Scene map;
    map.map.emplace().blocked = Bitmap(6, 5);
    for (const bool reverses : {false, true}) {
      const RobotSpec car{.kind = RobotKind::car,
                          .radius = 0.1,
                          .turning_radius = 0.5,
                          .steering = reverses ? SteeringKind::reeds_shepp : SteeringKind::dubins};
      for (const Scene* world : {&scene, &map}) {
        EXPECT_TRUE(!verify_car(*world, car, path, {}, limits.execution).verified || is_inside || world == &map);
      }
    }
  }
  EXPECT_GT(free, seeds.size() / 40);
  EXPECT_GT(decided, test::asks_all() ? seeds.size() / 4 : seeds.size() / 8);
}

TEST(JudgesOfAnyNumber, OfArmsAnswerOrRefuse) {
  const ArmModel model = model_of(puma560_table(0.1), 0.05, false);
  Scene scene;
  scene.spheres.push_back({0.5, 0.5, 0.5, 0.1});
  for (const std::uint64_t seed : test::seeds(legs / 10, 50)) {
    std::vector<JointState> path(2);
    for (std::uint64_t i = 0; i < 2; ++i) {
      path[i].fill(0.0);
      path[i][seed % 6] = any_number(seed, i, 1.0);
    }
    Limits limits;
    const bool verified = verify_arm(scene, model, path, {}, limits.execution).verified;
    for (const JointState& q : path) EXPECT_TRUE(!verified || std::abs(q[seed % 6]) < 10.0);
  }
}

/// A leg that slides and ends far outside: with boxes for its parts this took 13.5 GB.
TEST(JudgesOfAnyNumber, ACarsLegToFarOutsideIsSettledBeforeItIsCutIntoBoxes) {
  Scene scene;
  std::vector<Segment> walls;
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 200;
    const double y = i / 200;
    walls.push_back({{x, y}, {x + 0.5, y}});
  }
  scene.walls = WallSet::narrowest(walls);
  const Se2 path[] = {{5.18, 3.16, -1.36}, {1000.0, -150000.0, 0.387}};
  Limits limits;
  const Verification far = verify_car(scene, {.radius = 0.1, .turning_radius = 0.5}, path, {}, limits.execution);
  EXPECT_FALSE(far.verified);
  EXPECT_EQ(far.first_violation->leg, 0U);
}

}  // namespace
}  // namespace warren::any_number
