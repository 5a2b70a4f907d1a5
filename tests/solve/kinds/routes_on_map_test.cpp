// SPDX-License-Identifier: BSD-3-Clause
// Alternatives, routes that are kept, and bounds of all paths, as solve() answers them on maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/solve.hpp"
#include "tests/planners/grid/class_oracle.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"
#include "verify/judges/verify_classes.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

using test::scene_of;

/// Blocks as wide and high as that, one every `every` cells, off the border.
Bitmap blocks(std::uint32_t width, std::uint32_t height, std::uint32_t every, std::uint32_t size) {
  Bitmap blocked(width, height);
  for (std::uint32_t y = every / 2; y + size < height; y += every) {
    for (std::uint32_t x = every / 2; x + size < width; x += every) {
      for (std::uint32_t row = 0; row < size; ++row) blocked.set_run(y + row, x, x + size);
    }
  }
  return blocked;
}

SolveOptions by_grid() {
  SolveOptions options;
  options.planner = PlannerKind::grid;
  return options;
}

double length_of(const Path<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

void expect_alternatives(const Scene& scene, const Question& question, std::size_t least) {
  const Answer answer = solve(scene, question, by_grid());
  ASSERT_TRUE(answer.verified);
  ASSERT_GE(answer.alternatives.size(), least);
  ASSERT_LE(answer.alternatives.size(), *question.route.alternatives);
  const double stretch = question.route.stretch.value_or(1.5);
  const double reach = answer.problem.robot.radius + answer.problem.clearance;
  std::vector<Path<Vec2>> paths{answer.path};
  std::set<std::vector<std::int32_t>> classes{answer.passed};
  double before = answer.price ? *answer.cost : answer.length;
  const double best = before;
  std::set<std::uint32_t> told;
  for (const MapHole& hole : answer.holes) told.insert(hole.id);
  for (const AlternativePath& path : answer.alternatives) {
    const VerifyOptions options{.clearance = reach,
                                .start = Vec2{question.start[0], question.start[1]},
                                .goal = Vec2{question.goal[0], question.goal[1]}};
    EXPECT_TRUE(verify_on_map(*scene.map, path.path, options, {}).verified);
    EXPECT_NEAR(path.length, length_of(path.path), 1e-9 * path.length);
    EXPECT_NEAR(path.cost, path.length + path.price.sum(), 1e-9 * path.cost);
    EXPECT_GE(path.cost, before);
    EXPECT_LE(path.cost, stretch * best);
    EXPECT_TRUE(classes.insert(path.passed).second);
    for (const std::int32_t letter : path.passed)
      EXPECT_TRUE(told.contains(static_cast<std::uint32_t>(std::abs(letter))));
    before = path.cost;
    paths.push_back(path.path);
  }
  EXPECT_TRUE(verify(scene, answer).verified);
  const ClassRule rule{reach, question.route.hole.value_or(2.0 * answer.problem.robot.radius)};
  EXPECT_FALSE(same_class(judged_classes(*scene.map, rule, paths, {}).classes));
}

TEST(Alternatives, AreFreePathsOfDifferentClassesTheCheapestFirst) {
  const Scene scene = scene_of(blocks(40, 30, 8, 3));
  Question question{.start = {2.0, 17.1}, .goal = {34.0, 17.6}};
  question.route.alternatives = 4;
  expect_alternatives(scene, question, 4);
  question.robot = RobotSpec{.kind = RobotKind::disc, .radius = 1.3};
  expect_alternatives(scene, question, 4);
  question.route.stretch = 1.02;
  expect_alternatives(scene, question, 0);
  question.route.stretch.reset();
  question.prices.clearance = ClearancePrice{2.0, 1.5};
  expect_alternatives(scene, question, 3);
}

TEST(Alternatives, AJudgeChecksPathsCostsClassesAndHoles) {
  const Scene scene = scene_of(blocks(40, 30, 8, 3));
  Question question{.start = {2.0, 17.1}, .goal = {34.0, 17.6}};
  question.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.8};
  question.prices.clearance = ClearancePrice{2.0, 1.5};
  question.route.alternatives = 4;
  const Answer answer = solve(scene, question, by_grid());
  ASSERT_GE(answer.alternatives.size(), 3U);
  ASSERT_TRUE(verify(scene, answer).verified);
  const auto refused = [&](const char* what, const auto& change) {
    Answer other = answer;
    change(other);
    const Verdict verdict = verify(scene, other);
    EXPECT_FALSE(verdict.verified) << what;
    if (verdict.first_violation) EXPECT_NE(verdict.first_violation->obstacle.find(what), std::string::npos) << what;
  };
  refused("path 2: cost", [](Answer& a) { a.alternatives[1].cost += 1e-6; });
  refused("path 1: length", [](Answer& a) { a.alternatives[0].length *= 1.0 - 1e-6; });
  refused("path 3: price", [](Answer& a) { a.alternatives[2].price.clearance += 1e-6; });
  refused("path 1: min_clearance", [](Answer& a) { a.alternatives[0].min_clearance += 0.01; });
  refused("path 2: cost", [](Answer& a) { std::swap(a.alternatives[0], a.alternatives[2]); });
  refused("cell", [](Answer& a) { a.alternatives[0].path = {a.path.front(), {5.5, 5.5}, a.path.back()}; });
  refused("another place", [](Answer& a) { a.alternatives[0].path.pop_back(); });
  refused("no points", [](Answer& a) { a.alternatives[0].path.clear(); });
  refused("class: of path 1", [](Answer& a) { a.alternatives[0].passed.push_back(1); });
  refused("class: of path 0", [](Answer& a) { a.passed = a.alternatives[0].passed; });
  refused("no hole", [](Answer& a) { a.holes[0].box.max.x += 1.0; });
  refused("no hole", [](Answer& a) { a.holes[0].id = 99; });
  refused("class", [](Answer& a) { a.hole_size = 50.0; });
  refused("one class", [](Answer& a) { a.alternatives[0] = a.alternatives[1]; });
}

TEST(Alternatives, SmallHolesMakeNoClass) {
  const Scene scene = scene_of(blocks(40, 30, 8, 3));
  Question question{.start = {2.0, 17.1}, .goal = {34.0, 17.6}};
  question.route.alternatives = 4;
  question.route.hole = 3.5;
  const Answer answer = solve(scene, question, by_grid());
  ASSERT_TRUE(answer.verified);
  EXPECT_TRUE(answer.alternatives.empty());
  EXPECT_TRUE(answer.holes.empty());
}

TEST(Alternatives, OnRandomMaps) {
  for (const std::uint64_t seed : test::seeds(300, 12)) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    Bitmap blocked(24, 24);
    for (int n = 0; n < 14; ++n) {
      const auto x = static_cast<std::uint32_t>(1 + rng.below(20));
      const auto y = static_cast<std::uint32_t>(1 + rng.below(20));
      for (std::uint32_t row = 0; row < 1 + rng.below(3); ++row) blocked.set_run(y + row, x, x + 1 + rng.below(3));
    }
    for (std::uint32_t y = 0; y < 24; ++y) {
      for (const std::uint32_t x : {0U, 1U, 22U, 23U}) blocked.clear(x, y);
    }
    Question question{.start = {0.7, 1.0 + static_cast<double>(rng.below(21))},
                      .goal = {23.3, 1.0 + static_cast<double>(rng.below(21))}};
    question.route.alternatives = static_cast<std::uint32_t>(1 + rng.below(5));
    if (seed % 2 == 0) question.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.6};
    if (seed % 3 == 0) question.prices.clearance = ClearancePrice{3.0, 1.0};
    if (solve(scene_of(blocked), {question.robot, question.start, question.goal}, by_grid()).verified) {
      expect_alternatives(scene_of(blocked), question, 0);
    }
  }
}

TEST(Alternatives, TheFirstIsNoDearerThanThePathWithoutThem) {
  for (const std::uint64_t seed : test::seeds(400, 40)) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    Bitmap blocked(60, 60);
    for (int n = 0; n < 40; ++n) {
      const auto x = static_cast<std::uint32_t>(2 + rng.below(50));
      const auto y = static_cast<std::uint32_t>(2 + rng.below(50));
      const auto size = static_cast<std::uint32_t>(1 + rng.below(6));
      for (std::uint32_t row = 0; row < size; ++row) blocked.set_run(y + row, x, x + 1 + rng.below(6));
    }
    Question question{.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.3 + 0.01 * rng.below(90)},
                      .start = {1.0, 1.0 + static_cast<double>(rng.below(58))},
                      .goal = {59.0, 1.0 + static_cast<double>(rng.below(58))}};
    question.prices.clearance = ClearancePrice{2.0, 0.5 + 0.1 * rng.below(25)};
    if (seed % 4 == 0) question.robot = RobotSpec{.kind = RobotKind::point};
    const Answer plain = solve(scene_of(blocked), question, by_grid());
    if (!plain.verified) continue;
    question.route.alternatives = 3;
    EXPECT_LE(*solve(scene_of(blocked), question, by_grid()).cost, *plain.cost * (1.0 + 1e-12));
    expect_alternatives(scene_of(blocked), question, 0);
  }
}

using States = std::vector<std::vector<double>>;

States states_of(const Path<Vec2>& path) {
  States states;
  for (const Vec2 p : path) states.push_back({p.x, p.y});
  return states;
}

TEST(KeepRoute, TheRestBeginsWhereTheRobotIs) {
  const States route{{0, 0}, {10, 0}, {10, 10}};
  EXPECT_EQ(rest_of_route(route, {4, 1}, 0.0, true), (States{{4, 1}, {4, 0}, {10, 0}, {10, 10}}));
  EXPECT_EQ(rest_of_route(route, {4, 0}, 0.0, true), (States{{4, 0}, {10, 0}, {10, 10}}));
  EXPECT_EQ(rest_of_route(route, {4, 1}, 0.0, false), (States{{4, 1}, {10, 0}, {10, 10}}));
  EXPECT_EQ(rest_of_route(route, {10, 10}, 0.0, true), (States{{10, 10}}));
  // Of an arm the third joint counts, too, and turns as it is said.
  EXPECT_EQ(rest_of_route({{0, 0, 0}, {0, 0, 4}, {1, 0, 4}}, {0, 0, 2}, 0.0, true, true),
            (States{{0, 0, 2}, {0, 0, 4}, {1, 0, 4}}));
  // A joint without end goes the shorter way, over half a turn.
  const std::vector<ArmVariable> endless{{.name = "swivel", .continuous = true}};
  const States rest = rest_of_route({{2.5}, {-2.5}}, {3.0}, 0.0, true, true, endless);
  double turned = 0.0;
  for (std::size_t i = 1; i < rest.size(); ++i) turned += std::abs(turn_between(rest[i - 1][0], rest[i][0]));
  EXPECT_NEAR(turned, std::abs(turn_between(3.0, -2.5)), 1e-12);
}

TEST(KeepRoute, ProgressDoesNotJumpToALaterPass) {
  const States route{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, -5}};  // comes by again at (5, 0)
  for (double x = 0.0; x <= 10.0; x += 0.25) {
    const States rest = rest_of_route(route, {x, 0.2}, 0.5, true);
    EXPECT_EQ(rest.size(), x < 10.0 ? 6U : 4U) << x;  // all that was to come still is
  }
  const States second = rest_of_route(route, {5.1, 3.0}, 0.5, true);
  EXPECT_EQ(second, (States{{5.1, 3.0}, {5, 3}, {5, -5}}));
}

/// Two ways around a block, of which the lower one is shorter by little, or by more.
Scene around_a_block(std::uint32_t low) {
  Bitmap blocked(30, 24);
  for (std::uint32_t y = low; y < 17; ++y) blocked.set_run(y, 12, 18);
  return scene_of(blocked);
}

TEST(KeepRoute, NoiseOfPricesDoesNotChangeIt) {
  const Scene scene = around_a_block(7);
  Question question{.start = {2.0, 12.0}, .goal = {28.0, 12.0}};
  question.prices.clearance = ClearancePrice{2.0, 3.0};
  Answer before = solve(scene, question, by_grid());
  ASSERT_TRUE(before.verified);
  const bool is_above = std::any_of(before.path.begin(), before.path.end(), [](Vec2 p) { return p.y > 16.0; });
  for (const std::uint64_t seed : test::seeds(1000, 12)) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    // Areas above and below that pay up to 4 % more: as if all prices were off by up to 2 % either way.
    question.prices.areas = {
        {1.0 + 0.04 * static_cast<double>(rng.below(1000)) / 1000.0, {{0, 12}, {30, 12}, {30, 24}, {0, 24}}},
        {1.0 + 0.04 * static_cast<double>(rng.below(1000)) / 1000.0, {{0, 0}, {30, 0}, {30, 12}, {0, 12}}}};
    question.route.keep_to = states_of(before.path);
    const Answer answer = solve(scene, question, by_grid());
    ASSERT_TRUE(answer.verified);
    ASSERT_TRUE(answer.keeping);
    EXPECT_TRUE(answer.keeping->kept);
    EXPECT_EQ(std::any_of(answer.path.begin(), answer.path.end(), [](Vec2 p) { return p.y > 16.0; }), is_above);
    EXPECT_NEAR(*answer.keeping->kept_cost, *answer.cost, 1e-9);
    before = answer;
  }
}

TEST(KeepRoute, ChangesWhereAMuchCheaperWayOpensOrTheOldOneIsBlocked) {
  const Scene scene = around_a_block(0);  // the way below is closed
  Question question{.start = {2.0, 6.0}, .goal = {28.0, 6.0}};
  const Answer above = solve(scene, question, by_grid());
  ASSERT_TRUE(above.verified);
  question.route.keep_to = states_of(above.path);
  const Answer kept = solve(scene, question, by_grid());
  ASSERT_TRUE(kept.keeping);
  EXPECT_TRUE(kept.keeping->kept);
  const Scene open = around_a_block(7);
  const Answer changed = solve(open, question, by_grid());
  ASSERT_TRUE(changed.keeping);
  EXPECT_FALSE(changed.keeping->kept);
  EXPECT_GT(*changed.keeping->kept_cost, 1.1 * *changed.keeping->new_cost);
  EXPECT_LT(changed.length, above.length);
  question.route.unless_gain = 0.9;
  EXPECT_TRUE(solve(open, question, by_grid()).keeping->kept);
  Scene blocked = around_a_block(7);
  for (std::uint32_t y = 17; y < 24; ++y) blocked.map->blocked.set(15, y);
  const Answer forced = solve(blocked, question, by_grid());
  EXPECT_FALSE(forced.keeping->kept);
  EXPECT_FALSE(forced.keeping->kept_cost);
  EXPECT_TRUE(forced.verified);
}

std::vector<std::vector<double>> route_of(const Answer& answer) {
  std::vector<std::vector<double>> route;
  for (const Vec2 p : answer.path) route.push_back({p.x, p.y});
  for (std::size_t i = 0; i < answer.states.size(); ++i) {
    if (i == 0) route.clear();
    route.emplace_back(answer.states[i].begin(), answer.states[i].end());
  }
  return route;
}

TEST(KeepRoute, OfPolygonsAndOtherPlannersToo) {
  const Scene scene = around_a_block(7);
  Question question{
      .robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-0.5, -0.3}, {0.5, -0.3}, {0.5, 0.3}, {-0.5, 0.3}}},
      .start = {2.0, 12.0, 0.0},
      .goal = {28.0, 12.0, 0.0}};
  SolveOptions options;
  options.planner = PlannerKind::rrt_connect;
  options.optimise = true;
  const Answer first = solve(scene, question, options);
  ASSERT_TRUE(first.verified);
  question.route.keep_to = route_of(first);
  options.seed = 2;
  const Answer second = solve(scene, question, options);
  ASSERT_TRUE(second.keeping);
  EXPECT_TRUE(second.keeping->kept_cost);
  if (second.keeping->kept) {
    EXPECT_EQ(second.states.numbers, first.states.numbers);
  }
  question.route.keep_to.back()[0] = 20.0;
  EXPECT_THROW(solve(scene, question, options), UsageError);
}

TEST(KeepRoute, EndsWhereTheQuestionAllows) {
  const Scene scene = around_a_block(7);
  const Question old{.start = {2.0, 12.0}, .goal = {28.0, 12.0}};
  const auto route = route_of(solve(scene, old, by_grid()));
  const auto asked = [&](std::vector<double> goal) {
    Question question = old;
    question.goal = std::move(goal);
    question.route.keep_to = route;
    return question;
  };
  Question question = asked({28.0, 14.0});
  question.rule.region = 1.0;
  EXPECT_THROW(solve(scene, question, by_grid()), UsageError);
  question.rule.region = 2.5;
  question.route.unless_gain = 0.9;
  for (const bool is_priced : {false, true}) {
    if (is_priced) question.prices.clearance = ClearancePrice{1.0, 2.0};
    const Answer kept = solve(scene, question, by_grid());
    ASSERT_TRUE(kept.keeping && kept.keeping->kept && kept.verified);
    EXPECT_EQ(kept.problem.goal, route.back());
    EXPECT_EQ(kept.goal_reached->distance, 2.0);
    EXPECT_TRUE(verify(scene, recorded(kept)).verified);
  }
  question = asked({28.0, 14.0});
  question.rule.tolerance = 1.0;
  EXPECT_THROW(solve(scene, question, by_grid()), UsageError);
  question.rule.tolerance = 2.5;
  EXPECT_FALSE(solve(scene, question, by_grid()).keeping->kept);  // the goal itself can be reached
  question = asked({2.0, 14.0});
  question.rule.others = {{28.0, 12.0}, {2.0, 10.0}};
  question.route.unless_gain = 0.99;
  const Answer second = solve(scene, question, by_grid());
  ASSERT_TRUE(second.keeping->kept);
  EXPECT_EQ(second.goal_index, 1U);
  EXPECT_EQ(second.problem.goal, route.back());
  EXPECT_TRUE(verify(scene, recorded(second)).verified);
}

TEST(KeepRoute, UnderAToleranceGoesToWhatIsNearestNow) {
  Bitmap blocked = around_a_block(7).map->blocked;
  Scene scene = around_a_block(7);
  const std::vector<double> goal{28.0, 12.0};
  for (std::uint32_t y = 10; y < 14; ++y) scene.map->blocked.set_run(y, 26, 30);
  Question question{.start = {2.0, 12.0}, .goal = goal, .rule = {.tolerance = 5.0}};
  const Answer near = solve(scene, question, by_grid());
  ASSERT_TRUE(near.verified && near.goal_reached->distance > 0.0);
  question.route.keep_to = route_of(near);
  const Answer again = solve(scene, question, by_grid());
  EXPECT_TRUE(again.keeping->kept);
  EXPECT_EQ(again.problem.goal, near.problem.goal);
  EXPECT_EQ(again.goal_reached->distance, near.goal_reached->distance);
  EXPECT_EQ(again.goal_reached->asked, goal);
  scene.map->blocked = blocked;
  const Answer there = solve(scene, question, by_grid());
  EXPECT_FALSE(there.keeping->kept);
  EXPECT_EQ(there.goal_reached->distance, 0.0);
}

TEST(KeepRoute, OfTurningBodiesKeepsTheirHeading) {
  const Scene scene = around_a_block(7);
  Question question{
      .robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-0.5, -0.3}, {0.5, -0.3}, {0.5, 0.3}, {-0.5, 0.3}}},
      .start = {2.0, 12.0, 0.0},
      .goal = {28.0, 12.0, 1.0}};
  SolveOptions options;
  options.planner = PlannerKind::rrt_connect;
  question.route.keep_to = route_of(solve(scene, question, options));
  question.route.unless_gain = 0.99;
  question.rule.region = 1.0;
  question.goal = {28.5, 12.0, 1.1};
  EXPECT_THROW(solve(scene, question, options), UsageError);
  question.rule.heading_rad = 0.2;
  const Answer kept = solve(scene, question, options);
  ASSERT_TRUE(kept.keeping->kept);
  EXPECT_EQ(kept.problem.goal, question.route.keep_to.back());
  EXPECT_EQ(kept.goal_reached->distance, 0.5);
}

TEST(Solve, APoseOfAToolIsForArmsAndAGoalHasAPlace) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  scene.polygons = {{{{4, 4}, {6, 4}, {6, 6}, {4, 6}}}};
  scene.start = {1, 1};
  scene.goal = {9, 9};
  Question question;
  question.goal_pose = Eigen::Isometry3d(Eigen::Translation3d(3, 3, 0));
  EXPECT_THROW(solve(scene, question), UsageError);
  EXPECT_THROW(solve(scene, {.goal = {3.0}, .rule = {.region = 1.0}}), UsageError);
}

TEST(SolveArm, APoseOfThePumasToolIsLookedForByNumbersAlone) {
  Scene scene;
  scene.spheres = {{0.68694, 0.0554304, 0.524197, 0.05}};  // where the tool shall be
  Question question{.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05}, .start = {-1, 0.5, -1.2, 0, 0, 0}};
  question.goal_pose = Eigen::Isometry3d(Eigen::Translation3d(0.686940002932, 0.0554303664029, 0.524197184988));
  question.goal_pose->rotate(
      Eigen::Quaterniond(0.909283154561, 0.117633594249, 0.0549307918955, 0.395410028246).normalized());
  for (const double tool : {0.0, 0.0001, 0.1}) {
    SCOPED_TRACE(tool);
    question.robot->tool = tool;
    const Answer answer = solve(scene, question, {.planner = PlannerKind::rrt_connect});
    EXPECT_NE(answer.outcome, Outcome::solved);
    if (answer.blocked) EXPECT_EQ(answer.blocked->by.find("outside of what the tool reaches"), std::string::npos);
    scene.spheres = {{5, 5, 5, 0.1}};
    EXPECT_TRUE(solve(scene, question, {.planner = PlannerKind::rrt_connect}).verified);
    scene.spheres = {{0.68694, 0.0554304, 0.524197, 0.05}};
  }
}

TEST(KeepRoute, OfArmsEndsAtTheGoalOrWithTheToolThere) {
  Scene scene;
  Question question{.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05},
                    .start = {0, 0, 0, 0, 0, 0},
                    .goal = {1, 0, 0, 0, 0, 0}};
  SolveOptions options;
  options.planner = PlannerKind::rrt_connect;
  const Answer first = solve(scene, question, options);
  ASSERT_TRUE(first.verified);
  question.route.keep_to = route_of(first);
  question.route.unless_gain = 0.99;
  EXPECT_TRUE(solve(scene, question, options).keeping->kept);
  question.goal = {-1, 0, 0, 0, 0, 0};
  EXPECT_THROW(solve(scene, question, options), UsageError);
  question.rule.others = {{1, 0, 0, 0, 0, 0}};
  const Answer second = solve(scene, question, options);
  ASSERT_TRUE(second.keeping->kept);
  EXPECT_EQ(second.goal_index, 1U);
  EXPECT_EQ(second.problem.goal, question.route.keep_to.back());
  question.rule.others.clear();
  question.goal = {0.4, 0.3, 0.3};  // of the tool
  question.route = {};
  const Answer tool = solve(scene, question, options);
  ASSERT_TRUE(tool.verified);
  question.route.keep_to = route_of(tool);
  EXPECT_TRUE(solve(scene, question, options).keeping->kept);
  question.goal = {0.4, 0.3, 0.31};
  const Answer beside = solve(scene, question, options);
  EXPECT_TRUE(beside.verified);
  EXPECT_FALSE(beside.keeping->kept);
  EXPECT_FALSE(beside.keeping->kept_cost);
}

TEST(KeepRoute, OfCarsIsJudgedByTheOptions) {
  const Scene scene = around_a_block(7);
  Question question{.robot = RobotSpec{.kind = RobotKind::car, .radius = 0.2, .turning_radius = 1.0},
                    .start = {2.0, 12.0, 0.0},
                    .goal = {28.0, 12.0, 0.0}};
  SolveOptions options;
  options.planner = PlannerKind::rrt_connect;
  const Answer first = solve(scene, question, options);
  ASSERT_TRUE(first.verified);
  question.route.keep_to = route_of(first);
  question.route.unless_gain = 0.99;
  EXPECT_TRUE(solve(scene, question, options).keeping->kept);
  options.car.turning_radius = 2.0;
  EXPECT_FALSE(solve(scene, question, options).keeping->kept_cost);
}

void expect_bound(const Scene& scene, const Question& question, double gap, double worth) {
  SolveOptions options = by_grid();
  options.anytime.gap = gap;
  ByProducts keep;
  keep.wants_certificate = true;
  const Answer answer = solve(scene, question, options, {}, &keep);
  ASSERT_TRUE(answer.verified);
  EXPECT_EQ(answer.bound_of, "all");
  ASSERT_TRUE(keep.certificate);
  const double cost = answer.price ? *answer.cost : answer.length;
  EXPECT_LE(*answer.lower_bound, cost);
  EXPECT_GE(*answer.lower_bound, worth * cost);
  RecordedAnswer record = recorded(answer);
  record.certificate = keep.certificate;
  const Verdict verdict = verify(scene, record);
  EXPECT_TRUE(verdict.verified) << (verdict.first_violation ? verdict.first_violation->obstacle : "");
  EXPECT_EQ(verdict.bound, BoundVerdict::checked);
  record.lower_bound = *record.lower_bound * 1.02;
  EXPECT_FALSE(verify(scene, record).verified);
}

TEST(BoundOfAll, IsProvedByItsCertificate) {
  const Scene scene = scene_of(blocks(40, 30, 8, 3));
  Question question{.start = {2.0, 17.1}, .goal = {34.0, 17.6}};
  expect_bound(scene, question, 0.06, 0.9);
  question.prices.clearance = ClearancePrice{2.0, 2.0};
  expect_bound(scene, question, 0.06, 0.8);
  question.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.7};
  expect_bound(scene, question, 0.06, 0.8);
}

}  // namespace
}  // namespace warren
