// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/plane_formats_io.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/files/test_images.hpp"

namespace warren {
namespace {

std::string yaml_text(const std::string& more = "", const std::string& image = "map.pgm") {
  return "image: " + image + "\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\noccupied_thresh: 0.65\n" +
         "free_thresh: 0.196\n" + (more.find("negate") == std::string::npos ? "negate: 0\n" : "") + more;
}

/// A directory with one map whose image has these pixels.
class Fixture {
 public:
  explicit Fixture(const std::string& pgm) { directory_.write("map.pgm", pgm); }
  OccupancyMap read(const std::string& yaml, MapServerRules rules = MapServerRules::nav2) const {
    return read_ros_map(InputFile(directory_.write("map.yaml", yaml), {}), {}, rules);
  }
  const TemporaryDirectory& directory() const { return directory_; }

 private:
  TemporaryDirectory directory_;
};

struct Counts {
  std::uint64_t free, occupied, unknown, between;
  friend bool operator==(const Counts&, const Counts&) = default;
};
Counts counts_of(const OccupancyMap& map) { return {map.free, map.occupied, map.unknown_count, map.between}; }
std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.free << " free, " << c.occupied << " occupied, " << c.unknown << " unknown, " << c.between;
}

TEST(RosMap, TheImagesFirstRowIsTheMapsLast) {
  const Fixture fixture("P2 3 2 255\n0 254 205\n254 254 254\n");
  const OccupancyMap map = fixture.read(yaml_text());
  EXPECT_EQ(counts_of(map), (Counts{4, 1, 1, 0}));
  EXPECT_TRUE(map.blocked.test(0, 1));
  EXPECT_FALSE(map.blocked.test(1, 1));
  EXPECT_TRUE(map.blocked.test(2, 1));
  EXPECT_TRUE(map.unknown.test(2, 1));
  EXPECT_FALSE(map.unknown.test(0, 1));
  for (std::uint32_t x = 0; x < 3; ++x) EXPECT_FALSE(map.blocked.test(x, 0));
  EXPECT_NEAR(cell_centre(map, {2, 0}).x, -1.0 + 0.125, 1e-12);
  EXPECT_NEAR(cell_centre(map, {2, 0}).y, 2.025, 1e-12);
}

TEST(RosMap, OriginIsTheLowerLeftCornerTurnedByTheYaw) {
  const Fixture fixture("P2 4 2 255\n254 254 254 254\n254 254 254 254\n");
  std::string yaml = yaml_text();
  yaml.replace(yaml.find("0.0]"), 3, std::to_string(std::numbers::pi / 2));
  const OccupancyMap map = fixture.read(yaml);
  const Vec2 p = cell_centre(map, {3, 0});  // 3.5 cells along x, which points along the world's y
  EXPECT_NEAR(p.x, -1.0 - 0.025, 1e-6);
  EXPECT_NEAR(p.y, 2.0 + 0.175, 1e-6);
  EXPECT_EQ(cell_at(map, p), (Cell{3, 0}));
  EXPECT_FALSE(cell_at(map, {-1.0 + 0.01, 2.01}));
  yaml = yaml_text();
  yaml.replace(yaml.find("-1.0"), 4, "+1e-400");
  EXPECT_NEAR(cell_centre(fixture.read(yaml), {0, 0}).x, 0.025, 1e-12);
}

TEST(RosMap, ThresholdsNegateAndModesFollowTheServersRules) {
  // p = 1 - v / 255: 255 0, 205 0.196078, 204 0.2, 102 0.6, 51 0.8, 0 1
  const Fixture fixture("P2 6 1 255\n255 205 204 102 51 0\n");
  struct Case {
    const char* keys;
    MapServerRules rules;
    Counts expected;
  };
  const std::string head = "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\n";
  const Case cases[] = {
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n", MapServerRules::nav2, {1, 2, 3, 0}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n", MapServerRules::ros1, {1, 2, 3, 0}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.25\nnegate: false\n", MapServerRules::nav2, {3, 2, 1, 0}},
      {"occupied_thresh: 1.0\nfree_thresh: 0.0\nnegate: 0\n", MapServerRules::nav2, {1, 1, 4, 0}},  // equality counts
      {"occupied_thresh: 1.0\nfree_thresh: 0.0\nnegate: 0\n", MapServerRules::ros1, {0, 0, 6, 0}},  // and here not
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 1\n", MapServerRules::nav2, {1, 3, 2, 0}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: true\n", MapServerRules::ros1, {1, 3, 2, 0}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\nmode: scale\n", MapServerRules::nav2, {2, 2, 0, 2}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\nmode: scale\n", MapServerRules::ros1, {1, 2, 0, 3}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\nmode: raw\n", MapServerRules::nav2, {1, 0, 4, 1}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 1\nmode: raw\n", MapServerRules::nav2, {1, 0, 4, 1}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 1\nmode: raw\n", MapServerRules::ros1, {1, 0, 3, 2}},
      {"occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\nmode: trinary\nmap_type: x\n",
       MapServerRules::nav2,
       {1, 2, 3, 0}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.keys);
    EXPECT_EQ(counts_of(fixture.read(head + c.keys, c.rules)), c.expected);
  }
}

TEST(RosMap, AlphaIsUnknownForNav2AndOneMoreColourForRos1) {
  const TemporaryDirectory directory;
  // grey 255 with alpha 255, 254, 0; grey 0 with alpha 255, 254, 0
  const auto sample = [](unsigned x, unsigned, unsigned channel) {
    constexpr unsigned alpha[] = {255, 254, 0};
    return channel == 1 ? alpha[x % 3] : x < 3 ? 255U : 0U;
  };
  directory.write("a.png", png_bytes({PNG_COLOR_TYPE_GRAY_ALPHA}, 6, 1, sample));
  const auto read = [&](const std::string& more, MapServerRules rules) {
    return counts_of(read_ros_map(InputFile(directory.write("m.yaml", yaml_text(more, "a.png")), {}), {}, rules));
  };
  EXPECT_EQ(read("", MapServerRules::nav2), (Counts{1, 1, 4, 0}));
  EXPECT_EQ(read("mode: scale\n", MapServerRules::nav2), (Counts{1, 1, 4, 0}));
  EXPECT_EQ(read("", MapServerRules::ros1), (Counts{2, 1, 3, 0}));  // means 255 254.5 127.5 127.5 127 0
  EXPECT_EQ(read("mode: scale\n", MapServerRules::ros1), (Counts{3, 3, 0, 0}));
}

TEST(RosMap, ColoursCountByTheirLumaForNav2AndByTheirMeanForRos1PalettesToo) {
  const TemporaryDirectory directory;
  const std::vector<png_color> palette{{255, 255, 255}, {0, 0, 0}, {205, 205, 205}, {255, 255, 100}};
  directory.write("map.pgm", png_bytes({PNG_COLOR_TYPE_PALETTE, 2, true, palette}, 8, 8,
                                       [](unsigned x, unsigned, unsigned) { return x % 4; }));
  const InputFile yaml(directory.write("map.yaml", yaml_text()), {});
  const OccupancyMap map = read_ros_map(yaml, {});
  EXPECT_EQ(counts_of(map), (Counts{32, 16, 16, 0}));  // the luma of the last one is 237
  for (std::uint32_t x = 0; x < 8; ++x) EXPECT_EQ(map.blocked.test(x, 3), x % 4 == 1 || x % 4 == 2);
  EXPECT_EQ(counts_of(read_ros_map(yaml, {}, MapServerRules::ros1)), (Counts{16, 16, 32, 0}));  // its mean is 203
}

/// Pixels with the grey that GraphicsMagick 1.3.40 gave them by the calls of Nav2's map_io: type(GrayscaleType), then
/// write(…, "I", CharPixel, …).
TEST(RosMap, PixelsOfNav2AreTheGreysOfItsLibrary) {
  struct Case {
    int type;
    int depth;
    std::array<unsigned, 3> colours;
    int grey;
  };
  const Case cases[] = {
      {PNG_COLOR_TYPE_RGB, 8, {152, 11, 184}, 72},
      {PNG_COLOR_TYPE_RGB, 8, {154, 1, 173}, 66},
      {PNG_COLOR_TYPE_RGB, 8, {192, 4, 231}, 86},
      {PNG_COLOR_TYPE_RGB, 8, {41, 207, 16}, 135},
      {PNG_COLOR_TYPE_RGB, 8, {255, 0, 0}, 76},
      {PNG_COLOR_TYPE_RGB, 8, {205, 205, 205}, 205},
      {PNG_COLOR_TYPE_RGB, 16, {29076, 12364, 56999}, 87},
      {PNG_COLOR_TYPE_RGB, 16, {27808, 24364, 20285}, 97},
      {PNG_COLOR_TYPE_GRAY, 16, {7704}, 29},
      {PNG_COLOR_TYPE_GRAY, 16, {47027}, 182},
      {PNG_COLOR_TYPE_GRAY, 16, {53707}, 208},
      {PNG_COLOR_TYPE_GRAY, 8, {205}, 205},
  };
  const TemporaryDirectory directory;
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::Message() << c.depth << " " << c.colours[0] << " " << c.grey);
    directory.write("a.png", png_bytes({c.type, c.depth}, 1, 1,
                                       [&](unsigned, unsigned, unsigned channel) { return c.colours[channel]; }));
    const auto is_free_from = [&](double grey) {  // to the occupied fraction below which free is
      const std::string keys = "image: a.png\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 1\n";
      const std::string yaml = keys + "free_thresh: " + std::to_string(1.0 - grey / 255.0);
      return read_ros_map(InputFile(directory.write("m.yaml", yaml), {}), {}).free == 1;
    };
    EXPECT_TRUE(is_free_from(c.grey - 0.5));
    EXPECT_FALSE(is_free_from(c.grey + 0.5));
  }
}

TEST(RosMap, TheModeMayBeInAnyLetterCase) {
  const Fixture fixture("P2 6 1 255\n255 205 204 102 51 0\n");
  for (const char* mode : {"Trinary", "TRINARY", "trinary"}) {
    EXPECT_EQ(counts_of(fixture.read(yaml_text("mode: " + std::string(mode) + "\n"))), (Counts{1, 2, 3, 0})) << mode;
  }
  EXPECT_EQ(counts_of(fixture.read(yaml_text("mode: Scale\n"))), (Counts{2, 2, 0, 2}));
  EXPECT_EQ(counts_of(fixture.read(yaml_text("mode: Raw\n"))), (Counts{1, 0, 4, 1}));
}

/// What ends in .yaml is one, though its braces look like JSON.
TEST(RosMap, KeysMayStandInBraces) {
  const Fixture fixture("P2 3 1 255\n0 254 205\n");
  for (
      const char* text :
      {"{image: map.pgm, resolution: 0.5, origin: [0, 0, 0], negate: false, occupied_thresh: .65, free_thresh: .196}",
       R"({"image": "map.pgm", "resolution": 0.5, "origin": [0, 0, 0], "negate": 0, "occupied_thresh": 0.65, "free_thresh": 0.196})"}) {
    EXPECT_EQ(counts_of(fixture.read(text)), (Counts{1, 1, 1, 0})) << text;
    EXPECT_EQ(format_of(InputFile(fixture.directory().write("a.yml", text), {})), WorldFormat::ros_map);
  }
}

TEST(RosMap, TheImageIsFoundBesideTheYamlOrByItsAbsolutePath) {
  const Fixture fixture("P2 1 1 255\n254\n");
  EXPECT_EQ(fixture.read(yaml_text()).free, 1U);
  EXPECT_EQ(fixture.read(yaml_text("", fixture.directory().file("map.pgm"))).free, 1U);
  EXPECT_EQ(fixture.read(yaml_text("", "\"./map.pgm\"\r")).free, 1U);
}

TEST(RosMap, AMissingImageIsAReadErrorThatNamesBoth) {
  const Fixture fixture("P2 1 1 255\n254\n");
  EXPECT_EQ(test::refusal<ReadError>([&] { fixture.read(yaml_text("", "gone.pgm")); }),
            fixture.directory().file("gone.pgm") + ", the image of " + fixture.directory().file("map.yaml") +
                ": can't be read: No such file or directory");
}

TEST(RosMap, WhateverItsNameAMapIsReadBackFromWhatIsWritten) {
  const Fixture fixture("P2 2 1 255\n254 0\n");
  const OccupancyMap map = fixture.read(yaml_text());
  for (const std::string name :
       {"plain-1_a", "a #b",   "a: b", "- a",   "-a",   "a\"b\\c",   "[a",   "'a'",
        "*a",        "&a",     "%a",   "  a",   "a\tb", "a\x1b[2Jb", "a\nb", "\xc3\xa4 \xf0\x9f\x90\xad",
        "~a",        "{a, b}", "null", "a\xff", ""}) {
    SCOPED_TRACE(name);
    const std::string path = fixture.directory().file(name + ".yaml");
    write_ros_map(map, path, {});
    EXPECT_EQ(read_ros_map(InputFile(path, {}), {}).blocked, map.blocked);
  }
  EXPECT_NE(fixture.directory().read("plain-1_a.yaml").find("image: plain-1_a.pgm\n"), std::string::npos);
}

TEST(RosMap, RefusesBadKeysWithFileAndLine) {
  const Fixture fixture("P2 1 1 255\n254\n");
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = yaml_text();
    return text.replace(text.find(from), from.size(), to);
  };
  const std::pair<std::string, std::string> cases[] = {
      {with("image: map.pgm", "picture: map.pgm"), ": the key `image` is missing"},
      {with("resolution: 0.05\n", ""), ": the key `resolution` is missing"},
      {with("negate: 0\n", ""), ": the key `negate` is missing"},
      {with("0.05", "0"), ":2: `resolution` must be a number above 0 (found: 0)"},
      {with("0.05", "-1"), ":2: `resolution` must be a number above 0 (found: -1)"},
      {with("0.05", ".nan"), ":2: `resolution` must be a number above 0"},
      {with("0.05", "fine"), ":2: `resolution` must be a number above 0 (found: fine)"},
      {with(", 0.0]", "]"), ":3: `origin` must be three numbers, [x, y, yaw]"},
      {with("0.0]", "0.0, 1]"), ":3: `origin` must be three numbers, [x, y, yaw]"},
      {with("0.0]", "north]"), ":3: `origin` must be three numbers, [x, y, yaw] (found: north)"},
      {with("2.0", "+-2"), ":3: `origin` must be three numbers, [x, y, yaw] (found: +-2)"},
      {with("0.65", "1.5"), ":4: `occupied_thresh` must be a number from 0 to 1 (found: 1.5)"},
      {with("0.196", "0.7"), ": `free_thresh` must not be above `occupied_thresh`"},
      {with("negate: 0", "negate: 2"), ":6: `negate` must be 0 or 1 (found: 2)"},
      {yaml_text("mode: grey\n"), ":7: `mode` must be trinary, scale or raw (found: grey)"},
      {with("origin: [", "origin: [["), "expected YAML"},
      {"- image: a\n", "expected a map server's YAML"},
  };
  for (const auto& [yaml, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string said = test::refusal<InputError>([&, &yaml = yaml] { fixture.read(yaml); });
    EXPECT_EQ(said.find(fixture.directory().file("map.yaml")), 0U) << said;
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace warren
