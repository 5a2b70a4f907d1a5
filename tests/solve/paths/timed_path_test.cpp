// SPDX-License-Identifier: BSD-3-Clause
#include "solve/paths/timed_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/se2.hpp"
#include "tests/seeds.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Answer of_points(const std::vector<Vec2>& points) {
  Answer answer;
  answer.path.assign(points.begin(), points.end());
  return answer;
}

Answer of_states(RobotKind kind, std::size_t width, const std::vector<std::vector<double>>& states) {
  Answer answer;
  answer.problem.robot.kind = kind;
  answer.states.width = width;
  for (const std::vector<double>& state : states) answer.states.add(state);
  if (kind == RobotKind::polygon) answer.problem.robot.outline = {{-1, -0.5}, {2, -0.5}, {2, 0.5}, {-1, 0.5}};
  if (kind == RobotKind::car) answer.problem.robot.turning_radius = 1.5;
  return answer;
}

/// Random states; of a car the joints of curves between them.
Answer random_answer(RobotKind kind, std::size_t width, std::uint64_t seed) {
  std::vector<std::vector<double>> states;
  std::vector<Se2> poses;
  for (std::uint64_t i = 0; i < 12; ++i) {
    std::vector<double> state;
    for (std::uint64_t k = 0; k < width; ++k) state.push_back((k < 2 ? 10.0 : 3.0) * (uniform(seed, i, k) - 0.5));
    if (i % 4 == 3 && width != 3) {  // straight on, and in the same place
      for (std::size_t k = 0; k < width; ++k) state[k] = states.back()[k] + 0.5 * (states.back()[k] - states[i - 2][k]);
    }
    states.push_back(state);
    if (kind != RobotKind::car) continue;
    const Se2 to{state[0], state[1], state[2]};
    if (poses.empty()) {
      poses.push_back(to);
    } else {
      append_joints(poses, {poses.back(), to, ReedsSheppCurve::shortest(poses.back(), to, 1.5), 1.5});
    }
  }
  if (kind == RobotKind::car) {
    states.clear();
    for (const Se2& pose : poses) states.push_back({pose.x, pose.y, pose.theta});
  }
  return of_states(kind, width, states);
}

struct Named {
  RobotKind kind;
  std::size_t width;
};
constexpr Named timed_bodies[] = {
    {RobotKind::point, 2}, {RobotKind::polygon, 3}, {RobotKind::car, 3}, {RobotKind::arm, 6}};

TravelLimits some_limits() {
  return {.speed = 1.3,
          .acceleration = 0.7,
          .lateral_acceleration = 0.4,
          .joint_speed = {1.0, 0.5, 2.0, 0.9, 1.1, 0.3},
          .joint_acceleration = {0.6, 2.0, 0.5, 0.8, 1.0, 0.2}};
}

TEST(TimedPath, AStraightWayIsATrapezoidOrATriangle) {
  const Answer far = of_points({{0, 0}, {10, 0}});
  const PathLegs far_legs(far);
  EXPECT_NEAR(TimedPath(far_legs, {.speed = 2, .acceleration = 1}, {}).duration_s(), 2 + 3 + 2, 1e-12);
  const Answer near = of_points({{0, 0}, {1, 0}});
  const PathLegs near_legs(near);
  EXPECT_NEAR(TimedPath(near_legs, {.speed = 2, .acceleration = 1}, {}).duration_s(), 2.0, 1e-12);
  EXPECT_NEAR(TimedPath(near_legs, {.speed = 2}, {}).duration_s(), 0.5, 1e-12) << "no ramps";
}

double begin_of(const TimedPath& timed, std::size_t leg) { return timed.at_share(leg, 0.0).time_s; }

TEST(TimedPath, StopsAtCornersAndGoesOnWhereTheWayDoes) {
  const Answer bent = of_points({{0, 0}, {3, 0}, {3, 0}, {10, 0}, {10, 10}});
  const PathLegs legs(bent);
  const TimedPath timed(legs, {.speed = 2, .acceleration = 1}, {});
  EXPECT_NEAR(timed.duration_s(), 7 + 7, 1e-12);
  EXPECT_NEAR(begin_of(timed, 3), 7, 1e-12);
  EXPECT_NEAR(timed.at(7.0).speed, 0.0, 1e-9);
  EXPECT_NEAR(timed.at(3.0).speed, 2.0, 1e-12);
}

TEST(TimedPath, ACarStopsWhereItChangesGearAndSlowsOnArcs) {
  const double half = 0.5 * std::numbers::pi;
  // Ahead, an arc to the left, and straight back.
  const Answer car = of_states(RobotKind::car, 3, {{0, 0, 0}, {10, 0, 0}, {11.5, 1.5, half}, {11.5, -8.5, half}});
  const PathLegs legs(car);
  EXPECT_NEAR(legs.radius(1), 1.5, 1e-12);
  EXPECT_NEAR(legs.length(1), 1.5 * half, 1e-12);
  EXPECT_EQ(legs.gear(1), 1);
  EXPECT_EQ(legs.gear(2), -1);
  const TimedPath timed(legs, {.speed = 2, .acceleration = 1, .lateral_acceleration = 0.5}, {});
  const double on_arc = std::sqrt(0.5 * 1.5);
  EXPECT_NEAR(timed.at(begin_of(timed, 1)).speed, on_arc, 1e-9);
  EXPECT_NEAR(timed.at(begin_of(timed, 2)).speed, 0.0, 1e-9);
  EXPECT_LT(timed.at(begin_of(timed, 2) + 1.0).speed, 0.0) << "backwards";
}

TEST(TimedPath, KeepsItsLimitsAtTenThousandInstants) {
  for (const Named& body : timed_bodies) {
    for (const std::uint64_t seed : test::seeds(3)) {
      const Answer answer = random_answer(body.kind, body.width, seed);
      const PathLegs legs(answer);
      const TravelLimits limits = some_limits();
      const TimedPath timed(legs, limits, {});
      const double step = timed.duration_s() / 1e4;
      double speed_before = 0.0;
      for (int i = 0; i < 10'000; ++i) {
        const PathMoment a = timed.at(i * step);
        const PathMoment b = timed.at((i + 1) * step);
        const PathState from = legs.at(a.leg, a.share);
        const PathState to = legs.at(b.leg, b.share);
        if (body.kind == RobotKind::arm) {
          for (std::size_t k = 0; k < 6; ++k) {
            ASSERT_LE(std::abs(to.numbers[k] - from.numbers[k]), limits.joint_speed.at(k) * step * (1 + 1e-6) + 1e-12);
          }
          continue;
        }
        const double way = std::hypot(to.numbers[0] - from.numbers[0], to.numbers[1] - from.numbers[1]);
        ASSERT_LE(way, limits.speed * step * (1 + 1e-6)) << name_of(body.kind);
        ASSERT_LE(std::abs(b.speed), limits.speed * (1 + 1e-12));
        ASSERT_LE(std::abs(std::abs(b.speed) - std::abs(speed_before)), limits.acceleration * step * (1 + 1e-6) + 1e-9);
        ASSERT_LE(b.speed * b.speed / legs.radius(b.leg), limits.lateral_acceleration * (1 + 1e-9));
        speed_before = b.speed;
      }
      EXPECT_EQ(timed.at(timed.duration_s()).leg, legs.leg_count() - 1);
      EXPECT_NEAR(timed.at(timed.duration_s()).share, 1.0, 1e-9);
    }
  }
}

TEST(TimedPath, SaysTheSameByPlaceAndByTime) {
  for (const Named& body : timed_bodies) {
    const Answer answer = random_answer(body.kind, body.width, 7);
    const PathLegs legs(answer);
    for (const double rate : {0.7, infinite}) {
      TravelLimits limits = some_limits();
      limits.acceleration = rate;
      const TimedPath timed(legs, limits, {});
      for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
        if (!(legs.length(leg) > 1e-6)) continue;
        for (const double share : {0.01, 0.3, 0.5, 0.99}) {
          const PathMoment by_place = timed.at_share(leg, share);
          const PathMoment by_time = timed.at(by_place.time_s);
          EXPECT_EQ(by_time.leg, leg);
          EXPECT_NEAR(by_time.share, share, 1e-7);
          EXPECT_NEAR(by_time.speed, by_place.speed, 1e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace warren
