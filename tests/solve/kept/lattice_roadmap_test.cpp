// SPDX-License-Identifier: BSD-3-Clause
// Large lattices are asked by their route index: the lengths of solve(), without a search.
#include "solve/kept/lattice_roadmap.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

Roadmap indexed(const std::string& source, const Question& question = {}) {
  Roadmap roadmap = build(read_world(source), question);
  EXPECT_NE(roadmap.lattice, nullptr) << source;
  return roadmap;
}

TEST(LatticeRoadmap, AnswersAsSolveDoesWhereverTheEndsAre) {
  std::mt19937 random(3);
  const auto place = [&](bool on_lattice) {
    const double x = 1.0 + static_cast<double>(random() % 255);
    const double y = 1.0 + static_cast<double>(random() % 255);
    if (on_lattice) return std::vector<double>{x, y};
    return std::vector<double>{x + 0.001 * static_cast<double>(random() % 1000), y + 0.3};
  };
  for (const std::string& source : {std::string("maze:256x256,seed=2"), std::string("maze:256x256,algorithm=wilson"),
                                    std::string("maze:256x256,loops=0.1,algorithm=kruskal")}) {
    const Roadmap roadmap = indexed(source);
    const RoadmapQuery query(roadmap);
    EXPECT_EQ(query.ask({}, {}).length, solve(roadmap.world.outline()).length);  // from opening to opening
    for (int i = 0; i < static_cast<int>(test::share(12, 6)); ++i) {
      const std::vector<double> start = place(i % 3 != 1);
      const std::vector<double> goal = place(i % 3 != 2);
      SCOPED_TRACE(source + " " + std::to_string(i));
      const Answer expected = solve(roadmap.world.outline(), {.start = start, .goal = goal});
      const Answer answer = query.ask(start, goal);
      EXPECT_EQ(answer.outcome, expected.outcome);
      EXPECT_EQ(answer.verified, expected.verified);
      EXPECT_NEAR(answer.length, expected.length, 1e-9 * expected.length);
      QuestionScratch scratch;
      const LengthAnswer length = query.length_within(start, goal, {}, {}, scratch);
      EXPECT_EQ(length.outcome, expected.outcome);
      EXPECT_NEAR(length.length, expected.length, 1e-9 * expected.length);
    }
  }
}

TEST(LatticeRoadmap, IsCountedUntilASignalComes) {
  const Roadmap roadmap = indexed("maze:256x256,seed=2");
  EXPECT_EQ(count_edges(roadmap, {}).free, 256U * 256U - 1) << "a perfect maze";
  const SignalFlag signal{15};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  EXPECT_THROW(count_edges(roadmap, {.deadline = &deadline}), Stopped);
}

TEST(LatticeRoadmap, ManyEndsBesideTheLatticeAreAskedOfAnIndexAndAnswerTheSame) {
  std::mt19937 random(7);
  const auto place = [&] { return 0.4 + 0.001 * static_cast<double>(random() % 256'400); };
  Question wide;
  wide.clearance = 0.2;
  for (const Question& body : {Question{}, wide}) {
    const Roadmap roadmap = indexed("maze:256x256,loops=0.05", body);
    const RoadmapQuery many(roadmap);
    for (int i = 0; i < 40; ++i) many.expect({1.5, 1.25}, {});
    int solved = 0;
    const int asked = test::asks_all() ? 60 : 15;
    for (int i = 0; i < asked; ++i) {
      const std::vector<double> start = {place(), place()};
      const std::vector<double> goal =
          i % 5 == 0 ? std::vector{start[0] + 0.3, start[1]} : std::vector{place(), place()};
      QuestionScratch by_index;
      QuestionScratch by_passes;
      const LengthAnswer length = many.length_within(start, goal, {}, {}, by_index);
      const LengthAnswer expected = RoadmapQuery(roadmap).length_within(start, goal, {}, {}, by_passes);
      EXPECT_EQ(length.outcome, expected.outcome) << i;
      EXPECT_EQ(length.length, expected.length) << i;
      solved += length.outcome == Outcome::solved ? 1 : 0;
    }
    EXPECT_GT(solved, test::asks_all() ? 10 : 2);
    EXPECT_LT(solved, asked);
  }
}

TEST(LatticeRoadmap, BlockedAndUnreachableEndsAreTold) {
  Scene scene = read_world("maze:256x256,seed=2");
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  for (const Segment side : {Segment{{9.5, 9.5}, {10.5, 9.5}},
                             {{10.5, 9.5}, {10.5, 10.5}},
                             {{10.5, 10.5}, {9.5, 10.5}},
                             {{9.5, 10.5}, {9.5, 9.5}}}) {
    walls.push_back(side);  // the cell (10, 10) is walled in
  }
  scene.walls = WallSet::narrowest(walls);
  const Roadmap roadmap = build(std::move(scene));
  ASSERT_NE(roadmap.lattice, nullptr);
  const RoadmapQuery query(roadmap);
  EXPECT_EQ(query.ask({10, 10}, {1, 1}).outcome, Outcome::not_connected);
  EXPECT_EQ(query.ask({10, 9.5}, {1, 1}).outcome, Outcome::start_blocked);
  EXPECT_EQ(query.ask({1, 1}, {10, 9.55}).outcome, Outcome::goal_blocked);
  EXPECT_EQ(query.ask({10, 10}, {10.2, 10.2}).outcome, Outcome::solved);
}

TEST(LatticeRoadmap, IsExportedAsTheGraphThatItStandsFor) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  const std::string name = folder + "/warren_lattice_" + std::to_string(::getpid());
  const Scene scene = read_world("maze:256x256,loops=0.05");
  const ExportAccount of_index = export_of_roadmap(build(scene), name + "a.csv");
  const ExportAccount of_graph = export_of_roadmap(build(scene, {}, {}, {}, IndexChoice::none), name + "b.csv");
  EXPECT_EQ(of_index.edges, of_graph.edges);
  EXPECT_EQ(of_index.vertices, of_graph.vertices);
  EXPECT_EQ(of_index.blocked_left_out, of_graph.blocked_left_out);
  for (const char* file : {"a.csv", "a.edges.csv", "b.csv", "b.edges.csv"}) std::filesystem::remove(name + file);
}

TEST(LatticeRoadmap, ASearchIsRefusedWhereNothingIsSearched) {
  const Roadmap roadmap = indexed("maze:256x256");
  const RoadmapQuery query(roadmap);
  EXPECT_THROW(query.ask({}, {}, {.search = SearchMethod::dijkstra}), UsageError);
  EXPECT_EQ(query.ask({}, {}, {.optimise = true}).verified, true);
}

TEST(LatticeRoadmap, SmallLatticesAndOpenSpaceAreSearched) {
  EXPECT_EQ(build(read_world("maze:41x41")).lattice, nullptr);
  EXPECT_EQ(build(read_world("maze:256x256,loops=1")).lattice, nullptr);
  EXPECT_EQ(build(read_world("maze:256x256"), {}, {}, {}, IndexChoice::none).lattice, nullptr);
}

}  // namespace
}  // namespace warren
