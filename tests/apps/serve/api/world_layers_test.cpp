// SPDX-License-Identifier: BSD-3-Clause
// Layers by the interface: which there are, why others are not, and that nobody keeps those of another roadmap.
#include "apps/serve/api/world_layers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/serve/api/world_service.hpp"
#include "scenes/text/human_units.hpp"
#include "tests/apps/serve/tiles/read_inks.hpp"
#include "tests/apps/serve/town.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren::serve {
namespace {

using Json = nlohmann::json;

HttpResponse asked(const std::unique_ptr<HttpService>& service, const HttpRequest& request) {
  try {
    service->most_body(request);
    if (auto said = service->at_once(request, {})) return *said;
  } catch (const HttpError& error) {
    return error_response(error);
  }
  const SignalFlag flag{0};
  return answer_of(*service, request, flag);
}

std::string tag_of(const HttpResponse& response) { return response.fields.empty() ? "" : response.fields[0].second; }

Json layer_of(const std::unique_ptr<HttpService>& service, const std::string& name) {
  const Json world = Json::parse(asked(service, {.path = "/api/world"}).body);
  for (const Json& layer : world.at("layers")) {
    if (layer.at("name") == name) return layer;
  }
  return {};
}

Json legend_of(const std::unique_ptr<HttpService>& service, const std::string& name) {
  return Json::parse(asked(service, {.path = "/" + layer_of(service, name).at("legend").get<std::string>()}).body);
}

TEST(WorldLayers, AWorldWithoutARoadmapSaysWhyItHasNone) {
  const ServedWorld world(scene_of(town), {}, {});
  const auto service = world_service(world, {});
  for (const char* name : {"roadmap", "components"}) {
    const Json layer = layer_of(service, name);
    EXPECT_EQ(layer.at("there"), false);
    EXPECT_NE(layer.at("why").get<std::string>().find("warren build"), std::string::npos);
    const HttpResponse refused = asked(service, {.path = "/v/" + world.hash() + "/layers/" + name + "/0/0/0.png"});
    EXPECT_EQ(refused.status, 400U);
    EXPECT_EQ(Json::parse(refused.body).at("error").at("code"), "usage");
    EXPECT_EQ(asked(service, {.path = "/v/" + world.hash() + "/layers/" + name + "/legend"}).status, 400U);
  }
}

TEST(WorldLayers, ARoadmapHasBothAndATagOfWhatIsDrawn) {
  const ServedWorld world(build(scene_of(town)), {});
  const auto service = world_service(world, {});
  const std::string whole = "/v/" + world.hash() + "/layers/roadmap/0/0/0.png";
  const HttpResponse first = asked(service, {.path = whole});
  ASSERT_EQ(first.status, 200U) << first.body;
  EXPECT_EQ(first.type, "image/png");
  EXPECT_EQ(layer_of(service, "components").at("there"), true);
  ASSERT_TRUE(service->at_once({.path = whole}, {}));
  EXPECT_EQ(service->at_once({.path = whole}, {})->body, first.body) << "kept";
  EXPECT_EQ(asked(service, {.path = whole, .if_none_match = tag_of(first)}).status, 304U);
  const HttpResponse components = asked(service, {.path = "/v/" + world.hash() + "/layers/components/0/0/0.png"});
  EXPECT_EQ(components.status, 200U);
  EXPECT_NE(components.body, first.body);

  const ServedWorld other(build(scene_of(town), {}, {.seed = 5}), {});
  ASSERT_EQ(other.hash(), world.hash());
  const auto again = world_service(other, {});
  EXPECT_EQ(asked(again, {.path = whole, .if_none_match = tag_of(first)}).status, 200U) << "another roadmap";
}

TEST(WorldLayers, AnEdgeIsInkAndWhatThereIsNoRoomForIsNone) {
  const ServedWorld world(build(scene_of(town)), {});
  const auto service = world_service(world, {});
  const TileGrid& grid = world.tiles().grid();
  constexpr unsigned zoom = 3;
  const auto opacity_at = [&](Vec2 p) {
    const double side = grid.pixel(zoom) * TileGrid::pixels;
    const double x = (p.x - grid.corner.x) / side;
    const double y = (grid.corner.y - p.y) / side;
    const std::string url = "/v/" + world.hash() + "/layers/roadmap/3/" + std::to_string(static_cast<int>(x)) + "/" +
                            std::to_string(static_cast<int>(y)) + ".png";
    const auto of = [](double in) { return static_cast<std::size_t>((in - std::floor(in)) * TileGrid::pixels); };
    return test::read_inks(asked(service, {.path = url}).body)[of(y) * TileGrid::pixels + of(x)][3];
  };
  const RoadmapParts parts = world.query()->roadmap().arrays.parts();
  const auto at = [&](VertexId v) { return Vec2{parts.state(v)[0], parts.state(v)[1]}; };
  unsigned seen = 0;
  for (VertexId v = 0; v < parts.vertex_count() && seen < 5; v += 7) {
    const std::size_t end = parts.first[v];
    if (end == parts.first[v + 1] || parts.state_of_end(end) != EdgeState::free) continue;
    EXPECT_GT(opacity_at(0.5 * (at(v) + at(parts.to[end]))), 60U);
    ++seen;
  }
  EXPECT_EQ(seen, 5U);
  for (const Vec2 inside : {Vec2{75, 30}, {62, 12}, {88, 48}}) EXPECT_EQ(opacity_at(inside), 0U);
}

TEST(WorldLayers, TheLegendHasFigures) {
  const ServedWorld world(build(scene_of("bounds 0 0 100 60\nwall 50 -1 50 61\n")), {});
  const auto service = world_service(world, {});
  const RoadmapParts parts = world.query()->roadmap().arrays.parts();
  const auto words = [&](const std::string& name, std::size_t i) {
    return legend_of(service, name).at(i).at("words").get<std::string>();
  };
  EXPECT_TRUE(words("roadmap", 0)
                  .starts_with(counted(parts.vertex_count(), "milestone", "milestones") + " and " +
                               counted(count_edges(world.query()->roadmap(), {}).free, "free edge", "free edges")))
      << words("roadmap", 0);
  std::map<VertexId, std::uint64_t> sizes;
  for (const VertexId root : parts.component) ++sizes[root];
  ASSERT_EQ(sizes.size(), 2U) << "one on each side of the wall";
  const std::uint64_t most = std::max(sizes.begin()->second, sizes.rbegin()->second);
  EXPECT_EQ(words("components", 0), "largest: " + counted(most, "milestone", "milestones"));
  EXPECT_EQ(words("components", 1), "number 2: " + counted(parts.vertex_count() - most, "milestone", "milestones"));
  EXPECT_EQ(legend_of(service, "components").size(), 2U);
}

TEST(WorldLayers, ClearanceIsThereForWorldsOfEveryKindAndItsLegendSaysWhatUnit) {
  const TemporaryDirectory folder;
  folder.write("a.map", "type octile\nheight 3\nwidth 4\nmap\n....\n..@.\n....\n");
  for (const std::string source : {"maze:20x20,seed=3", "maze:300x300,seed=3", "a.map"}) {
    SCOPED_TRACE(source);
    const ServedWorld world(read_world(source == "a.map" ? folder.file("a.map") : source, {}), {}, {});
    const auto service = world_service(world, {});
    const Json layer = layer_of(service, "clearance");
    ASSERT_EQ(layer.at("there"), true);
    const std::string zoom = std::to_string(layer.at("from_zoom").get<unsigned>());
    const std::string path = "/v/" + world.hash() + "/layers/clearance/" + zoom + "/0/0.png";
    const HttpResponse drawn = asked(service, {.path = path});
    ASSERT_EQ(drawn.status, 200U) << drawn.body;
    std::size_t inked = 0;
    for (const test::InkPixel& pixel : test::read_inks(drawn.body)) inked += pixel[3] > 0 ? 1 : 0;
    EXPECT_GT(inked, 10'000U);
    EXPECT_NE(inked, test::read_inks(drawn.body).size()) << "nothing outside of the world";
    const Json legend = legend_of(service, "clearance");
    const bool has_clearance = world.clearance() > 0.0;  // mazes of the course
    EXPECT_TRUE(legend.front().at("words").get<std::string>().starts_with(has_clearance ? "nearer than " : "0 to "));
    EXPECT_TRUE(legend.back().at("words").get<std::string>().ends_with(" cells and more"));
  }
}

TEST(WorldLayers, ClearanceSaysWhereADiscDoesNotFitAndWhyACrowdHasNone) {
  const Question disc{.robot = RobotSpec{.kind = RobotKind::disc, .radius = 4.0}, .clearance = 2.0};
  const ServedWorld world(scene_of(town), disc, {});
  const auto service = world_service(world, {});
  const Json legend = legend_of(service, "clearance");
  EXPECT_EQ(legend.at(0).at("words"), "nearer than 6: too near for disc 4");
  EXPECT_EQ(legend.at(0).at("color"), "#c8102e99");
  EXPECT_TRUE(legend.at(1).at("words").get<std::string>().starts_with("6 ")) << legend.at(1);
  const ServedWorld driven(scene_of(town), {.robot = robot_value("robot", "car radius 4 turning 5"), .clearance = 2.0},
                           {});
  const auto of_car = world_service(driven, {});
  EXPECT_TRUE(legend_of(of_car, "clearance").at(0).at("words").get<std::string>().starts_with("nearer than 6: "));
  Scene scene = scene_of(town);
  for (int i = 0; i <= (1 << 21) / 4; ++i) {
    const Vec2 at{0.1 * (i % 1000), 0.1 * static_cast<double>(i / 1000)};
    scene.polygons.push_back({{at, at + Vec2{0.05, 0}, at + Vec2{0.05, 0.05}, at + Vec2{0, 0.05}}});
  }
  const ServedWorld crowd(std::move(scene), {}, {});
  const auto other = world_service(crowd, {});
  EXPECT_EQ(layer_of(other, "clearance").at("there"), false);
  EXPECT_NE(layer_of(other, "clearance").at("why").get<std::string>().find("walls and sides"), std::string::npos);
  EXPECT_EQ(asked(other, {.path = "/v/" + crowd.hash() + "/layers/clearance/0/0/0.png"}).status, 400U);
}

TEST(WorldLayers, TheSearchGoesOutFromTheStartThatIsAskedFor) {
  const ServedWorld world(build(scene_of("bounds 0 0 100 60\nwall 50 -1 50 61\n")), {});
  const auto service = world_service(world, {});
  ASSERT_EQ(layer_of(service, "search").at("of_start"), true);
  const std::string tile = "/v/" + world.hash() + "/layers/search/0/0/0.png";
  const HttpResponse left = asked(service, {.path = tile, .query = {{"from", "5,30"}}});
  const HttpResponse right = asked(service, {.path = tile, .query = {{"from", "95,30"}}});
  ASSERT_EQ(left.status, 200U) << left.body;
  ASSERT_EQ(right.status, 200U) << right.body;
  EXPECT_NE(left.body, right.body);
  EXPECT_EQ(service->at_once({.path = tile, .query = {{"from", "95,30"}}}, {})->body, right.body);
  EXPECT_EQ(service->at_once({.path = tile, .query = {{"from", "5,30"}}}, {})->body, left.body);
  EXPECT_EQ(asked(service, {.path = tile}).status, 400U);
  for (const char* wrong : {"", "5", "5,nan", "50,30", "500,30"}) {
    EXPECT_EQ(asked(service, {.path = tile, .query = {{"from", wrong}}}).status, 400U) << wrong;
  }
  const std::string legend = "/v/" + world.hash() + "/layers/search/legend";
  const std::string words = asked(service, {.path = legend, .query = {{"from", "5,30"}}}).body;
  EXPECT_NE(words.find("0 to "), std::string::npos) << words;
  EXPECT_NE(words.find("that it does not reach"), std::string::npos) << "those behind the wall: " << words;
}

/// Of two luminances, as WCAG has it.
double contrast(double one, double other) { return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05); }

/// Of a color as legends have it, "#rrggbb".
double luminance(const std::string& color) {
  const auto part = [&](std::size_t from) {
    const double share = std::stoi(color.substr(from, 2), nullptr, 16) / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
}

TEST(WorldLayers, LinesStandOutOnWhiteAndDarkerOnesAreNearer) {
  const ServedWorld world(build(scene_of("bounds 0 0 100 60\nwall 50 -1 50 61\n")), {});
  const auto service = world_service(world, {});
  const std::string legend = "/v/" + world.hash() + "/layers/search/legend";
  const Json search = Json::parse(asked(service, {.path = legend, .query = {{"from", "5,30"}}}).body);
  ASSERT_GT(search.size(), 4U);
  double last = -1.0;
  for (const Json& entry : search) {
    EXPECT_GE(contrast(luminance(entry.at("color")), 1.0), 3.0) << entry;
    EXPECT_GT(luminance(entry.at("color")), last) << entry;
    last = luminance(entry.at("color"));
  }
  for (const char* name : {"roadmap", "components", "axis"}) {
    const Json told = legend_of(service, name);
    for (const Json& entry : {told.front(), told.back()}) {
      EXPECT_GE(contrast(luminance(entry.at("color")), 1.0), 3.0) << name;
      EXPECT_GE(contrast(luminance(entry.at("color")), 0.0), 3.0) << name;
    }
  }
}

TEST(WorldLayers, StepsOfClearanceStandOutOnWhiteAndDarkerOnesAreNearer) {
  const ServedWorld world(scene_of(town), {}, {});
  const auto service = world_service(world, {});
  const Json legend = legend_of(service, "clearance");
  ASSERT_EQ(legend.size(), step_inks.size());
  double last = -1.0;
  for (const Json& entry : legend) {
    const std::string color = entry.at("color");
    const double opacity = std::stoi(color.substr(7), nullptr, 16) / 255.0;
    std::string seen = "#";
    for (const std::size_t from : {1U, 3U, 5U}) {
      const int part = std::stoi(color.substr(from, 2), nullptr, 16);
      seen += fmt::format("{:02x}", static_cast<int>(opacity * part + (1.0 - opacity) * 255.0));
    }
    EXPECT_GE(contrast(luminance(seen), 1.0), 1.9) << entry;
    EXPECT_GT(luminance(seen), last) << entry;
    last = luminance(seen);
  }
}

TEST(WorldLayers, LegendsGroupDigitsByThree) {
  const ServedWorld world(build(scene_of("bounds 0 0 8000000 6000000\n")), {});
  const auto service = world_service(world, {});
  EXPECT_EQ(legend_of(service, "clearance").back().at("words"), grouped(3'000'000) + " and more");
  const std::string legend = "/v/" + world.hash() + "/layers/search/legend";
  const Json search = Json::parse(asked(service, {.path = legend, .query = {{"from", "10,10"}}}).body);
  EXPECT_EQ(search.at(1).at("words"), grouped(2'000'000) + " to " + grouped(4'000'000) + " from the start");
}

TEST(WorldLayers, TheSearchSaysWhyThereIsNone) {
  const auto why = [](const ServedWorld& world) {
    const auto service = world_service(world, {});
    return layer_of(service, "search").value("why", "");
  };
  const ServedWorld plain(scene_of(town), {}, {});
  EXPECT_NE(why(plain).find("warren build"), std::string::npos);
  const ServedWorld lazy(build(scene_of(town), {}, {.planner = PlannerKind::lazy_prm}), {});
  EXPECT_NE(why(lazy).find("while it is asked"), std::string::npos);
  for (const PlannerKind planner : {PlannerKind::visibility, PlannerKind::voronoi, PlannerKind::cells}) {
    const ServedWorld other(build(scene_of(town), {}, {.planner = planner}), {});
    EXPECT_NE(why(other).find("build --planner prm"), std::string::npos);
  }
  const ServedWorld lattice(build(read_world("maze:300x300,seed=3", {})), {});
  EXPECT_NE(why(lattice).find("without a search"), std::string::npos);
}

TEST(WorldLayers, TheAxisRunsInTheMiddleOfACorridor) {
  const TemporaryDirectory folder;
  folder.write(
      "a.map", "type octile\nheight 5\nwidth 30\nmap\n" + [] {
        std::string rows = std::string(30, '@') + "\n";
        for (int row = 0; row < 3; ++row) rows += "@" + std::string(28, '.') + "@\n";
        return rows + std::string(30, '@') + "\n";
      }());
  const ServedWorld rooms(
      scene_of("bounds 0 0 100 60\npolygon 40 0 60 0 60 25 40 25\npolygon 40 35 60 35 60 60 40 60\n"), {}, {});
  const ServedWorld map(read_world(folder.file("a.map"), {}), {}, {});
  const ServedWorld roadmap(build(scene_of("bounds 0 0 100 60\npolygon 40 0 60 0 60 25 40 25\n"
                                           "polygon 40 35 60 35 60 60 40 60\n")),
                            {});
  Question closing;  // by the service's words
  closing.prices.keep_out.push_back({{{40, 35}, {60, 35}, {60, 60}, {40, 60}}, 0});
  const ServedWorld closed(scene_of("bounds 0 0 100 60\npolygon 40 0 60 0 60 25 40 25\n"), closing, {});
  struct Case {
    const ServedWorld& world;
    Vec2 on, off;
  };
  for (const Case& c : {Case{rooms, {50, 30}, {50, 33}}, Case{map, {15, 2.5}, {15, 1.5}},
                        Case{roadmap, {50, 30}, {50, 33}}, Case{closed, {50, 30}, {50, 33}}}) {
    const auto service = world_service(c.world, {});
    ASSERT_EQ(layer_of(service, "axis").at("there"), true);
    const std::vector<test::InkPixel> pixels =
        test::read_inks(asked(service, {.path = "/v/" + c.world.hash() + "/layers/axis/0/0/0.png"}).body);
    const TileGrid& grid = c.world.tiles().grid();
    const auto at = [&](Vec2 p) {
      const auto x = static_cast<std::size_t>((p.x - grid.corner.x) / grid.pixel(0));
      const auto y = static_cast<std::size_t>((grid.corner.y - p.y) / grid.pixel(0));
      unsigned most = 0;
      for (const std::size_t row : {y - 1, y, y + 1}) most = std::max(most, pixels[row * TileGrid::pixels + x][3]);
      return most;
    };
    EXPECT_GT(at(c.on), 60U);
    EXPECT_EQ(at(c.off), 0U);
    const std::string words = legend_of(service, "axis").at(0).at("words");
    EXPECT_NE(words.find("as far from all obstacles"), std::string::npos) << words;
  }
}

TEST(WorldLayers, AWorldWithoutAnAxisSaysWhy) {
  const RobotSpec car{.kind = RobotKind::car, .turning_radius = 3.0, .outline = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const ServedWorld cars(scene_of("bounds 0 0 100 60\nstart 5 30 0\ngoal 90 30 0\n"), {.robot = car}, {});
  const ServedWorld maze(read_world("maze:300x300,seed=7", {}), {}, {});
  for (const ServedWorld* world : {&cars, &maze}) {
    const auto service = world_service(*world, {});
    const Json layer = layer_of(service, "axis");
    EXPECT_EQ(layer.at("there"), false);
    EXPECT_GT(layer.value("why", "").size(), 20U);
    EXPECT_EQ(layer.value("why", "").find('@'), std::string::npos);
    EXPECT_EQ(asked(service, {.path = "/v/" + world->hash() + "/layers/axis/0/0/0.png"}).status, 400U);
  }
}

TEST(WorldLayers, TheSweepIsAskedOfThePathAndABodyWithoutExtentHasNone) {
  const ServedWorld disc(scene_of(town), {.robot = RobotSpec{.kind = RobotKind::disc, .radius = 1.0}}, {});
  const auto service = world_service(disc, {});
  EXPECT_EQ(layer_of(service, "sweep").at("of_path"), "api/path/{id}/sweep");
  EXPECT_EQ(asked(service, {.path = "/v/" + disc.hash() + "/layers/sweep/0/0/0.png"}).status, 400U);
  const ServedWorld point(scene_of(town), {}, {});
  const auto other = world_service(point, {});
  EXPECT_EQ(layer_of(other, "sweep").at("there"), false);
  EXPECT_NE(layer_of(other, "sweep").at("why").get<std::string>().find("point"), std::string::npos);
}

TEST(WorldLayers, WhatIsNoLayerIsNotFound) {
  const ServedWorld world(build(scene_of(town)), {});
  const auto service = world_service(world, {});
  for (const std::string path :
       {"/layers/Roadmap/0/0/0.png", "/layers/walls/0/0/0.png", "/layers//0/0/0.png", "/layers/roadmap/0/1/0.png",
        "/layers/roadmap/0/0/0", "/layers/walls/legend", "/layers/roadmap/words"}) {
    EXPECT_EQ(asked(service, {.path = "/v/" + world.hash() + path}).status, 404U) << path;
  }
  EXPECT_EQ(asked(service, {.path = "/v/0000000000000000/layers/roadmap/0/0/0.png"}).status, 404U);
}

TEST(WorldLayers, ALatticeShowsItsPassagesFromNear) {
  const ServedWorld world(read_world("maze:300x300,seed=7", {}), {}, {});
  const auto service = world_service(world, {});
  const Json roadmap = layer_of(service, "roadmap");
  ASSERT_EQ(roadmap.at("there"), true);
  const unsigned zoom = roadmap.at("from_zoom");
  EXPECT_LE(world.tiles().grid().pixel(zoom), 1.0 / 8.0);
  EXPECT_GT(world.tiles().grid().pixel(zoom - 1), 1.0 / 8.0);
  const auto is_empty = [&](unsigned z) {
    const std::string path = "/v/" + world.hash() + "/layers/roadmap/" + std::to_string(z) + "/0/0.png";
    for (const test::InkPixel& pixel : test::read_inks(asked(service, {.path = path}).body)) {
      if (pixel[3] > 0) return false;
    }
    return true;
  };
  const std::string words = legend_of(service, "roadmap").at(0).at("words");
  EXPECT_TRUE(words.starts_with(counted(89'999, "passage", "passages"))) << words << ", a perfect maze";
  EXPECT_TRUE(is_empty(zoom - 1));
  EXPECT_FALSE(is_empty(zoom));
  EXPECT_EQ(layer_of(service, "components").at("there"), false);
}

}  // namespace
}  // namespace warren::serve
