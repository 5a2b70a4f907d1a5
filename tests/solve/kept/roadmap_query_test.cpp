// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that is built once answers as solve() does, for every body and world that roadmaps are for.
#include "solve/kept/roadmap_query.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/kept/same_answers.hpp"

namespace warren {
namespace {

using test::expect_same;

std::string world_file(const std::string& name) { return test::source_dir() + "/examples/worlds/" + name; }

struct Case {
  std::string name;
  std::string world;
  Question question;  // its body, and the first of the questions
  std::uint64_t samples;
  std::vector<std::vector<double>> others = {};  // goals of more questions
};

std::vector<Case> cases() {
  const RobotSpec disc{.kind = RobotKind::disc, .radius = 0.05};
  const std::vector<Vec2> outline{{-0.2, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.2, 0.1}};
  return {{"walls", world_file("walls.scene"), {}, 800, {}},
          {"maze", "maze:9x9,seed=2,loops=0.1", {}, 2000, {{3, 4}, {9, 9}, {0.5, 0.5}}},
          {"polygons",
           world_file("town.geojson"),
           {.robot = disc, .start = {1.5, 1.5}, .goal = {9.5, 8.5}},
           600,
           {{5, 5}, {0.1, 0.1}, {4, 6}}},
          {"turning", world_file("poly-easy.scene"), {}, 1500, {}},
          {"car", world_file("car-20.scene"), {}, 400, {}},
          {"parking", world_file("parking-lot.scene"), {}, 500, {}},
          {"arm", world_file("puma.scene"), {}, 400, {}},
          {"map", world_file("flat.yaml"), {.robot = disc, .start = {1, 1}, .goal = {3, 1}}, 500, {}},
          {"body on a map",
           world_file("flat.yaml"),
           {.robot = RobotSpec{.kind = RobotKind::polygon, .outline = outline}, .start = {1, 1, 0}, .goal = {3, 1, 0}},
           500,
           {}}};
}

TEST(RoadmapQuery, AnswersAsSolveDoes) {
  std::size_t solved = 0;
  const std::vector<Case> all = cases();
  for (const std::uint64_t half : test::seeds(2 * all.size(), all.size() / 2, 0)) {
    const Case& c = all[half % all.size()];
    const Scene scene = read_world(c.world);
    const PlannerKind planner = half / all.size() == 0 ? PlannerKind::prm : PlannerKind::lazy_prm;
    SCOPED_TRACE(c.name + " " + std::string(name_of(planner)));
    SolveOptions options{.planner = planner, .seed = 3};
    options.roadmap.samples = c.samples;
    const Roadmap roadmap = build(scene, c.question, options);
    const RoadmapQuery query(roadmap);
    std::vector<std::vector<double>> goals = c.others;
    goals.push_back(c.question.goal.empty() ? scene.goal : c.question.goal);
    for (const std::vector<double>& goal : goals) {
      Question question = c.question;
      question.goal = goal;
      const Answer expected = solve(scene, question, options);
      expect_same(query.ask(question.start, goal), expected);
      expect_same(query.ask(question.start, goal), expected);  // with what the first has learnt
      solved += expected.outcome == Outcome::solved ? 1 : 0;
    }
    options.optimise = true;
    expect_same(query.ask(c.question.start, c.question.goal, {.optimise = true}), solve(scene, c.question, options));
  }
  EXPECT_GE(solved, test::share(16, 2));
}

TEST(RoadmapQuery, AnswersOnTheLatticeAsThePlainStagesDo) {
  const Scene scene = read_world("maze:21x33,seed=2,loops=0.1");
  const Roadmap roadmap = build(scene);
  EXPECT_EQ(roadmap.arrays.parts().vertex_count(), 21U * 33U);
  const RoadmapQuery query(roadmap);
  SolveOptions plain{.planner = PlannerKind::prm};
  plain.roadmap.pipeline = PipelineKind::plain;
  for (const std::vector<double>& goal : {scene.goal, {4, 9}, {1.2, 1.2}}) {
    const Answer answer = query.ask(scene.start, goal);
    expect_same(answer, solve(scene, {.goal = goal}, plain));
    EXPECT_EQ(answer.length, solve(scene, {.goal = goal}).length);
  }
}

TEST(RoadmapQuery, ARoadmapThatCallsBlockedEdgesFreeIsFoundOut) {
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
    SolveOptions options{.planner = planner};
    options.roadmap.samples = 400;
    Roadmap roadmap = build(read_world("maze:9x9,seed=2"), {}, options);
    for (std::size_t end = 0; end < roadmap.arrays.candidates.targets().size(); ++end) {
      set_edge_state(roadmap.arrays.edge_states, end, EdgeState::free);
    }
    const RoadmapQuery query(roadmap);
    EXPECT_THROW(query.ask({}, {}), InputError);
  }
}

TEST(Build, RefusesWhatMeansNothingToARoadmap) {
  const Scene scene = read_world("maze:9x9");
  const auto line = [&](const SolveOptions& options) {
    return test::refusal<UsageError>([&] { build(scene, {}, options); });
  };
  EXPECT_EQ(line({.optimise = true}), "optimise: is for a question; say it when the roadmap is asked");
  EXPECT_EQ(line({.search = SearchMethod::bfs}), "search: is for a question; say it when the roadmap is asked");
  EXPECT_EQ(line({.roadmap = {.lazy = LazyCheck::expansion}}),
            "lazy: a roadmap that is kept is made in one way; leave it out");
  EXPECT_EQ(line({.planner = PlannerKind::visibility}), "") << "of a clearance, too";
  EXPECT_NE(line({.planner = PlannerKind::rrt_connect}), "");
  EXPECT_NE(line({.planner = PlannerKind::anytime}), "");
}

}  // namespace
}  // namespace warren
