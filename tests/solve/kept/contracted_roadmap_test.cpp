// SPDX-License-Identifier: BSD-3-Clause
// Large sampled roadmaps are asked by their contraction hierarchy: the paths of the search, without it.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

SolveOptions uniform_samples(std::uint64_t samples) {
  SolveOptions options{.sampler = SamplerKind::uniform};
  options.roadmap.samples = samples;
  return options;
}

const Roadmap& contracted() {
  static const Roadmap roadmap = build(read_world("maze:90x90,loops=0.1"), {}, uniform_samples(90'000));
  return roadmap;
}

void expect_answers_of_a_search(const Roadmap& roadmap, unsigned largest, int fewest_solved) {
  ASSERT_FALSE(roadmap.arrays.hierarchy.empty());
  const RoadmapQuery query(roadmap);
  std::mt19937 random(3);
  const auto place = [&] {
    const auto number = [&] { return 0.5 + 0.001 * static_cast<double>(random() % (1000 * largest)); };
    return std::vector<double>{number(), number()};
  };
  const auto milestone = [&] {
    const auto state = roadmap.arrays.parts().state(random() % count_states(roadmap));
    return std::vector<double>(state.begin(), state.end());
  };
  int solved = 0;
  std::array<std::uint64_t, 2> expanded{};
  QuestionScratch scratch;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const std::vector<double> start = i % 3 == 0 && i % 10 != 0 ? milestone() : place();
    std::vector<double> goal = i % 4 == 0 ? milestone() : place();
    if (i % 10 == 0) goal = {start[0] + 0.1, start[1]};
    const Answer expected = query.ask_within(start, goal, {.search = SearchMethod::astar}, {}, scratch);
    const Answer answer = query.ask_within(start, goal, {}, {}, scratch);
    EXPECT_EQ(answer.outcome, expected.outcome);
    EXPECT_EQ(answer.path, expected.path);
    EXPECT_EQ(answer.length, expected.length);
    EXPECT_EQ(answer.verified, expected.verified);
    const LengthAnswer length = query.length_within(start, goal, {}, {}, scratch);
    EXPECT_EQ(length.outcome, expected.outcome);
    EXPECT_EQ(length.length, expected.length);
    if (!answer.verified) continue;
    ++solved;
    expanded[0] += answer.counters.expanded;
    expanded[1] += expected.counters.expanded;
  }
  EXPECT_GT(solved, fewest_solved);
  EXPECT_LT(10 * expanded[0], expanded[1]);
}

TEST(ContractedRoadmap, AnswersAsTheSearchDoes) { expect_answers_of_a_search(contracted(), 90, 30); }

constexpr std::size_t aisles = 40;
constexpr std::size_t aisle_length = 100;

/// Is there a gap in the shelf? Two in each, somewhere.
bool is_gap(std::size_t shelf, std::size_t place) {
  return place == shelf * 37 % aisle_length || place == (shelf * 61 + 50) % aisle_length;
}

/// The roadmap of a world in a file.
Roadmap roadmap_of(const std::string& ending, const std::string& world) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("warren_aisles_" + std::to_string(::getpid()) + ending)).string();
  std::ofstream(file) << world;
  SolveOptions options = uniform_samples(150'000);
  options.planner = PlannerKind::prm;
  Roadmap roadmap = build(read_world(file), {.clearance = 0.05}, options);
  std::filesystem::remove(file);
  return roadmap;
}

/// Aisles between shelves, which are polygons.
TEST(ContractedRoadmap, AmongPolygonsAnswersAsTheSearchDoes) {
  std::string world = fmt::format("bounds 0 0 {} {}\nrobot point\n", aisle_length, 2 * aisles);
  for (std::size_t shelf = 0; shelf + 1 < aisles; ++shelf) {
    for (std::size_t begin = 0, end = 0; begin < aisle_length; begin = end + 1) {
      for (end = begin; end < aisle_length && !is_gap(shelf, end); ++end) {
      }
      const std::size_t low = 2 * shelf + 1;
      if (end > begin) {
        world += fmt::format("polygon {0} {2} {1} {2} {1} {3} {0} {3}\n", begin, end, low, low + 1);
      }
    }
  }
  expect_answers_of_a_search(roadmap_of(".scene", world), 75, 10);
}

/// The same as a map of cells.
TEST(ContractedRoadmap, OnMapsAnswersAsTheSearchDoes) {
  std::string map = fmt::format("type octile\nheight {}\nwidth {}\nmap\n", 2 * aisles - 1, aisle_length);
  for (std::size_t row = 0; row + 1 < 2 * aisles; ++row) {
    for (std::size_t place = 0; place < aisle_length; ++place) {
      map += row % 2 == 0 || is_gap(row / 2, place) ? '.' : '@';
    }
    map += '\n';
  }
  expect_answers_of_a_search(roadmap_of(".map", map), 75, 10);
}

TEST(ContractedRoadmap, IsReadBackFromItsFileAndCraftedOnesAreRefused) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("warren_contracted_" + std::to_string(::getpid()))).string();
  write_roadmap(contracted(), file);
  const Roadmap read = read_roadmap(file);
  const Hierarchy& expected = contracted().arrays.hierarchy;
  EXPECT_EQ(read.arrays.hierarchy.first, expected.first);
  EXPECT_EQ(read.arrays.hierarchy.arcs, expected.arcs);
  {
    const RoadmapFile open(file, {});
    EXPECT_NE(roadmap_meta(open, {}).find("\"index\": \"contraction\""), std::string::npos);
  }
  Roadmap crafted = read_roadmap(file);
  for (HierarchyArc& arc : crafted.arrays.hierarchy.arcs) arc.middle = no_vertex;  // shortcuts pass for edges
  EXPECT_THROW(RoadmapQuery(crafted).ask({1.0, 1.0}, {90.0, 90.0}), InputError);   // the judge says so
  crafted.arrays.hierarchy.arcs.back().to = 90'000;
  write_roadmap(crafted, file);
  EXPECT_THROW(read_roadmap(file), InputError);
  std::filesystem::remove(file);
}

TEST(ContractedRoadmap, IsMadeAnewByAnUpdateAsByABuild) {
  Scene now = contracted().world.outline();
  std::vector<Segment> walls;
  for (std::size_t i = 1; i < now.walls.size(); ++i) walls.push_back(now.walls.segment(i));
  now.walls = WallSet::narrowest(walls);
  const Roadmap updated = update(contracted(), now, {});
  const Roadmap expected = build(now, {}, uniform_samples(90'000));
  EXPECT_FALSE(updated.arrays.hierarchy.empty());
  EXPECT_EQ(updated.arrays.hierarchy.arcs, expected.arrays.hierarchy.arcs);
}

TEST(ContractedRoadmap, ThereIsNoneWhereItDoesNotPay) {
  EXPECT_TRUE(build(read_world("maze:41x41"), {}, uniform_samples(20'000)).arrays.hierarchy.empty());
  SolveOptions options = uniform_samples(90'000);
  for (const std::uint64_t reason : test::seeds(3, 1)) {
    SCOPED_TRACE(reason);  // too many ways, nobody wants it, edges that are not known
    const IndexChoice choice = reason == 2 ? IndexChoice::none : IndexChoice::where_it_pays;
    options.planner = reason == 3 ? PlannerKind::lazy_prm : SolveOptions{}.planner;
    const Scene scene = read_world(reason == 1 ? "maze:90x90,loops=1" : "maze:90x90");
    EXPECT_TRUE(build(scene, {}, options, {}, choice).arrays.hierarchy.empty());
  }
}

}  // namespace
}  // namespace warren
