// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/plane_formats_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

struct Rules {
  std::string mode;
  bool negate;
  double free_thresh;
  double occupied_thresh;
};

std::string yaml_of(const Rules& rules, const std::string& image, const std::string& place = "[0, 0, 0]") {
  return "image: " + image + "\nresolution: 0.1\norigin: " + place + "\nnegate: " + (rules.negate ? "1" : "0") +
         "\noccupied_thresh: " + std::to_string(rules.occupied_thresh) +
         "\nfree_thresh: " + std::to_string(rules.free_thresh) + "\nmode: " + rules.mode + "\n";
}

/// As the map server of Nav2 publishes a grey of 8 bits.
int published(int grey, const Rules& rules) {
  const double shade = grey / 255.0;
  const double occupied = rules.negate ? shade : 1.0 - shade;
  if (rules.mode == "raw") return grey <= 100 ? grey : -1;
  if (occupied <= std::stod(std::to_string(rules.free_thresh))) return 0;
  if (occupied >= std::stod(std::to_string(rules.occupied_thresh))) return 100;
  if (rules.mode == "trinary") return -1;
  return static_cast<int>(
      std::round((occupied - rules.free_thresh) / (rules.occupied_thresh - rules.free_thresh) * 100));
}

/// All greys, a column each; two rows, the upper one all black.
std::string all_greys() {
  std::string pgm = "P5 256 2 255\n" + std::string(256, '\0');
  for (int grey = 0; grey < 256; ++grey) pgm += static_cast<char>(grey);
  return pgm;
}

TEST(MaskFile, ValuesAreThoseThatTheMapServerPublishes) {
  const TemporaryDirectory directory;
  directory.write("greys.pgm", all_greys());
  for (const std::string mode : {"trinary", "scale", "raw"}) {
    for (const bool negate : {false, true}) {
      for (const auto& [low, high] : {std::pair{0.196, 0.65}, std::pair{0.25, 0.25}, std::pair{0.0, 1.0}}) {
        const Rules rules{mode, negate, low, high};
        const MaskCells mask = read_mask(InputFile(directory.write("m.yaml", yaml_of(rules, "greys.pgm")), {}), {});
        ASSERT_EQ(mask.width, 256U);
        ASSERT_EQ(mask.height, 2U);
        for (int grey = 0; grey < 256; ++grey) {
          ASSERT_EQ(mask.values[static_cast<std::size_t>(grey)], published(grey, rules))
              << mode << ' ' << negate << ' ' << low << ' ' << grey;
          ASSERT_EQ(mask.values[256U + static_cast<std::size_t>(grey)], published(0, rules))
              << "the upper row is the last";
        }
      }
    }
  }
}

TEST(MaskFile, PlaceIsAsTheYamlSays) {
  const TemporaryDirectory directory;
  directory.write("greys.pgm", all_greys());
  const std::string yaml = yaml_of({"scale", false, 0.2, 0.6}, "greys.pgm", "[-3.5, 2, 0.7]");
  const MaskCells mask = read_mask(InputFile(directory.write("m.yaml", yaml), {}), {});
  EXPECT_EQ(mask.cell, 0.1);
  EXPECT_EQ(mask.origin, (Vec2{-3.5, 2.0}));
  EXPECT_EQ(mask.yaw_rad, 0.7);
}

/// What is blocked as a map is what is not 0 as a mask.
TEST(MaskFile, SameFileAsAMapBlocksWhatIsNotZero) {
  const TemporaryDirectory directory;
  directory.write("greys.pgm", all_greys());
  for (const std::string mode : {"trinary", "scale", "raw"}) {
    const std::string yaml = directory.write("m.yaml", yaml_of({mode, false, 0.196, 0.65}, "greys.pgm"));
    const MaskCells mask = read_mask(InputFile(yaml, {}), {});
    const OccupancyMap map = read_ros_map(InputFile(yaml, {}), {});
    for (std::uint32_t x = 0; x < 256; ++x) EXPECT_EQ(map.blocked.test(x, 0), mask.values[x] != 0) << mode << ' ' << x;
  }
}

TEST(MaskFile, KeepOutTakesPolygonsOfOtherFiles) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("zones.scene", "polygon 0 0 1 0 1 1\npolygon 2 2 3 2 3 3\n");
  const std::string geo =
      directory.write("zones.geojson", R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]})");
  Prices prices;
  prices.masks = {{.kind = MaskKind::keep_out, .file = scene},
                  {.kind = MaskKind::keep_out, .file = geo, .factor = 4.0}};
  read_masks(prices, {});
  EXPECT_TRUE(prices.masks.empty());
  ASSERT_EQ(prices.keep_out.size(), 2U);
  EXPECT_EQ(prices.keep_out[1].corners[1], (Vec2{3, 2}));
  ASSERT_EQ(prices.areas.size(), 1U);
  EXPECT_EQ(prices.areas[0].factor, 4.0);
}

TEST(MaskFile, KeepOutTakesForbiddenAreasOfScenes) {
  const TemporaryDirectory directory;
  Prices prices;
  prices.masks = {
      {.kind = MaskKind::keep_out, .file = directory.write("a.scene", "polygon 0 0 1 0 1 1\nkeep-out 2 2 3 2 3 3\n")},
      {.kind = MaskKind::keep_out, .file = directory.write("b.scene", "keep-out 5 5 6 5 6 6\n")}};
  read_masks(prices, {});
  ASSERT_EQ(prices.keep_out.size(), 3U);
  EXPECT_EQ(prices.keep_out[1].corners[1], (Vec2{3, 2}));
  EXPECT_EQ(prices.keep_out[2].corners[0], (Vec2{5, 5}));
  prices.masks = {
      {.kind = MaskKind::keep_out, .file = directory.write("c.scene", "polygon 0 0 1 0 1 1\nmask m.yaml keep-out\n")}};
  EXPECT_NE(test::refusal<InputError>([&] { read_masks(prices, {}); }).find("c.scene: has a `mask` line"),
            std::string::npos);
}

/// Along the cuts of a polygon with a hole nothing would be paid.
TEST(MaskFile, AFactorTakesNoPolygonWithHoles) {
  const TemporaryDirectory directory;
  const std::string ring = directory.write(
      "ring.geojson",
      R"({"type": "Polygon", "coordinates": [[[0,0],[9,0],[9,9],[0,9],[0,0]],[[3,3],[3,6],[6,6],[6,3],[3,3]]]})");
  Prices prices;
  prices.masks = {{.kind = MaskKind::keep_out, .file = ring, .factor = 4.0}};
  EXPECT_NE(test::refusal<InputError>([&] { read_masks(prices, {}); }).find("ring.geojson: has polygons with holes"),
            std::string::npos);
  prices = {};
  prices.masks = {{.kind = MaskKind::keep_out, .file = ring}};
  read_masks(prices, {});
  EXPECT_GE(prices.keep_out.size(), 2U);
}

TEST(MaskFile, WhatIsNoMaskIsRefused) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("zones.scene", "polygon 0 0 1 0 1 1\n");
  const auto expect_refusal = [](const PriceMask& mask, const std::string& words) {
    Prices prices;
    prices.masks = {mask};
    const std::string said = test::refusal<Error>([&] { read_masks(prices, {}); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect_refusal({.kind = MaskKind::speed, .file = scene}, "zones.scene: a mask is the YAML of a map server");
  expect_refusal({.kind = MaskKind::keep_out, .file = directory.write("walls.scene", "0 0 1 1\n")},
                 "walls.scene: has no polygons to keep out of");
  expect_refusal({.kind = MaskKind::areas, .file = directory.file("none.yaml"), .factor = 2.0},
                 "none.yaml: can't be read");
}

/// A scene that names itself as its own zones ends, too.
TEST(MaskFile, SceneMayNameItself) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("self.scene", "polygon 0 0 1 0 1 1\nmask self.scene keep-out\n");
  const Scene scene = read_world(file);
  EXPECT_EQ(scene.prices.keep_out.size(), 1U);
}

TEST(SceneOfPrices, LinesAreReadAndWrittenBack) {
  const TemporaryDirectory directory;
  directory.write("my mask.pgm", all_greys());
  directory.write("my mask.yaml", yaml_of({"raw", false, 0.2, 0.6}, "\"my mask.pgm\""));
  const std::string file = directory.write("a.scene",
                                           "polygon 0 0 1 0 1 1\n"
                                           "start 5 5\ngoal 1 2\ngoal 3 4\ngoal 5 6\n"
                                           "clearance-price 3 0.5\n"
                                           "area 2.5 0 0 4 0 4 4\n"
                                           "keep-out 7 7 8 7 8 8\n"
                                           "mask my\\x20mask.yaml areas 5\n"
                                           "mask my\\x20mask.yaml speed\n"
                                           "mask my\\x20mask.yaml speed 80 -0.5\n"
                                           "mask my\\x20mask.yaml keep-out 9\n"
                                           "unknown 2\n");
  const Scene scene = read_world(file);
  const Prices& prices = scene.prices;
  EXPECT_EQ(scene.goal, (std::vector<double>{1, 2}));
  EXPECT_EQ(scene.other_goals, (std::vector<std::vector<double>>{{3, 4}, {5, 6}}));
  EXPECT_EQ(prices.clearance->price, 3.0);
  EXPECT_EQ(prices.clearance->reach, 0.5);
  ASSERT_EQ(prices.areas.size(), 1U);
  EXPECT_EQ(prices.areas[0].line, 7U);
  ASSERT_EQ(prices.masks.size(), 4U);
  for (const PriceMask& mask : prices.masks) ASSERT_TRUE(mask.read) << mask.file;
  EXPECT_EQ(prices.masks[0].read->values[60], 60);
  EXPECT_EQ(prices.masks[1].base, 100.0);
  EXPECT_EQ(prices.masks[2].multiplier, -0.5);
  EXPECT_EQ(prices.masks[3].factor, 9.0);
  EXPECT_EQ(prices.unknown, 2.0);
  const std::string again = directory.file("b.scene");
  write_scene_text(scene, again, {});
  const std::string thrice = directory.file("c.scene");
  write_scene_text(read_world(again), thrice, {});
  EXPECT_EQ(InputFile(again, {}).bytes(), InputFile(thrice, {}).bytes());
  EXPECT_NE(InputFile(again, {}).bytes().find("\nmask my\\x20mask.yaml areas 5\n"), std::string_view::npos);
}

TEST(SceneOfPrices, WrongLinesAreRefusedWithTheirPlace) {
  const TemporaryDirectory directory;
  for (const std::string line : {"clearance-price",
                                 "clearance-price -1 2",
                                 "clearance-price 1 0",
                                 "clearance-price 20000 1",
                                 "clearance-price 1 2 3",
                                 "area",
                                 "area 0.5 0 0 1 0 1 1",
                                 "area 2 0 0 1 0",
                                 "area 2 0 0 1 0 1",
                                 "area 2 0 0 1 1 2 2",
                                 "area x 0 0 1 0 1 1",
                                 "area 2 0 0 1 1 1 0 0 1",
                                 "keep-out 0 0 1 0",
                                 "unknown",
                                 "unknown 0",
                                 "unknown blocked",
                                 "mask",
                                 "mask a.yaml",
                                 "mask a.yaml areas",
                                 "mask a.yaml areas 0",
                                 "mask a.yaml speed 1",
                                 "mask a.yaml speed 1 2 3",
                                 "mask a.yaml other",
                                 "mask a.yaml keep-out 1 2",
                                 "area 1e61 0 0 1 0 1 1"}) {
    try {
      read_scene_text(InputFile(directory.write("a.scene", "0 0 1 1\n" + line + "\n"), {}), {});
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.where()).ends_with("a.scene:2")) << error.what();
    }
  }
  EXPECT_THROW(read_scene_text(InputFile(directory.write("a.scene", "0 0 1 1\nunknown 2\nunknown 3\n"), {}), {}),
               InputError);
  EXPECT_THROW(read_scene_text(InputFile(directory.write("a.scene", "goal 1 2\ngoal 1 2 3 4 5 6\n"), {}), {}),
               InputError);
}

/// Whatever is broken in it, a scene or a mask is read or refused in one line.
TEST(SceneOfPrices, BrokenFilesAreReadOrRefused) {
  const TemporaryDirectory directory;
  const std::string yaml = yaml_of({"scale", false, 0.2, 0.6}, "g.pgm");
  const std::string pgm = "P2 4 3 255\n0 10 20 255\n30 40 50 60\n70 80 90 100\n";
  const std::string scene =
      "polygon 0 0 4 0 4 4 0 4\nclearance-price 3 0.5\narea 2 0 0 1 0 1 1\nmask m.yaml areas 5\nunknown 2\n";
  for (const std::uint64_t seed : test::seeds(1000, 60)) {
    std::mt19937_64 random(seed);
    std::string files[] = {scene, yaml, pgm};
    std::string& broken = files[random() % 3];
    for (std::uint64_t k = 1 + random() % 4; k > 0; --k) {
      const std::size_t at = random() % broken.size();
      switch (random() % 4) {
        case 0:
          broken[at] = static_cast<char>(random());
          break;
        case 1:
          broken.erase(at, 1 + random() % 8);
          break;
        case 2:
          broken.insert(at, broken.substr(random() % broken.size(), random() % 12));
          break;
        default:
          broken.insert(at, std::string("-9e9").substr(random() % 4));
      }
      if (broken.empty()) broken = " ";
    }
    directory.write("m.yaml", files[1]);
    directory.write("g.pgm", files[2]);
    try {
      const Scene read = read_world(directory.write("a.scene", files[0]));
      for (const PriceMask& mask : read.prices.masks) {
        ASSERT_TRUE(mask.read);
        for (const std::int8_t value : mask.read->values) ASSERT_TRUE(value >= -1 && value <= 100) << seed;
      }
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << seed;
    }
  }
}

}  // namespace
}  // namespace warren
