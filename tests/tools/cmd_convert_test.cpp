// SPDX-License-Identifier: BSD-3-Clause
// convert --simplify as a process: a chain of a route graph, alone and around what a scene forbids.
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

}  // namespace
}  // namespace warren::test
