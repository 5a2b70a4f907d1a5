// SPDX-License-Identifier: BSD-3-Clause
// convert and export with --simplify as processes: a chain of a route graph, alone and around what a scene forbids; a
// roadmap.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/tools/program.hpp"

namespace warren::test {
namespace {

/// Eleven nodes in a row, half a metre apart, but the sixth, which is so far above them.
std::string chain(double above) {
  std::string features;
  const auto at = [&](int i) { return fmt::format("[{},{}]", 0.5 * i, i == 5 ? 2.0 + above : 2.0); };
  for (int i = 0; i <= 10; ++i) {
    features += fmt::format(
        R"({{"type":"Feature","properties":{{"id":{}}},"geometry":{{"type":"Point","coordinates":{}}}}},)", i, at(i));
  }
  for (int i = 0; i < 10; ++i) {
    for (const auto& [from, to] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
      features += fmt::format(
          R"({{"type":"Feature","properties":{{"id":{},"startid":{},"endid":{}}},"geometry":{{"type":"MultiLineString",)"
          R"("coordinates":[[{},{}]]}}}},)",
          100 + 2 * i + (from > to ? 1 : 0), from, to, at(from), at(to));
    }
  }
  features.pop_back();
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

std::size_t nodes_in(const std::string& text) {
  std::size_t nodes = 0;
  const nlohmann::json graph = nlohmann::json::parse(text);
  for (const auto& feature : graph.at("features")) {
    nodes += feature.at("geometry").at("type") == "Point" ? 1 : 0;
  }
  return nodes;
}

TEST(Convert, ARouteGraphKeepsTheNodesThatMatter) {
  const TemporaryDirectory folder;
  folder.write("chain.geojson", chain(0.05));
  folder.write("yard.scene", "bounds -1 -1 6 6\nkeep-out 2.4 1.9 2.6 1.9 2.6 2.02 2.4 2.02\n");
  const std::string from = folder.file("chain.geojson");
  const std::string to = folder.file("few.geojson");
  for (const auto& [words, nodes] :
       {std::pair{std::string("--simplify 0.1"), 2U}, std::pair{std::string("--simplify 0.01"), 5U},
        std::pair{"--simplify 0.1 --world " + folder.file("yard.scene"), 3U}}) {
    SCOPED_TRACE(words);
    const ProgramRun made = run_program(fmt::format("convert {} -o {} {}", from, to, words));
    ASSERT_EQ(made.exit_code, 0) << made.out;
    EXPECT_EQ(nodes_in(folder.read("few.geojson")), nodes);
  }
  EXPECT_EQ(run_program(fmt::format("convert {} -o {} --simplify 0.1 --robot point", from, to)).exit_code, 2);
  EXPECT_EQ(run_program(fmt::format("convert {} -o {} --simplify 0.1", from, folder.file("few.svg"))).exit_code, 2);
}

TEST(Export, ARoadmapBecomesARouteGraphOfTheNodesThatMatter) {
  const TemporaryDirectory folder;
  folder.write("yard.scene", "bounds 0 0 10 6\npolygon 3 2 7 2 7 4 3 4\nrobot disc 0.3\n");
  const std::string roadmap = folder.file("yard.roadmap");
  ASSERT_EQ(run_program(fmt::format("build {} --planner voronoi -o {}", folder.file("yard.scene"), roadmap)).exit_code,
            0);
  const std::string to = folder.file("graph.geojson");
  ASSERT_EQ(run_program(fmt::format("export {} -o {} --frame yard", roadmap, to)).exit_code, 0);
  const std::size_t all = nodes_in(folder.read("graph.geojson"));
  const ProgramRun made = run_program(fmt::format("export {} -o {} --frame yard --simplify 0.5", roadmap, to));
  ASSERT_EQ(made.exit_code, 0) << made.out;
  const std::string few = folder.read("graph.geojson");
  EXPECT_LT(nodes_in(few), all);
  EXPECT_NE(few.find("\"frame\":\"yard\""), std::string::npos) << few.substr(0, 300);
  EXPECT_NE(made.out.find(fmt::format("{} of {} nodes", nodes_in(few), all)), std::string::npos) << made.out;
  for (const char* wrong : {"--simplify 0.5 --unchecked", "--simplify -1"}) {
    EXPECT_EQ(run_program(fmt::format("export {} -o {} {}", roadmap, to, wrong)).exit_code, 2) << wrong;
  }
  EXPECT_EQ(run_program(fmt::format("export {} -o {} --simplify 1", roadmap, folder.file("g.csv"))).exit_code, 2);
}

/// It turns on the spot wherever it is: its nodes have no headings, and new edges are those of its disc.
TEST(Export, ARoundDifferentialDriveHasARouteGraphAndOtherCarsHaveNone) {
  const TemporaryDirectory folder;
  folder.write("yard.scene", "bounds 0 0 10 6\nrobot car radius 0.3 turning 0.5 steering differential\n");
  const std::string roadmap = folder.file("yard.roadmap");
  const std::string to = folder.file("graph.geojson");
  const std::string build =
      fmt::format("build {} --planner prm --samples 100 -o {}", folder.file("yard.scene"), roadmap);
  const std::string simplify = fmt::format("export {} -o {} --simplify 0.5", roadmap, to);
  ASSERT_EQ(run_program(build).exit_code, 0);
  const ProgramRun made = run_program(simplify);
  ASSERT_EQ(made.exit_code, 0) << made.out;
  EXPECT_GT(nodes_in(folder.read("graph.geojson")), 0U);
  EXPECT_EQ(folder.read("graph.geojson").find("theta"), std::string::npos);
  ASSERT_EQ(run_program(build + " --steering reeds-shepp").exit_code, 0);
  EXPECT_EQ(run_program(simplify).exit_code, 2);
}

}  // namespace
}  // namespace warren::test
