// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "tests/paths.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

class RoadmapFileIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("warren_roadmaps_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string place(const std::string& name) const { return (folder_ / name).string(); }
  static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string refusal_of(const std::string& path, std::optional<Scene> world = {}) const {
    return test::refusal<InputError>([&] { read_roadmap(path, {}, std::move(world)); });
  }

 private:
  std::filesystem::path folder_;
};

SolveOptions few(std::uint64_t samples, PlannerKind planner) {
  SolveOptions options{.planner = planner, .seed = 5};
  options.roadmap.samples = samples;
  return options;
}

TEST_F(RoadmapFileIo, WhatIsReadAnswersAsWhatWasWrittenInEveryWorld) {
  const std::string worlds = test::source_dir() + "/examples/worlds/";
  for (const std::string& world :
       {worlds + "walls.scene", worlds + "poly-easy.scene", worlds + "car-20.scene", worlds + "parking-lot.scene",
        worlds + "puma.scene", std::string("maze:9x9,seed=2"), std::string("maze:5x7,loops=0.2")}) {
    for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
      SCOPED_TRACE(world);
      const Roadmap built = build(read_world(world), {}, few(300, planner));
      const std::string file = place("a.roadmap");
      write_roadmap(built, file);
      const Roadmap read = read_roadmap(file);
      EXPECT_EQ(read.world.outline().source, built.world.outline().source);
      const Answer answer = RoadmapQuery(read).ask({}, {});
      const Answer expected = RoadmapQuery(built).ask({}, {});
      EXPECT_EQ(answer.outcome, expected.outcome);
      EXPECT_EQ(answer.path, expected.path);
      EXPECT_EQ(answer.length, expected.length);
      EXPECT_EQ(answer.counters.expanded, expected.counters.expanded);
      EXPECT_EQ(answer.counters.edges_checked, expected.counters.edges_checked);
      write_roadmap(read, place("b.roadmap"));
      EXPECT_EQ(bytes_of(file), bytes_of(place("b.roadmap")));
    }
  }
}

TEST_F(RoadmapFileIo, MapsAreKeptWithTheirCells) {
  const Scene map = read_world(test::source_dir() + "/examples/worlds/flat.yaml");
  const Question disc{.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.05}};
  const Roadmap built = build(map, disc, few(300, PlannerKind::prm));
  write_roadmap(built, place("map.roadmap"));
  const Roadmap read = read_roadmap(place("map.roadmap"));
  ASSERT_TRUE(read.world.outline().map.has_value());
  EXPECT_EQ(read.world.outline().map->blocked, map.map->blocked);
  EXPECT_EQ(read.world.outline().map->unknown, map.map->unknown);
  const Answer answer = RoadmapQuery(read).ask({1, 1}, {3, 1});
  EXPECT_EQ(answer.path, RoadmapQuery(built).ask({1, 1}, {3, 1}).path);
}

TEST_F(RoadmapFileIo, TheSameBytesForAnyNumberOfThreads) {
  std::string first;
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    const Roadmap roadmap = build(read_world("maze:9x9,seed=2"), {}, {}, {.threads = threads});
    write_roadmap(roadmap, place("t.roadmap"));
    const std::string bytes = bytes_of(place("t.roadmap"));
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads;
  }
}

TEST_F(RoadmapFileIo, WithoutItsWorldItAsksForItAndKnowsIt) {
  const Scene maze = read_world("maze:9x9,seed=2");
  write_roadmap(build(maze, {}, few(300, PlannerKind::prm)), place("bare.roadmap"), {}, false);
  EXPECT_EQ(refusal_of(place("bare.roadmap")),
            place("bare.roadmap") + ": has no world inside; name the world that it was built for");
  EXPECT_EQ(refusal_of(place("bare.roadmap"), maze), "");
  const std::string line = refusal_of(place("bare.roadmap"), read_world("maze:9x9,seed=3"));
  EXPECT_NE(line.find("was built for the world"), std::string::npos) << line;
  EXPECT_NE(line.find("maze:9x9,seed=3 is another one"), std::string::npos) << line;
}

TEST_F(RoadmapFileIo, EveryFlippedBitOfASmallFileIsRefused) {
  const Scene walls = read_world("maze:2x2,seed=1");
  write_roadmap(build(walls, {}, few(8, PlannerKind::prm)), place("small.roadmap"));
  const std::string bytes = bytes_of(place("small.roadmap"));
  std::size_t taken = 0;
  for (const std::uint64_t first : test::seeds(4, 1, 0)) {
    for (std::size_t i = 3 * first; i < bytes.size(); i += 12) {
      std::string broken = bytes;
      broken[i] = static_cast<char>(broken[i] ^ (1 << (i % 8)));
      std::ofstream(place("broken.roadmap"), std::ios::binary) << broken;
      if (refusal_of(place("broken.roadmap")).empty()) ++taken;
    }
  }
  EXPECT_EQ(taken, 0U) << "of " << bytes.size();
}

TEST_F(RoadmapFileIo, ALazyRoadmapKeepsWhatItLearnt) {
  Roadmap built = build(read_world("maze:9x9,seed=2,loops=0.1"), {}, few(900, PlannerKind::lazy_prm));
  EXPECT_EQ(count_edges(built, {}).free, 0U);
  {
    const RoadmapQuery query(built);
    EXPECT_TRUE(query.ask({}, {}).verified);
    learn(built, query, {});
  }
  EXPECT_GT(count_edges(built, {}).free, 10U);
  write_roadmap(built, place("learnt.roadmap"));
  const Roadmap read = read_roadmap(place("learnt.roadmap"));
  const Answer answer = RoadmapQuery(read).ask({}, {});
  EXPECT_TRUE(answer.verified);
  EXPECT_LT(answer.counters.edges_checked, 60U);  // those of start and goal alone
}

}  // namespace
}  // namespace warren
