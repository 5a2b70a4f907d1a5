// SPDX-License-Identifier: BSD-3-Clause
// Maps of map_server from file to `warren info`, each with counts that were worked out by hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenes/files/test_images.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::string_literals;

/// One map: what the YAML says beside the usual keys, its image, and what is in it.
struct MapCase {
  const char* name;
  std::string yaml;  ///< complete, or lines that are added to the usual ones
  std::string image_name;
  std::string image;  ///< empty: there is none
  const char* rules;  ///< "": not said
  int free, occupied, unknown, between;
};

constexpr const char* usual = "resolution: 0.05\norigin: [-1.5, 2.0, 0.0]\n";
constexpr const char* conventional = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Greys by column, whatever the row: 3 rows of 255 205 204 102 51 0, of p 0 .196 .2 .6 .8 1.
std::string ramp_png(const PngForm& form) {
  return png_bytes(form, 6, 3, [&](unsigned x, unsigned, unsigned) {
    constexpr unsigned greys[] = {255, 205, 204, 102, 51, 0};
    return form.depth == 16 ? greys[x] * 257 : greys[x];
  });
}

/// Colours (and alpha) by column: white, black, grey 205, and white with the alpha given for all of it.
std::string colour_png(int type, unsigned last_alpha) {
  return png_bytes({type}, 4, 2, [&](unsigned x, unsigned, unsigned channel) {
    constexpr unsigned greys[] = {255, 0, 205, 255};
    const bool is_alpha = channel + 1 == channels_of(type) && channels_of(type) % 2 == 0;
    if (is_alpha) return x == 3 ? last_alpha : 255U;
    return greys[x];
  });
}

std::vector<MapCase> cases() {
  const std::string ramp = "P2\n# CREATOR: a tool 0.050 m/pix\n6 # width\n3\n#height was 3\n255\n" +
                           ("255 205 204 102 51 0\n"s + "255 205 204 102 51 0\n" + "255 205 204 102 51 0\n");
  const std::string binary = "P5\n# CREATOR: GIMP\n4 2\n255\n"s + "\xfe\xcd\x00\xfe"s + "\xfe\xcd\x00\x0a"s;
  const std::string wide = "P5 3 1 65535\n"s + "\xff\xff\x00\x00\x80\x00"s;
  const std::vector<png_color> palette{{255, 255, 255}, {0, 0, 0}, {205, 205, 205}};
  PngForm indexed{PNG_COLOR_TYPE_PALETTE, 2, false, palette};
  const std::string palette_png = png_bytes(indexed, 3, 4, [](unsigned x, unsigned, unsigned) { return x; });
  indexed.palette_alpha = {0};
  const std::string clear_png = png_bytes(indexed, 3, 4, [](unsigned x, unsigned, unsigned) { return x; });
  const auto keys = [](const std::string& more) { return usual + more; };
  return {
      {"conventional", keys(conventional), "m.pgm", ramp, "", 3, 6, 9, 0},
      {"yaw", "resolution: 0.05\norigin: [-1.5, 2.0, 1.2]\n"s + conventional, "m.pgm", ramp, "", 3, 6, 9, 0},
      {"negate", keys("negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"), "m.pgm", ramp, "", 3, 9, 6, 0},
      {"negate as a word", keys("negate: true\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"), "m.pgm", ramp, "", 3, 9,
       6, 0},
      {"thresholds of newer files", keys("negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"), "m.pgm", ramp, "", 9,
       6, 3, 0},
      {"equality counts for nav2", keys("negate: 0\noccupied_thresh: 1.0\nfree_thresh: 0.0\n"), "m.pgm", ramp, "nav2",
       3, 3, 12, 0},
      {"equality counts not for ROS 1", keys("negate: 0\noccupied_thresh: 1.0\nfree_thresh: 0.0\n"), "m.pgm", ramp,
       "ros1", 0, 0, 18, 0},
      {"scale", keys(conventional + "mode: scale\n"s), "m.pgm", ramp, "", 6, 6, 0, 6},
      {"scale of ROS 1", keys(conventional + "mode: scale\n"s), "m.pgm", ramp, "ros1", 3, 6, 0, 9},
      {"raw", keys(conventional + "mode: raw\n"s), "m.pgm", ramp, "", 3, 0, 12, 3},
      {"CRLF and comments",
       "# a map\r\nresolution: 0.05  # metres\r\norigin: [0, 0, 0]\r\nnegate: 0\r\n"
       "occupied_thresh: 0.65\r\nfree_thresh: 0.196\r\nmap_type: occupancy\r\n"s,
       "m.pgm", binary, "", 3, 3, 2, 0},
      {"16 bits", keys(conventional), "m.pgm", wide, "", 1, 1, 1, 0},
      {"grey PNG", keys(conventional), "m.png", ramp_png({}), "", 3, 6, 9, 0},
      {"grey PNG of 16 bits, interlaced", keys(conventional), "m.png", ramp_png({PNG_COLOR_TYPE_GRAY, 16, true}), "", 3,
       6, 9, 0},
      {"palette", keys(conventional), "m.png", palette_png, "", 4, 4, 4, 0},
      {"palette with a transparent entry", keys(conventional), "m.png", clear_png, "", 0, 4, 8, 0},
      {"RGBA", keys(conventional), "m.png", colour_png(PNG_COLOR_TYPE_RGB_ALPHA, 254), "", 2, 2, 4, 0},
      // ROS 1 averages alpha in: white 255, black (0 + 0 + 0 + 255) / 4 = 63.75 of p .75, grey 217.5 of p .147 is free
      {"RGBA of ROS 1", keys(conventional), "m.png", colour_png(PNG_COLOR_TYPE_RGB_ALPHA, 254), "ros1", 6, 2, 0, 0},
      {"RGB", keys(conventional), "m.png", colour_png(PNG_COLOR_TYPE_RGB, 0), "", 4, 2, 2, 0},
      {"no image", keys(conventional), "gone.pgm", "", "", 0, 0, 0, 0},
      {"no image in its folder", keys(conventional), "maps/gone.png", "", "ros1", 0, 0, 0, 0},
  };
}

TEST(RosMaps, CountsAreExactAndMissingImagesSaySo) {
  for (const MapCase& c : cases()) {
    SCOPED_TRACE(c.name);
    const Folder folder;
    if (!c.image.empty()) folder.write(c.image_name, c.image);
    std::vector<std::string> words{"info", folder.write("m.yaml", "image: " + c.image_name + "\n" + c.yaml), "--json",
                                   "-"};
    if (*c.rules != '\0') words.insert(words.end(), {"--map-rules", c.rules});
    const Outcome outcome = run(words);
    if (c.image.empty()) {
      EXPECT_EQ(outcome.code, 66);
      EXPECT_NE(outcome.err.find(c.image_name + ", the image of "), std::string::npos) << outcome.err;
      continue;
    }
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json info = Json::parse(outcome.out);
    EXPECT_EQ(info["free"], c.free);
    EXPECT_EQ(info["occupied"], c.occupied);
    EXPECT_EQ(info["unknown"], c.unknown);
    EXPECT_EQ(info["between"], c.between);
  }
}

TEST(RosMaps, PathsLieWhereOriginAndYawPutThem) {
  const Folder folder;
  folder.write("m.pgm", "P2 4 2 255\n254 254 254 254\n254 0 0 254\n");
  const std::string yaml =
      folder.write("m.yaml", "image: m.pgm\nresolution: 2\norigin: [10, 20, 1.5707963267948966]\n"s + conventional);
  // Turned by a quarter: cell (x, y) has its middle at (10 - 2 (y + .5), 20 + 2 (x + .5)).
  const Outcome outcome = run({"solve", yaml, "--start", "9,21", "--goal", "9,27", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_NEAR(answer["length"].get<double>(), 10.0, 1e-9);  // up, three along, down: the corners are closed
  EXPECT_NEAR(answer["min_clearance"].get<double>(), 1.0, 1e-9);
}

TEST(RosMaps, LengthsAreToldInMetres) {
  const Folder folder;
  folder.write("m.pgm", "P2 4 2 255\n254 254 254 254\n254 0 0 254\n");
  const std::string yaml = folder.write("m.yaml", "image: m.pgm\nresolution: 2\norigin: [10, 20, 0]\n"s + conventional);
  const std::vector<std::string> solve{"solve", yaml, "--start", "11,21", "--goal", "17,21"};
  const std::string answer = folder.path("a.json");
  const Outcome said = run(joined(solve, {"--json", answer, "--svg", folder.path("a.svg")}));
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_NE(said.out.find("10 m, "), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("1 m at least; 0 m asked for"), std::string::npos) << said.out;
  EXPECT_EQ(Json::parse(folder.read("a.json"))["world"]["unit"], "m");
  EXPECT_NE(folder.read("a.svg").find("length 10 m, clearance 1 m"), std::string::npos);
  const std::string verdict = run({"verify", yaml, answer}).out;
  EXPECT_NE(verdict.find("length 10 m, clearance 1 m at least, 0 m asked for"), std::string::npos) << verdict;
  const std::string table = run({"compare", yaml, "--start", "11,21", "--goal", "17,21", "--planners", "grid"}).out;
  EXPECT_NE(table.find("length q1 (m)"), std::string::npos) << table;
  const Outcome cells = run({"solve", "maze:5x5"});
  EXPECT_EQ(cells.out.find(" m, "), std::string::npos) << cells.out;
}

TEST(RosMaps, InfoRoundsWhatItComputesForPeopleAndNotForScripts) {
  const Folder folder;
  folder.write("m.pgm", "P2 2 1 255\n254 254\n");
  const std::string yaml =
      folder.write("m.yaml", "image: m.pgm\nresolution: 0.1\norigin: [0.1, 0.2, 0]\n"s + conventional);
  EXPECT_NE(run({"info", yaml}).out.find("0.1 to 0.3, 0.2 to 0.3\n"), std::string::npos) << run({"info", yaml}).out;
  EXPECT_EQ(Json::parse(run({"info", yaml, "--json", "-"}).out)["box"][2], 0.1 + 2 * 0.1);
}

TEST(RosMaps, RulesAreRefusedWhereTheyMeanNothing) {
  const Folder folder;
  const std::string scene = folder.write("w.scene", "bounds 0 0 6 4\nwall 2.5 1 2.5 2.5\nstart 1 1\ngoal 5 3\n");
  check({{"info", scene, "--map-rules", "ros1"}, 2, "--map-rules"});
  check({{"solve", scene, "--map-rules", "ros3"}, 2, "--map-rules"});
  check({{"compare", "--sizes", "10", "--map-rules", "ros1"}, 2, "--map-rules"});
}

}  // namespace
}  // namespace warren::test
