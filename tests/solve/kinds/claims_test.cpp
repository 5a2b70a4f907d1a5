// SPDX-License-Identifier: BSD-3-Clause
// What is claimed of ends: blocked only where the whole was looked at, the same by every planner.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;

Scene flat() { return read_world(test::source_dir() + "/examples/worlds/flat.yaml"); }

SolveOptions plan_with(PlannerKind planner) { return {.planner = planner}; }

const std::string* word_of(const Answer& answer, std::string_view name) {
  const Figure* figure = figure_named(answer.figures, name);
  return figure == nullptr ? nullptr : std::get_if<std::string>(figure);
}

constexpr PlannerKind disc_planners[] = {PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::voronoi,
                                         PlannerKind::grid};

TEST(Claims, AnEndThatOnlyTouchesIsBlockedWhoeverPlans) {
  const Scene room = scene_of("bounds 0 0 10 10\nwall 5 0 5 6\nrobot disc 0.5\nstart 0.5 0.5\ngoal 9.25 9.25\n");
  const Question on_map{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.2}, .start = {0.5, 0.5}, .goal = {1.0, 0.3}};
  for (const PlannerKind planner : disc_planners) {
    SCOPED_TRACE(name_of(planner));
    const Answer of_scene = solve(room, {}, plan_with(planner));
    EXPECT_EQ(of_scene.outcome, Outcome::start_blocked);
    ASSERT_TRUE(of_scene.blocked.has_value());
    EXPECT_EQ(of_scene.blocked->hint, touching_hint);
    EXPECT_EQ(of_scene.blocked->free_place, (std::vector<double>{0.505, 0.505}));
    EXPECT_EQ(solve(room, {.start = {0.505, 0.505}}, plan_with(planner)).outcome, Outcome::solved);
    const Answer of_map = solve(flat(), on_map, plan_with(planner));
    EXPECT_EQ(of_map.outcome, Outcome::goal_blocked);
    ASSERT_TRUE(of_map.blocked.has_value());
    EXPECT_EQ(of_map.blocked->hint, touching_hint);
  }
}

TEST(Claims, APlaceThatIsOfferedHasFewDigitsAndRoom) {
  const Scene hole = scene_of("bounds 0 0 10 10\npolygon 3 0 4 0 4 5 3 5\nstart 0.5 0.5\ngoal 3 0.5\n");
  for (const PlannerKind planner : disc_planners) {
    const Answer answer = solve(hole, {.goal = std::vector<double>{3.0, 0.0}}, plan_with(planner));
    EXPECT_EQ(answer.outcome, Outcome::goal_blocked) << name_of(planner);
    ASSERT_TRUE(answer.blocked.has_value());
    ASSERT_EQ(answer.blocked->free_place.size(), 2U);
    for (const double x : answer.blocked->free_place) EXPECT_LE(fmt::format("{}", x).size(), 7U) << x;
    const Answer there = solve(hole, {.goal = answer.blocked->free_place}, plan_with(planner));
    EXPECT_EQ(there.outcome, Outcome::solved) << name_of(planner);
  }
}

/// Some polygons and walls anywhere, small or large, near the origin or far from it.
Scene clutter(std::uint64_t seed, double scale, double offset) {
  std::uint64_t index = 0;
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(seed, index++, 0); };
  const auto place = [&](double x, double y) { return fmt::format(" {} {}", offset + scale * x, offset + scale * y); };
  std::string text = "bounds" + place(0, 0) + place(20, 20) + '\n';
  for (int i = 0; i < 12; ++i) {
    const double x = between(1, 17);
    const double y = between(1, 17);
    const double turn = between(0, 1.5);
    const double size = between(0.3, 2.0);
    if (i % 4 == 3) {
      text += "wall" + place(x, y) + place(x + size, y + turn) + '\n';
      continue;
    }
    text += "polygon";
    for (int k = 0; k < 4; ++k) {
      const double angle = turn + k * std::numbers::pi / 2;
      text += place(x + size * std::cos(angle), y + size * std::sin(angle));
    }
    text += '\n';
  }
  return scene_of(text);
}

TEST(Claims, PlacesThatAreOfferedAreTakenByEveryPlannerOfTheBody) {
  std::size_t offered = 0;
  std::size_t taken = 0;
  for (const std::uint64_t seed : test::seeds(2)) {
    const double scale = std::array{1.0, 0.01, 30.0}[seed % 3];
    const double offset = std::array{0.0, 1e3, 5e5, -4.2e6}[seed % 4];
    const Scene scene = clutter(seed, scale, offset);
    const double r = 0.4 * scale;
    const RobotSpec bodies[] = {
        {},
        {.kind = RobotKind::disc, .radius = r},
        {.kind = RobotKind::polygon, .outline = {{-r, -r / 3}, {1.5 * r, -r / 3}, {r, r / 2}, {-r, r / 2}}},
        {.kind = RobotKind::car, .radius = r, .turning_radius = 2 * r}};
    for (const RobotSpec& body : bodies) {
      const bool turns = body.kind == RobotKind::polygon || body.kind == RobotKind::car;
      for (std::uint64_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(fmt::format("seed {} body {} {}", seed, name_of(body.kind), i));
        const auto state = [&](std::uint64_t axis) {
          std::vector<double> place;
          for (const std::uint64_t k : {0U, 1U}) place.push_back(offset + 20 * scale * uniform(seed, i, axis + k));
          if (turns) place.push_back(6 * uniform(seed, i, axis + 2) - 3);
          return place;
        };
        Question question{.robot = body, .start = state(10), .goal = state(20)};
        SolveOptions options = plan_with(PlannerKind::rrt_connect);
        options.trees.nodes = 20;
        if (!turns) options = {.planner = PlannerKind::prm, .roadmap = {.samples = 20}};
        const Answer answer = solve(scene, question, options);
        if (!answer.blocked || answer.blocked->free_place.empty()) continue;
        ++offered;
        const bool is_start = answer.outcome == Outcome::start_blocked;
        (is_start ? question.start : question.goal) = answer.blocked->free_place;
        for (const PlannerKind planner : all_planners) {
          if (turns && planner == PlannerKind::grid) continue;  // its layers of headings take a second each
          SolveOptions there = plan_with(planner);
          if (planner == PlannerKind::rrt || planner == PlannerKind::rrt_connect) there.trees.nodes = 20;
          if (planner == PlannerKind::prm || planner == PlannerKind::lazy_prm) there.roadmap.samples = 20;
          if (gets_better(planner)) there.anytime.iterations = 2;
          try {
            const Answer again = solve(scene, question, there);
            EXPECT_NE(again.outcome, answer.outcome) << name_of(planner);
            ++taken;
          } catch (const Error&) {  // no planner of this body or world
          }
        }
      }
    }
  }
  EXPECT_GT(offered, test::share(4, 1));
  EXPECT_GT(taken, 2 * offered);
}

/// A slot at an angle, of that width, for a body 0.4 high and 2 long.
Scene slot(double degrees, double width) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vec2 along{std::cos(angle), std::sin(angle)};
  const Vec2 across{-along.y, along.x};
  std::string text = "bounds 0 0 20 20\nrobot polygon -1 -0.2 1 -0.2 1 0.2 -1 0.2\nstart 4 8 0\ngoal 14 10\n";
  for (const double side : {-0.5 * width, 0.5 * width}) {
    const Vec2 a = Vec2{14, 10} + side * across - 1.6 * along;
    const Vec2 b = Vec2{14, 10} + side * across + 1.6 * along;
    text += "wall " + std::to_string(a.x) + ' ' + std::to_string(a.y) + ' ' + std::to_string(b.x) + ' ' +
            std::to_string(b.y) + '\n';
  }
  return scene_of(text);
}

TEST(Claims, AGoalWithoutAHeadingIsMetBetweenTheHeadingsThatAreTriedFirst) {
  for (const double degrees : {11.25, 33.0, 101.0, 250.0, 349.0}) {
    EXPECT_EQ(solve(slot(degrees, 0.6)).outcome, Outcome::solved) << degrees;
    const Answer narrow = solve(slot(degrees, 0.39));
    EXPECT_EQ(narrow.outcome, Outcome::goal_blocked) << degrees;
    SolveOptions few = plan_with(PlannerKind::rrt_connect);
    few.trees.nodes = 50;
    EXPECT_NE(solve(slot(degrees, 0.4 + 1e-5), {}, few).outcome, Outcome::goal_blocked) << degrees;
    ASSERT_TRUE(narrow.blocked.has_value());
    EXPECT_NE(narrow.blocked->hint.find("no heading"), std::string::npos) << narrow.blocked->hint;
  }
  for (const PlannerKind planner : {PlannerKind::visibility, PlannerKind::cells, PlannerKind::grid}) {
    EXPECT_NE(solve(slot(11.25, 0.6), {}, plan_with(planner)).outcome, Outcome::goal_blocked) << name_of(planner);
  }
  const Answer by_disc = solve(slot(11.25, 0.6), {}, plan_with(PlannerKind::voronoi));
  EXPECT_EQ(by_disc.outcome, Outcome::not_connected);
  ASSERT_NE(word_of(by_disc, "cause"), nullptr);
  EXPECT_EQ(*word_of(by_disc, "cause"), "disc_blocked_at_goal");
}

TEST(Claims, InTheOpenNothingTurnsForAGoalWithoutAHeading) {
  const Scene open = scene_of("bounds 0 0 20 20\nrobot polygon -1 -0.2 1 -0.2 1 0.2 -1 0.2\nwall 1 19 2 19\n");
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt_connect}) {
    const Answer answer = solve(open, {.start = {3.0, 3.0, -0.4275}, .goal = {16.0, 5.0}}, plan_with(planner));
    ASSERT_EQ(answer.outcome, Outcome::solved) << name_of(planner);
    EXPECT_EQ(answer.turn_rad, 0.0) << name_of(planner);
  }
}

TEST(Claims, APlaceOfTheToolIsMetByWhateverWristReachesIt) {
  const std::string arm = "robot puma560 radius 0.03 tool 0.5 limits classic\nstart 0 0 0 0 0 0\n";
  EXPECT_EQ(solve(scene_of(arm + "sphere 5 5 5 0.1\ngoal -0.059 0.09 0.758\n")).outcome, Outcome::solved);
  const Answer far = solve(scene_of(arm + "sphere 5 5 5 0.1\ngoal 2 0 0\n"));
  EXPECT_EQ(far.outcome, Outcome::goal_blocked);
  EXPECT_EQ(*word_of(far, "cause"), "goal_out_of_reach");
  const Answer within = solve(scene_of(arm + "sphere 0.5 0.2 0.3 0.1\ngoal 0.5 0.2 0.32\n"));
  EXPECT_EQ(within.outcome, Outcome::goal_blocked) << "the tip itself is in it";
  EXPECT_EQ(*word_of(within, "cause"), "goal_in_collision");
}

TEST(Claims, WherePosturesAreTriedInVainNothingIsClaimed) {
  // The place is in a small closed room.
  Answer answer =
      solve(scene_of("robot puma560 radius 0.02 tool 0.3 limits classic\nstart 0 0 0 0 0 0\ngoal 0.5 0.2 0.3\n"
                     "box 0.4 0.1 0.2 0.42 0.3 0.4\nbox 0.58 0.1 0.2 0.6 0.3 0.4\n"
                     "box 0.4 0.1 0.2 0.6 0.12 0.4\nbox 0.4 0.28 0.2 0.6 0.3 0.4\n"
                     "box 0.4 0.1 0.2 0.6 0.3 0.22\nbox 0.4 0.1 0.38 0.6 0.3 0.4\n"),
            {}, plan_with(PlannerKind::prm));
  EXPECT_EQ(answer.outcome, Outcome::not_connected);
  EXPECT_EQ(*word_of(answer, "cause"), "goal_not_found");
  const Figure* tried = figure_named(answer.figures, "goals_tried");
  ASSERT_NE(tried, nullptr);
  EXPECT_GT(std::get<std::uint64_t>(*tried), 1000U);
  const SolveOptions options = plan_with(PlannerKind::prm);
  for (const Hint& hint : hints_for(Scene(), {.options = options}, answer)) {
    EXPECT_FALSE(std::ranges::count(hint.words, "--samples")) << "nothing was drawn";
  }
}

TEST(Claims, TheGapOfASkeletonIsWhereItLiesInTheWorld) {
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.34}, .start = {0.5, 0.5}, .goal = {4.3, 0.5}};
  const Answer answer = solve(flat(), question, plan_with(PlannerKind::voronoi));
  ASSERT_EQ(answer.outcome, Outcome::not_connected);
  const auto& [from, to] = std::pair{answer.separation.near_start, answer.separation.near_goal};
  EXPECT_NEAR(std::hypot(to[0] - from[0], to[1] - from[1]), answer.separation.nearest_gap, 1e-9);
  EXPECT_LT(std::max(from[0], to[0]), 4.8) << "as wide as the map is";
}

TEST(Claims, AGoalThatIsTheStartIsReachedByEveryPlannerWithoutAMove) {
  std::map<PlannerKind, std::size_t> reached;
  const std::pair<Scene, double> worlds[] = {{clutter(1, 1.0, 0.0), 1.0}, {flat(), 0.3}};
  for (const auto& [scene, scale] : worlds) {
    const double r = 0.5 * scale;
    const RobotSpec bodies[] = {
        {},
        {.kind = RobotKind::disc, .radius = 1.5 * r},
        {.kind = RobotKind::polygon, .outline = {{-r, -r}, {2 * r, -r}, {r, r}}},
        {.kind = RobotKind::car, .radius = r, .turning_radius = 4 * r},
        {.kind = RobotKind::car, .radius = r, .turning_radius = 4 * r, .steering = SteeringKind::reeds_shepp}};
    for (const RobotSpec& body : bodies) {
      const bool turns = body.kind == RobotKind::polygon || body.kind == RobotKind::car;
      for (std::uint64_t i = 0; i < test::share(6, 3); ++i) {
        std::vector<double> place{scale * (1 + 10 * uniform(9, i, 0)), scale * (1 + 9 * uniform(9, i, 1))};
        if (turns) place.push_back(uniform(9, i, 2));
        for (const PlannerKind planner : all_planners) {
          if (turns && planner == PlannerKind::grid && i > 0) continue;  // its layers of headings take long
          SCOPED_TRACE(fmt::format("{} {} {} {}", scale, name_of(body.kind), name_of(planner), fmt::join(place, ",")));
          SolveOptions options = plan_with(planner);
          if (planner == PlannerKind::rrt || planner == PlannerKind::rrt_connect) options.trees.nodes = 20;
          if (planner == PlannerKind::prm || planner == PlannerKind::lazy_prm) options.roadmap.samples = 20;
          if (turns && planner == PlannerKind::grid) options.grid.angles = 8;
          try {
            const Answer answer = solve(scene, {.robot = body, .start = place, .goal = place}, options);
            if (answer.outcome == Outcome::start_blocked) break;  // for every planner, and to tell why takes long
            ++reached[planner];
            EXPECT_EQ(answer.outcome, Outcome::solved);
            EXPECT_TRUE(answer.verified);
            EXPECT_EQ(answer.length, 0.0);
          } catch (const UsageError&) {  // no planner of this body or world
          } catch (const InputError&) {  // nor of polygons that overlap
          }
        }
      }
    }
  }
  for (const PlannerKind planner : all_planners) EXPECT_GT(reached[planner], 0U) << name_of(planner);
}

/// A disc that starts on water may stay there; the disc that holds a polygon is none.
TEST(Claims, APolygonOnWaterIsBlockedWhoeverPlans) {
  const TemporaryDirectory folder;
  const Scene scene =
      read_world(folder.write("w.map", "type octile\nheight 5\nwidth 5\nmap\nWWWWW\nWWWWW\nWWWWW\nWWWWW\nWWWWW\n"));
  const RobotSpec robot{.kind = RobotKind::polygon, .outline = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}}};
  const Question question{.robot = robot, .start = {1.5, 2.5, 0.0}, .goal = {3.5, 2.5, 0.0}};
  for (const PlannerKind planner :
       {PlannerKind::voronoi, PlannerKind::lazy_prm, PlannerKind::rrt_connect, PlannerKind::anytime}) {
    EXPECT_EQ(solve(scene, question, plan_with(planner)).outcome, Outcome::start_blocked) << name_of(planner);
  }
}

}  // namespace
}  // namespace warren
