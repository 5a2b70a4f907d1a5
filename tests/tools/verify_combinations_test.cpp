// SPDX-License-Identifier: BSD-3-Clause
// `warren verify` of every body in every kind of world: a verdict or a refusal in one line, whatever is combined.
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

struct Named {
  const char* name;
  const char* text;
};

constexpr Named judged_worlds[] = {{"bounds.scene", "bounds 0 0 12 12\n"},
                                   {"walls.scene", "0 0 12 0\n0 12 12 12\n5 1 5 3\n"},
                                   {"polygon.scene", "bounds 0 0 12 12\npolygon 9 9 11 9 11 11\n"},
                                   {"box.scene", "box 3 3 3 4 4 4\n"},
                                   {"sphere.scene", "sphere 5 5 5 1\n"},
                                   {"mixed.scene", "bounds 0 0 12 12\nbox 1 1 0 3 3 1\npolygon 9 9 11 9 11 11\n"},
                                   {"a.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n"},
                                   {"none.geojson", R"({"type": "FeatureCollection", "features": []})"}};

constexpr Named bodies[] = {
    {"point", "[[0.5, 0.5], [0.5, 2.5]]"},
    {"disc 0.2", "[[0.5, 0.5], [0.5, 2.5]]"},
    {"polygon -0.2 -0.2 0.3 0 0 0.3", "[[0.5, 0.5, 0], [0.6, 0.5, 1]]"},
    {"polygon 5 5 6 5 6 6", "[[0.5, 0.5, 0]]"},
    {"car radius 0.2 turning 1", "[[0.5, 0.5, 0], [1, 0.5, 0]]"},
    {"car polygon 1 0 2 0 2 1 turning 1 steering reeds-shepp", "[[0.5, 0.5, 0], [0.4, 0.5, 0]]"},
    {"puma560 radius 0.05", "[[0, 0, 0, 0, 0, 0]]"}};

TEST(VerifyCombinations, EveryBodyInEveryWorldEndsInAVerdictOrARefusal) {
  const Folder folder;
  int verdicts = 0;
  for (const Named& world : judged_worlds) {
    const std::string file = folder.write(world.name, world.text);
    for (const Named& body : bodies) {
      const Json path = Json::parse(body.text);
      const Json answer{{"path", path}, {"start", path.front()}, {"goal", path.back()}, {"robot", body.name}};
      const Outcome outcome = run({"verify", file, folder.write("answer.json", answer.dump())});
      SCOPED_TRACE(std::string(world.name) + ", " + body.name + ": " + outcome.err);
      EXPECT_TRUE(outcome.code == 0 || outcome.code == 1 || outcome.code == 2 || outcome.code == 65) << outcome.code;
      const bool is_verdict = outcome.code < 2;
      verdicts += is_verdict ? 1 : 0;
      EXPECT_EQ(outcome.err.empty(), is_verdict);
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), is_verdict ? 0 : 1);
      const bool is_arm = std::string_view(body.name).starts_with("puma");
      const bool is_solid = std::string_view(world.text).find("sphere") != std::string_view::npos ||
                            std::string_view(world.text).find("box") != std::string_view::npos;
      if (is_arm != is_solid) {
        EXPECT_FALSE(is_verdict);
      }
    }
  }
  EXPECT_GE(verdicts, 24);
}

}  // namespace
}  // namespace warren::test
