// SPDX-License-Identifier: BSD-3-Clause
// Cars drive into their places as a driver would, and may be driven so: `bench/car_parks.py` asks the same of the
// program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scenes/files/read_world_io.hpp"
#include "solve/paths/timed_path.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

constexpr TravelLimits limits{.speed = 1.5, .acceleration = 0.8, .lateral_acceleration = 0.6};
constexpr double rounding = 1.0 + 1e-6;

/// From the places alone, at 10,000 even moments.
void expect_limits_kept(const Answer& answer) {
  const PathLegs legs(answer);
  const TimedPath timed(legs, limits, {});
  const double step = timed.duration_s() / 1e4;
  PathMoment before = timed.at(0.0);
  PathState from = legs.at(before.leg, before.share);
  for (int i = 1; i <= 10'000; ++i) {
    const PathMoment now = timed.at(std::min(i * step, timed.duration_s()));
    const PathState to = legs.at(now.leg, now.share);
    const double speed = std::hypot(to.numbers[0] - from.numbers[0], to.numbers[1] - from.numbers[1]) / step;
    const double turn = std::abs(std::remainder(to.numbers[2] - from.numbers[2], 2.0 * M_PI)) / step;
    ASSERT_LE(speed, limits.speed * rounding) << i;
    ASSERT_LE(speed * turn, limits.lateral_acceleration * rounding + 1e-9) << i;
    ASSERT_LE(std::abs(now.speed - before.speed), limits.acceleration * step * rounding + 1e-9) << i;
    before = now;
    from = to;
  }
}

struct Park {
  const char* name;
  std::uint64_t seeds;
};
constexpr Park parks[] = {{"parking", 2}, {"parking-lot", 5}, {"square-place", 5}, {"garage", 5}};  // the first is slow

TEST(CarParks, EachTakesThreeChangesOfGearAtMostAndTheLimitsAreKept) {
  for (const std::uint64_t i : test::seeds(std::size(parks), 2, 0)) {
    const Park& p = parks[i];
    const Scene park = read_world(test::source_dir() + "/examples/worlds/" + p.name + ".scene");
    for (const std::uint64_t seed : test::seeds(p.seeds)) {
      SCOPED_TRACE(p.name + (", seed " + std::to_string(seed)));
      const Answer answer = solve(park, {}, {.seed = seed, .optimise = true});
      ASSERT_EQ(answer.outcome, Outcome::solved);
      EXPECT_TRUE(answer.verified);
      EXPECT_LE(std::get<std::uint64_t>(*figure_named(answer.path_figures, "cusps")), 3U);
      expect_limits_kept(answer);
    }
  }
}

/// Each tree is kept with its two roots once more.
TEST(CarParks, SizesAreThoseOfAllTreesThatWereWeighed) {
  const Scene park = read_world(test::source_dir() + "/examples/worlds/parking-lot.scene");
  ByProducts made;
  const Answer answer = solve(park, {}, {.optimise = true}, {}, &made);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  ASSERT_EQ(made.pose_roadmaps.size(), 4U);
  std::size_t states = 0;
  for (const PlannedRoadmap<Se2>& trees : made.pose_roadmaps) states += trees.states.size() - 2;
  EXPECT_EQ(answer.roadmap.milestones, states);
  EXPECT_EQ(answer.roadmap.edges, states - made.pose_roadmaps.size());
}

}  // namespace
}  // namespace warren
