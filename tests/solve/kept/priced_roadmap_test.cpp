// SPDX-License-Identifier: BSD-3-Clause
// A roadmap keeps the prices that it is built with: asked, it answers as solve() does, from memory and from a file, and
// after a change of its world.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/kept/same_answers.hpp"

namespace warren {
namespace {

/// Three rooms, as cells and as polygons.
Scene rooms(bool as_map) {
  if (as_map) return read_world(test::source_dir() + "/examples/worlds/flat.yaml");
  Scene scene;
  scene.source = "rooms";
  scene.bounds = Box{{0, 0}, {4.8, 3.2}};
  scene.polygons.push_back({{{1.6, 0}, {1.7, 0}, {1.7, 2.4}, {1.6, 2.4}}, 0});
  scene.polygons.push_back({{{3.2, 0.8}, {3.3, 0.8}, {3.3, 3.2}, {3.2, 3.2}}, 0});
  return scene;
}

std::vector<RobotSpec> rooms_bodies() {
  const std::vector<Vec2> outline{{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
  RobotSpec car{.kind = RobotKind::car, .radius = 0.15, .turning_radius = 0.3};
  RobotSpec reversing = car;
  reversing.steering = SteeringKind::reeds_shepp;
  return {{.kind = RobotKind::disc, .radius = 0.2}, {.kind = RobotKind::polygon, .outline = outline}, car, reversing};
}

Question priced_question(const RobotSpec& robot) {
  Question question{.robot = robot, .start = {0.5, 0.5}, .goal = {4.3, 0.5}};
  if (state_size(robot) == 3) question.start.push_back(0.0);
  question.prices.clearance = ClearancePrice{3.0, 0.5};
  question.prices.areas.push_back({5.0, {{2, 0}, {3, 0}, {3, 2}, {2, 2}}, 0});
  return question;
}

SolveOptions roadmap_of(PlannerKind planner) {
  SolveOptions options{.planner = planner, .seed = 3};
  options.roadmap.samples = 800;
  return options;
}

void expect_same_price(const Answer& answer, const Answer& expected) {
  test::expect_same(answer, expected);
  EXPECT_EQ(answer.cost, expected.cost);
  ASSERT_EQ(answer.price.has_value(), expected.price.has_value());
  if (answer.price) EXPECT_EQ(answer.price->sum(), expected.price->sum());
}

TEST(PricedRoadmap, AnswersAsSolveDoes) {
  const std::vector<RobotSpec> robots = rooms_bodies();
  const std::string file =
      (std::filesystem::temp_directory_path() / ("warren_priced_" + std::to_string(::getpid()) + ".roadmap")).string();
  std::uint64_t heard = 0;
  for (const std::uint64_t number : test::seeds(4 * robots.size(), 4, 0)) {
    const RobotSpec& robot = robots[number % robots.size()];
    const Scene scene = rooms(number / robots.size() % 2 == 0);
    const PlannerKind planner = number / robots.size() / 2 == 0 ? PlannerKind::prm : PlannerKind::lazy_prm;
    SCOPED_TRACE(std::string(name_of(planner)) + ", " + robot_text(robot) + ", " + scene.source);
    const Question question = priced_question(robot);
    SolveOptions options = roadmap_of(planner);
    const Answer expected = solve(scene, question, options);
    ASSERT_EQ(expected.outcome, Outcome::solved);
    ASSERT_TRUE(expected.price);
    const Roadmap roadmap = build(scene, question, options);
    const RoadmapQuery query(roadmap);
    const Answer asked = query.ask(question.start, question.goal);
    expect_same_price(asked, expected);
    EXPECT_TRUE(verify(scene, asked).verified);
    Question free = question;
    free.prices = {};
    const Answer shortest = solve(scene, free, options);
    EXPECT_LE(shortest.length, expected.length);
    heard += shortest.path != expected.path ? 1 : 0;
    options.optimise = true;
    expect_same_price(query.ask(question.start, question.goal, {.optimise = true}), solve(scene, question, options));
    write_roadmap(roadmap, file);
    const Roadmap read = read_roadmap(file);
    EXPECT_EQ(read.prices.areas.size(), 1U);
    expect_same_price(RoadmapQuery(read).ask(question.start, question.goal), expected);
    const Roadmap beside = read_roadmap(file, {}, rooms(scene.map.has_value()));
    expect_same_price(RoadmapQuery(beside).ask(question.start, question.goal), expected);
  }
  std::filesystem::remove(file);
  EXPECT_GE(heard, test::share(14, 1)) << "of a car's few ways the shortest may be the cheapest";
}

TEST(PricedRoadmap, AFilesPricesAreItsOwn) {
  Scene scene = rooms(false);
  const Question question = priced_question(rooms_bodies().front());
  scene.prices = question.prices;
  Question plain = question;
  plain.prices = {};
  const Roadmap roadmap = build(scene, plain, roadmap_of(PlannerKind::prm));
  EXPECT_EQ(roadmap.prices.areas.size(), 1U);
  EXPECT_TRUE(roadmap.world.outline().prices.empty());
  expect_same_price(RoadmapQuery(roadmap).ask(question.start, question.goal),
                    solve(scene, plain, roadmap_of(PlannerKind::prm)));
}

TEST(PricedRoadmap, KeepsThemWhenItsWorldChanges) {
  const Question question = priced_question(rooms_bodies().front());
  const SolveOptions options = roadmap_of(PlannerKind::prm);
  const Roadmap roadmap = build(rooms(false), question, options);
  Scene now = rooms(false);
  now.polygons.push_back({{{2.2, 2.6}, {2.6, 2.6}, {2.6, 3.2}, {2.2, 3.2}}, 0});
  const Roadmap next = update(roadmap, now, {});
  expect_same_price(RoadmapQuery(next).ask(question.start, question.goal), solve(now, question, options));
}

/// Else what the world forbids or makes dear would be passed over.
TEST(PricedRoadmap, AWorldOfOtherPricesIsRefused) {
  const RobotSpec robot = rooms_bodies().front();
  const Question question = priced_question(robot);
  Question plain = question;
  plain.prices = {};
  const SolveOptions options = roadmap_of(PlannerKind::prm);
  Scene priced = rooms(false);
  priced.prices = question.prices;
  Scene closed = rooms(false);
  closed.prices.keep_out.push_back({{{2, 0}, {3, 0}, {3, 2}}, 0});
  const Roadmap lengths = build(rooms(false), plain, options);
  const Roadmap prices = build(rooms(false), question, options);
  const auto expect_refusal = [](const std::string& said) {
    EXPECT_NE(said.find("has prices or forbidden areas that the roadmap was built without"), std::string::npos) << said;
  };
  expect_refusal(test::refusal<UsageError>([&] { update(lengths, priced, {}); }));
  expect_refusal(test::refusal<UsageError>([&] { update(lengths, closed, {}); }));
  expect_refusal(test::refusal<UsageError>([&] { update(prices, closed, {}); }));
  EXPECT_EQ(update(prices, priced, {}).prices.areas.size(), 1U);
  const std::string file =
      (std::filesystem::temp_directory_path() / ("warren_plain_" + std::to_string(::getpid()) + ".roadmap")).string();
  write_roadmap(lengths, file);
  expect_refusal(test::refusal<UsageError>([&] { read_roadmap(file, {}, closed); }));
  EXPECT_TRUE(read_roadmap(file, {}, rooms(false)).prices.empty());
  priced.prices.clearance = ClearancePrice{9.0, 0.5};  // for which the roadmap's own counts
  EXPECT_EQ(update(prices, priced, {}).prices.clearance->price, 3.0);
  write_roadmap(prices, file);
  const Roadmap beside = read_roadmap(file, {}, priced);
  EXPECT_EQ(beside.prices.clearance->price, 3.0);
  EXPECT_TRUE(beside.world.outline().prices.empty()) << "let go";
  std::filesystem::remove(file);
}

TEST(PricedRoadmap, WhatItCantKeepIsRefused) {
  const auto refused = [](const Question& question, PlannerKind planner) {
    return test::refusal<UsageError>([&] { build(rooms(true), question, {.planner = planner}); });
  };
  Question question = priced_question(rooms_bodies().front());
  question.prices.keep_out.push_back({{{2, 0}, {3, 0}, {3, 2}}, 0});
  EXPECT_NE(refused(question, PlannerKind::prm).find("keep_out"), std::string::npos);
  question = priced_question(rooms_bodies().front());
  question.prices.unknown = 2.0;
  EXPECT_NE(refused(question, PlannerKind::prm).find("unknown"), std::string::npos);
  EXPECT_NE(refused(priced_question(rooms_bodies().front()), PlannerKind::voronoi).find("clearance_price"),
            std::string::npos);
}

/// Many milestones make an index of lengths, which says nothing of prices.
TEST(PricedRoadmap, HasNoIndexOfLengths) {
  Question question = priced_question(rooms_bodies().front());
  SolveOptions options = roadmap_of(PlannerKind::prm);
  options.roadmap.samples = 70'000;
  options.roadmap.neighbours = 4;
  const Scene scene = rooms(false);
  const Roadmap roadmap = build(scene, question, options);
  EXPECT_TRUE(roadmap.arrays.hierarchy.empty());
  expect_same_price(RoadmapQuery(roadmap).ask(question.start, question.goal), solve(scene, question, options));
}

}  // namespace
}  // namespace warren
