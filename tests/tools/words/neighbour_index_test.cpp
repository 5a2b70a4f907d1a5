// SPDX-License-Identifier: BSD-3-Clause
// --neighbour-index: another way to the same path, for points and discs; other bodies are told that there is one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren {
namespace {

using test::joined;
using test::run;
using Json = nlohmann::ordered_json;

TEST(NeighbourIndex, GivesTheSamePath) {
  const std::vector<std::string> town{
      "solve", test::world_file("town.geojson"), "--samples", "500", "--start", "1.5,1.5", "--goal", "9.5,8.5"};
  const std::vector<std::string> maze{"solve", "maze:12x12,seed=4", "--sampler", "uniform"};
  const std::vector<std::string> map{"solve",     test::world_file("flat.yaml"),
                                     "--robot",   "disc 0.1",
                                     "--samples", "400",
                                     "--start",   "0.5,0.5",
                                     "--goal",    "4.3,0.5"};
  for (const auto& world : {town, maze, map}) {
    for (const char* planner : {"prm", "lazy-prm"}) {
      for (const std::vector<std::string>& rule : {std::vector<std::string>{}, {"--neighbours", "8"}}) {
        const auto words = joined(joined(world, {"--planner", planner, "--json", "-"}), rule);
        const Json usual = Json::parse(run(words).out);
        for (const char* index : {"kd-tree", "grid", "brute", "auto"}) {
          const auto found = run(joined(words, {"--neighbour-index", index}));
          SCOPED_TRACE(planner + std::string(" ") + index + found.err);
          const Json answer = Json::parse(found.out);
          EXPECT_EQ(answer["options"]["neighbour_index"], index);
          EXPECT_EQ(answer["path"], usual["path"]);
          EXPECT_EQ(answer["counters"], usual["counters"]);
        }
      }
    }
  }
}

TEST(NeighbourIndex, OfOtherBodiesAndKeptRoadmapsThereIsOne) {
  const auto car = run({"solve", test::world_file("car-20.scene"), "--planner", "prm", "--neighbour-index", "grid"});
  EXPECT_EQ(car.code, 2);
  EXPECT_NE(car.err.find("--neighbour-index"), std::string::npos) << car.err;
  const auto kept = run({"build", "maze:5x5", "--neighbour-index", "grid", "-o", "/dev/null"});
  EXPECT_EQ(kept.code, 2);
  EXPECT_NE(kept.err.find("--neighbour-index"), std::string::npos) << kept.err;
}

TEST(NeighbourIndex, QueryDoesNotSendToBuildWhatBuildRefuses) {
  for (const auto& [option, value] :
       {std::pair{"--neighbour-index", "grid"}, {"--pipeline", "plain"}, {"--step", "1"}}) {
    const auto build = run({"build", "maze:5x5", option, value, "-o", "/dev/null"});
    const auto query = run({"query", "none.roadmap", option, value});
    EXPECT_EQ(query.code, 2);
    EXPECT_EQ(query.err.substr(0, query.err.find(" (see")), build.err.substr(0, build.err.find(" (see")));
  }
  EXPECT_NE(run({"query", "none.roadmap", "--samples", "9"}).err.find("warren build"), std::string::npos);
}

}  // namespace
}  // namespace warren
