// SPDX-License-Identifier: BSD-3-Clause
// Large sampled roadmaps are asked by their contraction hierarchy: the paths of the search, without it.
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "roadmaps/file/write_roadmap_file.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "solve/roadmaps/roadmap_query.hpp"

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

TEST(ContractedRoadmap, AnswersAsTheSearchDoes) {
  ASSERT_FALSE(contracted().arrays.hierarchy.empty());
  const RoadmapQuery query(contracted());
  std::mt19937 random(3);
  const auto place = [&] {
    const auto number = [&] { return 0.5 + 0.001 * static_cast<double>(random() % 90'000); };
    return std::vector<double>{number(), number()};
  };
  const auto milestone = [&] {
    const auto state = contracted().arrays.parts().state(random() % count_states(contracted()));
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
  EXPECT_GT(solved, 30);
  EXPECT_LT(10 * expanded[0], expanded[1]);
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
  EXPECT_TRUE(build(read_world("maze:90x90,loops=1"), {}, uniform_samples(90'000)).arrays.hierarchy.empty());
  EXPECT_TRUE(
      build(read_world("maze:90x90"), {}, uniform_samples(90'000), {}, IndexChoice::none).arrays.hierarchy.empty());
  SolveOptions lazy = uniform_samples(90'000);
  lazy.planner = PlannerKind::lazy_prm;
  EXPECT_TRUE(build(read_world("maze:90x90"), {}, lazy).arrays.hierarchy.empty());
}

}  // namespace
}  // namespace warren
