// SPDX-License-Identifier: BSD-3-Clause
// Lower bounds are none that a path goes below, do not depend on where and how a world lies, and are told where they
// mean something.
#include "solve/kinds/solve_steps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/se2.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// Numbers of one seed, one after the other.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * uniform(seed_, index_++, 0); }

 private:
  std::uint64_t seed_;
  std::uint64_t index_ = 0;
};

/// How a world is laid: x and y of it where x, y were.
using Laid = std::function<Vec2(Vec2)>;
Vec2 as_it_is(Vec2 p) { return p; }

/// Some quadrangles and walls in a square of 20.
Scene bounded_clutter(std::uint64_t seed, const Laid& laid = as_it_is) {
  Draws draw(seed);
  Scene scene;
  scene.source = "clutter";
  std::vector<Segment> walls;
  for (int i = 0; i < 9; ++i) {
    const Vec2 middle{draw(3, 17), draw(1, 19)};
    const double turn = draw(0, 6);
    const double size = draw(0.5, 3.5);
    const auto corner = [&](double angle, double r) {
      return laid(middle + r * Vec2{std::cos(angle), std::sin(angle)});
    };
    if (i % 3 == 2) {
      walls.push_back({corner(turn, size), corner(turn + std::numbers::pi, size)});
      continue;
    }
    ScenePolygon polygon;
    for (int k = 0; k < 4; ++k) polygon.corners.push_back(corner(turn + 1.5 * k, size * draw(0.6, 1.0)));
    scene.polygons.push_back(std::move(polygon));
  }
  scene.walls = WallSet::narrowest(walls);
  Box box;
  box.include(laid({0, 0}));
  box.include(laid({20, 20}));
  scene.bounds = box;
  return scene;
}

std::vector<RobotSpec> bodies() {
  const std::vector<Vec2> bar{{-1.0, -0.3}, {1.4, -0.3}, {1.4, 0.3}, {-1.0, 0.3}};
  const std::vector<Vec2> held_elsewhere{{0.2, -0.2}, {1.2, -0.2}, {1.2, 0.2}, {0.2, 0.2}};
  return {{},
          {.kind = RobotKind::disc, .radius = 0.4},
          {.kind = RobotKind::polygon, .outline = bar},
          {.kind = RobotKind::polygon, .outline = held_elsewhere},
          {.kind = RobotKind::car, .radius = 0.3, .turning_radius = 1.5},
          {.kind = RobotKind::car, .turning_radius = 1.0, .outline = bar, .steering = SteeringKind::reeds_shepp}};
}

Question asked_of(const RobotSpec& body, std::uint64_t seed) {
  Draws draw(seed + 1000);
  Question question{.robot = body, .start = {draw(0.5, 3), draw(1, 19)}, .goal = {draw(17, 19.5), draw(1, 19)}};
  if (state_size(body) == 3) question.start.push_back(draw(-3, 3));
  if (state_size(body) == 3 && seed % 3 != 0) question.goal.push_back(draw(-3, 3));
  if (seed % 4 == 0) question.clearance = 0.1;
  return question;
}

std::vector<SolveOptions> ways_to_solve(const RobotSpec& body) {
  std::vector<SolveOptions> ways;
  const bool turns = state_size(body) == 3;
  const auto add = [&](SolveOptions options) {
    options.bound = true;
    ways.push_back(std::move(options));
  };
  // One round where bodies turn: what can't be reached lets roadmaps grow to 64 times the usual, for many minutes.
  add({.planner = PlannerKind::lazy_prm, .optimise = true});
  if (turns) ways.back().roadmap.samples = 3000;
  add({.planner = PlannerKind::prm, .optimise = true, .roadmap = {.samples = 300}});
  if (turns) add({.planner = PlannerKind::rrt_connect, .optimise = true, .trees = {.nodes = 5000}});
  add({.planner = PlannerKind::anytime, .anytime = {.iterations = 5}});
  if (turns) add({.planner = PlannerKind::rrt_connect, .seed = 2, .optimise = true, .trees = {.nodes = 5000}});
  if (!turns) add({.planner = PlannerKind::voronoi});
  if (!turns) add({.planner = PlannerKind::visibility});
  if (body.kind == RobotKind::point) add({.planner = PlannerKind::cells});
  return ways;
}

/// Of a path in the metric of the body that turns.
double metric_cost(const Answer& answer, double weight) {
  double sum = 0.0;
  const std::vector<Se2> poses = poses_of(answer.states);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double turn = weight * turn_between(poses[i - 1].theta, poses[i].theta);
    sum += std::hypot(poses[i].x - poses[i - 1].x, poses[i].y - poses[i - 1].y, turn);
  }
  return sum;
}

/// Whoever solves it, and at whatever cost: the bounds are the same, and none is above.
std::size_t expect_none_below(const Scene& scene, const Question& question, const std::vector<SolveOptions>& ways) {
  std::size_t solved = 0;
  for (const SolveOptions& options : ways) {
    SCOPED_TRACE(name_of(*options.planner));
    Answer answer;
    try {
      answer = solve(scene, question, options, {});
    } catch (const Error&) {  // overlapping polygons, of planners that take none, and clearances
      continue;
    }
    if (!answer.verified) {
      EXPECT_FALSE(answer.lower_bound.has_value());
      continue;
    }
    ++solved;
    EXPECT_TRUE(answer.lower_bound.has_value());
    if (!answer.lower_bound) continue;
    const double cost = answer.cost.value_or(answer.length);
    EXPECT_LE(*answer.lower_bound, cost * (1.0 + 1e-13));
    if (options.planner != PlannerKind::visibility) {  // whose polyline is around the arcs of a disc
      EXPECT_EQ(answer.optimal, cost - *answer.lower_bound <= 1e-9 * cost);
    }
    const auto bound = [&](BoundOf of, BoundEffort effort) {
      return proved_bound(scene, answer.problem, of, effort, Execution{});
    };
    const double of_length = bound(BoundOf::length, BoundEffort::exact);
    const double of_metric = bound(BoundOf::metric, BoundEffort::exact);
    EXPECT_LE(bound(BoundOf::length, BoundEffort::simple), of_length);
    EXPECT_LE(of_length, answer.length * (1.0 + 1e-13));
    EXPECT_GE(of_metric, of_length * (1.0 - 1e-12));
    if (answer.problem.robot.kind == RobotKind::polygon) {
      EXPECT_LE(of_metric, metric_cost(answer, extent_of(answer.problem.robot)));
    }
    if (!answer.optimal) {
      EXPECT_EQ(*answer.lower_bound, answer.cost ? of_metric : of_length);
    }
    EXPECT_TRUE(verify(scene, answer).verified);
    EXPECT_NE(verify(scene, answer).bound, BoundVerdict::absent);
  }
  return solved;
}

TEST(LowerBound, NoPathOfAnyPlannerAmongObstaclesIsBelow) {
  std::size_t solved = 0;
  for (const std::uint64_t seed : test::seeds(100, 100)) {
    if (!test::asks_all() && solved > 5) break;  // by day until there is enough: in some worlds nothing is solved
    const Scene scene = bounded_clutter(seed);
    std::size_t number = 0;
    for (const RobotSpec& body : bodies()) {
      SCOPED_TRACE(fmt::format("seed {} body {}", seed, number++));
      solved += expect_none_below(scene, asked_of(body, seed), ways_to_solve(body));
    }
  }
  EXPECT_GT(solved, test::asks_all() ? 1000U : 5U);
}

TEST(LowerBound, NoPathOnAMapIsBelow) {
  std::size_t solved = 0;
  std::size_t around = 0;
  for (const std::uint64_t seed : test::seeds(100, 3)) {
    Draws draw(seed);
    OccupancyMap map;
    map.cell = seed % 2 == 0 ? 0.05 : 1.0;
    map.origin = {draw(-9, 9), draw(-9, 9)};
    map.blocked = Bitmap(24, 18);
    for (std::uint32_t y = 0; y < 18; ++y) {
      for (std::uint32_t x = 3; x < 21; ++x) {
        if (draw(0, 1) < 0.3) map.blocked.set(x, y);
      }
    }
    Scene scene;
    scene.source = "map";
    scene.map = map;
    const Vec2 start = world_point(map, {1.5, draw(1, 17)});
    const Vec2 goal = world_point(map, {22.5, draw(1, 17)});
    for (const double radius : {0.0, 0.3, 0.45}) {
      SCOPED_TRACE(fmt::format("seed {} radius {}", seed, radius));
      const RobotSpec body{.kind = RobotKind::disc, .radius = radius * map.cell};
      const Question question{.robot = body, .start = {start.x, start.y}, .goal = {goal.x, goal.y}};
      std::vector<SolveOptions> ways{{.planner = PlannerKind::lazy_prm, .optimise = true, .bound = true},
                                     {.planner = PlannerKind::rrt_connect, .optimise = true, .bound = true},
                                     {.planner = PlannerKind::voronoi, .bound = true}};
      ways[1].trees.nodes = 5000;
      solved += expect_none_below(scene, question, ways);
      const Answer answer = solve(scene, question, ways.front());
      if (answer.lower_bound && *answer.lower_bound > distance(start, goal) * 1.001) ++around;
      const RobotSpec bar{.kind = RobotKind::polygon,
                          .outline = {{-radius * map.cell, -0.2 * map.cell},
                                      {0.6 * map.cell, -0.2 * map.cell},
                                      {0.6 * map.cell, 0.2 * map.cell},
                                      {-radius * map.cell, 0.2 * map.cell}}};
      const Question turning{.robot = bar, .start = {start.x, start.y, 0.1}, .goal = {goal.x, goal.y}};
      solved += expect_none_below(scene, turning, {ways[1]});
    }
  }
  EXPECT_GT(solved, test::share(250, 5));
  EXPECT_GT(around, test::share(30, 0));
}

TEST(LowerBound, NoPathOfAnArmIsBelow) {
  const Scene scene = read_world(test::source_dir() + "/tests/data/nine-spheres.scene");
  std::size_t solved = 0;
  for (const std::uint64_t seed : test::seeds(100, 24)) {
    SCOPED_TRACE(seed);
    Draws draw(seed);
    Question question;
    question.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.03, .tool = 0.1};
    for (int j = 0; j < 6; ++j) question.start.push_back(draw(-1.5, 1.5));
    for (int j = 0; j < 6; ++j) question.goal.push_back(draw(-1.5, 1.5));
    if (seed % 2 == 0) question.goal = {draw(-0.5, 0.5), draw(-0.5, 0.5), draw(0.2, 0.9)};
    std::vector<SolveOptions> ways{{.planner = PlannerKind::rrt_connect, .optimise = true, .bound = true}};
    ways.front().trees.nodes = 3000;
    solved += expect_none_below(scene, question, ways);
  }
  EXPECT_GT(solved, 0U);
}

TEST(LowerBound, IsTheSameHoweverTheWorldLies) {
  const Laid mirrored = [](Vec2 p) { return Vec2{-p.x, p.y}; };
  const Laid turned = [](Vec2 p) { return Vec2{-p.y, p.x}; };
  const Laid shifted = [](Vec2 p) { return p + Vec2{64.0, -32.0}; };
  const Laid larger = [](Vec2 p) { return 8.0 * p; };
  for (const std::uint64_t seed : test::seeds(100, 30)) {
    SCOPED_TRACE(seed);
    const auto bound = [&](const Laid& laid, double scale) {
      const Question asked = asked_of({.kind = RobotKind::disc, .radius = 0.2}, seed);
      const Vec2 start = laid({asked.start[0], asked.start[1]});
      const Vec2 goal = laid({asked.goal[0], asked.goal[1]});
      const Problem problem{{.kind = RobotKind::disc, .radius = 0.2 * scale}, {start.x, start.y}, {goal.x, goal.y}};
      return proved_bound(bounded_clutter(seed, laid), problem, BoundOf::length, BoundEffort::exact, Execution{}) /
             scale;
    };
    const double plain = bound(as_it_is, 1.0);
    EXPECT_NEAR(bound(mirrored, 1.0), plain, 1e-12 * plain);
    EXPECT_NEAR(bound(turned, 1.0), plain, 1e-12 * plain);
    EXPECT_NEAR(bound(shifted, 1.0), plain, 1e-12 * plain);
    EXPECT_NEAR(bound(larger, 8.0), plain, 1e-12 * plain);
  }
}

Scene one_wall() {
  const TemporaryDirectory folder;
  return read_world(folder.write("w.scene", "bounds 0 0 10 10\nwall 5 0 5 6\n"));
}

TEST(LowerBound, SaysOfAStraightWayThatItIsTheShortest) {
  const Question open{.start = {1, 8}, .goal = {9, 8}};
  const Answer straight = solve(one_wall(), open, {.planner = PlannerKind::lazy_prm, .optimise = true});
  EXPECT_TRUE(straight.optimal);
  EXPECT_NEAR(straight.lower_bound.value(), 8.0, 1e-12);
  EXPECT_LE(straight.lower_bound.value(), 8.0);
  EXPECT_NEAR(gap_of(straight).value(), 0.0, 1e-12);
  const Answer around = solve(one_wall(), {.start = {1, 2}, .goal = {9, 2}}, {.planner = PlannerKind::lazy_prm});
  EXPECT_FALSE(around.optimal);
  EXPECT_NEAR(around.lower_bound.value(), 8.0, 1e-12);
  EXPECT_NEAR(gap_of(around).value(), around.length / 8.0 - 1.0, 1e-12);
  const Answer proved =
      solve(one_wall(), {.start = {1, 2}, .goal = {9, 2}}, {.planner = PlannerKind::lazy_prm, .bound = true});
  EXPECT_NEAR(proved.lower_bound.value(), 2.0 * std::hypot(4.0, 4.0), 1e-9);
  const Answer here = solve(one_wall(), {.start = {1, 8}, .goal = {1, 8}}, {.planner = PlannerKind::lazy_prm});
  EXPECT_EQ(here.lower_bound, 0.0);
  EXPECT_EQ(gap_of(here), 0.0);
}

TEST(LowerBound, CountsWhatABodyMustTurn) {
  const Scene scene = one_wall();
  Problem problem{bodies()[2], {1, 8, 0}, {5, 8, 3}};
  const auto bound = [&](BoundOf of) { return proved_bound(scene, problem, of, BoundEffort::exact, Execution{}); };
  const double reach = std::hypot(1.4, 0.3);
  EXPECT_NEAR(bound(BoundOf::length), 4.0, 1e-9);
  EXPECT_NEAR(bound(BoundOf::metric), std::hypot(4.0, 3.0 * reach), 1e-9);
  problem.goal[2] = 2.0 * std::numbers::pi;
  EXPECT_NEAR(bound(BoundOf::metric), 4.0, 1e-9);
  problem.goal.pop_back();
  EXPECT_NEAR(bound(BoundOf::metric), 4.0, 1e-9);
}

TEST(LowerBound, OfABodyThatIsElsewhereThanItsReferencePointIsTheStraightLine) {
  const Scene scene = one_wall();
  Problem problem{bodies()[2], {1, 2, 0}, {9, 2, 0}};
  const auto bound = [&] { return proved_bound(scene, problem, BoundOf::length, BoundEffort::exact, Execution{}); };
  EXPECT_GT(bound(), 11.0);
  problem.robot = bodies()[3];
  EXPECT_NEAR(bound(), 8.0, 1e-9);
}

TEST(LowerBound, IsTheSimpleOneWhereTimeEnds) {
  const Deadline ended(0.0);
  const Execution execution{.deadline = &ended};
  const Problem problem{{}, {1, 2}, {9, 2}};
  EXPECT_NEAR(proved_bound(one_wall(), problem, BoundOf::length, BoundEffort::exact, execution), 8.0, 1e-12);
}

TEST(LowerBound, IsNotToldOfOtherUnitsOrWayPoints) {
  const Question question{.start = {1, 2}, .goal = {9, 2}};
  const Answer cells = solve(one_wall(), question, {.planner = PlannerKind::grid});
  EXPECT_TRUE(cells.verified && cells.cost);
  EXPECT_FALSE(cells.lower_bound || gap_of(cells));
  Question turning{.robot = bodies()[2], .start = {2, 2, 0}, .goal = {8, 2, 0}};
  SolveOptions via{.planner = PlannerKind::rrt_connect};
  EXPECT_TRUE(solve(one_wall(), turning, via).lower_bound);
  via.trees.via = {{2, 8, 0}};
  const Answer passing = solve(one_wall(), turning, via);
  EXPECT_TRUE(passing.verified);
  EXPECT_FALSE(passing.lower_bound);
}

TEST(LowerBound, IsRefutedWhereItIsTooHigh) {
  const Scene scene = one_wall();
  const Question question{.start = {1, 2}, .goal = {9, 2}};
  const Answer shortest = solve(scene, question, {.planner = PlannerKind::visibility});
  EXPECT_TRUE(shortest.optimal);
  EXPECT_EQ(verify(scene, shortest).bound, BoundVerdict::checked);
  Answer longer = solve(scene, question, {.planner = PlannerKind::voronoi, .bound = true});
  EXPECT_NEAR(longer.lower_bound.value(), shortest.length, 1e-9);
  EXPECT_EQ(verify(scene, longer).bound, BoundVerdict::checked);
  longer.lower_bound = shortest.length * (1.0 + 1e-6);
  const Verdict above = verify(scene, longer);
  EXPECT_EQ(above.bound, BoundVerdict::refuted);
  EXPECT_FALSE(above.verified);
  ASSERT_TRUE(above.first_violation.has_value());
  EXPECT_TRUE(above.first_violation->obstacle.starts_with("lower_bound: "));
  longer.lower_bound = longer.length * 1.001;
  EXPECT_EQ(verify(scene, longer).bound, BoundVerdict::refuted);
  Answer disc = solve(scene, {.robot = bodies()[1], .start = {1, 2}, .goal = {9, 2}},
                      {.planner = PlannerKind::lazy_prm, .optimise = true});
  disc.lower_bound = disc.length * (1.0 - 1e-6);
  EXPECT_EQ(verify(scene, disc).bound, BoundVerdict::unchecked);
}

}  // namespace
}  // namespace warren
