// SPDX-License-Identifier: BSD-3-Clause
// Cars that must go around walls drive as far 10^3 to 10^7 from the origin as at it, up to the rounding of coordinates:
// what rounding alone decides (ties, gains and pieces of no length to speak of) must not steer what is shortened.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/rng.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

struct Yard {
  Scene scene;
  Question question;
};

/// The same yard, so much farther away.
Yard yard(std::uint64_t seed, SteeringKind steering, Vec2 offset) {
  constexpr double side = 18.0;
  const auto thousandths = [](double x) { return std::round(1000.0 * x) / 1000.0; };
  const auto number = [&](std::uint64_t i, std::uint64_t axis, double low, double high) {
    return thousandths(low + (high - low) * uniform(seed, i, axis));
  };
  const auto pose = [&](std::uint64_t i) {
    return Se2{number(i, 0, 1.0, 17.0), number(i, 1, 1.0, 17.0), number(i, 2, -3.14, 3.14)};
  };
  const Se2 start = pose(0);
  const Se2 goal = pose(1);
  Yard yard;
  yard.scene.bounds = Box{offset, offset + Vec2{side, side}};
  std::vector<Segment> walls;
  for (std::uint64_t i = 10; i < 16; ++i) {
    const Vec2 a{number(i, 0, 2.0, 16.0), number(i, 1, 2.0, 16.0)};
    const Vec2 b = a + Vec2{number(i, 2, -3.0, 3.0), number(i, 3, -3.0, 3.0)};
    const bool is_near = std::min({distance(a, start.position()), distance(b, start.position()),
                                   distance(0.5 * (a + b), start.position()), distance(a, goal.position()),
                                   distance(b, goal.position()), distance(0.5 * (a + b), goal.position())}) < 1.5;
    if (!is_near) walls.push_back({offset + a, offset + b});
  }
  yard.scene.walls = WallSet::narrowest(walls);
  constexpr double radii[] = {0.2, 0.5, 1.0, 1.5, 3.0};
  yard.question = {
      .robot =
          RobotSpec{.kind = RobotKind::car, .radius = 0.3, .turning_radius = radii[seed % 5], .steering = steering},
      .start = {offset.x + start.x, offset.y + start.y, start.theta},
      .goal = {offset.x + goal.x, offset.y + goal.y, goal.theta}};
  return yard;
}

void expect_as_long_anywhere(SteeringKind steering) {
  std::size_t arrived = 0;
  for (const std::uint64_t seed : test::seeds(40, 4)) {
    const auto solved = [&](Vec2 offset) {
      const Yard there = yard(seed, steering, offset);
      SolveOptions options{.seed = seed, .optimise = true};
      options.trees.nodes = 1000;
      return solve(there.scene, there.question, options, {.threads = 1});
    };
    const Answer near = solved({});
    if (near.outcome != Outcome::solved) continue;
    ++arrived;
    for (const Vec2 offset : {Vec2{1e3, -1e3}, Vec2{388096, 3948996}, Vec2{1e7, -1e7}}) {
      SCOPED_TRACE(testing::Message() << seed << " at " << offset.x);
      const Answer far = solved(offset);
      EXPECT_EQ(far.outcome, near.outcome);
      const double rounding = 1e-9 + 100.0 * std::numeric_limits<double>::epsilon() * norm(offset);
      EXPECT_NEAR(far.length, near.length, rounding * (1.0 + near.length));
    }
  }
  EXPECT_GE(arrived, test::share(20, 1));
}

TEST(CarsFarAway, ThatGoForwardsDriveAsFarAsAtTheOrigin) { expect_as_long_anywhere(SteeringKind::dubins); }
TEST(CarsFarAway, ThatReverseDriveAsFarAsAtTheOrigin) { expect_as_long_anywhere(SteeringKind::reeds_shepp); }

}  // namespace
}  // namespace warren
