// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/replanner.hpp"
#include "solve/solve.hpp"
#include "tests/apps/serve/town.hpp"

namespace warren::serve {
namespace {

using Json = nlohmann::json;

/// 30 x 20 cells of half a metre from (1, 2) on.
Scene hall(bool with_unknown = false) {
  Scene scene;
  scene.source = "hall";
  OccupancyMap& map = scene.map.emplace();
  map.blocked = Bitmap(30, 20);
  map.cell = 0.5;
  map.origin = {1.0, 2.0};
  map.free = map.blocked.size();
  scene.start = {2.1, 7.1};
  scene.goal = {14.9, 7.4};
  if (!with_unknown) return scene;
  map.unknown = Bitmap(30, 20);
  map.unknown.set(3, 3);
  map.blocked.set(3, 3);
  --map.free;
  ++map.unknown_count;
  return scene;
}

/// What a client sees of a world that may be changed.
class Writable {
 public:
  explicit Writable(const std::string& scene = town, const std::string& token = {}, bool writable = true)
      : service_(writable_service(std::make_unique<ServedWorld>(scene_of(scene), Question{}, Execution{}),
                                  {.writable = writable}, token)) {}
  explicit Writable(Scene scene, const Question& body = {})
      : service_(writable_service(std::make_unique<ServedWorld>(std::move(scene), body, Execution{}),
                                  {.writable = true}, {})) {}
  explicit Writable(Roadmap roadmap)
      : service_(
            writable_service(std::make_unique<ServedWorld>(std::move(roadmap), Execution{}), {.writable = true}, {})) {}

  HttpResponse asked(const HttpRequest& request) {
    try {
      if (request.body.size() > service_->most_body(request))
        return error_response({413, "body_too_large", "body", ""});
      if (auto said = service_->at_once(request, {})) return *said;
    } catch (const HttpError& error) {
      return error_response(error);
    }
    const SignalFlag flag{0};
    return answer_of(*service_, request, flag);
  }
  HttpResponse post(const std::string& path, const Json& body, const std::string& authorization = {}) {
    return asked({.method = "POST", .path = path, .authorization = authorization, .body = body.dump()});
  }
  HttpResponse update(const Json& body) { return post("/api/update", body); }
  Json query(const Json& question = Json::object()) { return Json::parse(post("/api/query", question).body); }
  std::string scene() { return asked({.path = "/api/scene"}).body; }
  std::string hash() { return Json::parse(asked({.path = "/api/world"}).body).at("hash"); }

 private:
  std::unique_ptr<HttpService> service_;
};

const Json wall_across = {{"add", {{"walls", {{55, 0, 55, 59}}}}}};

TEST(WritableService, AWallThatIsDrawnIsGoneAround) {
  Writable served;
  const Json before = served.query();
  const HttpResponse said = served.update(wall_across);
  ASSERT_EQ(said.status, 200U) << said.body;
  EXPECT_EQ(Json::parse(said.body).at("before"), before.at("world").at("hash"));
  EXPECT_EQ(Json::parse(said.body).at("hash"), served.hash());
  const Json after = served.query();
  EXPECT_GT(after.at("length").get<double>(), before.at("length").get<double>());
  EXPECT_EQ(after.at("world").at("hash"), served.hash());
  const Answer expected = solve(scene_of(served.scene()));
  EXPECT_EQ(after.at("length").get<double>(), expected.length);
  EXPECT_EQ(after.at("path").size(), expected.path.size());
}

TEST(WritableService, WhatIsTakenBackIsTheOldWorld) {
  Writable served;
  const std::string before = served.hash();
  const std::string scene = served.scene();
  const Json change = {{"add", {{"polygons", {{{51, 1}, {58, 1}, {55, 30}}}}, {"walls", {{1, 1, 2, 2}}}}}};
  ASSERT_EQ(served.update(change).status, 200U);
  EXPECT_NE(served.hash(), before);
  const HttpResponse back = served.update({{"remove", change.at("add")}});
  ASSERT_EQ(back.status, 200U) << back.body;
  EXPECT_EQ(served.hash(), before);
  EXPECT_EQ(served.scene(), scene);
}

TEST(WritableService, WhatTheWorldForbidsAndAsksForOutlivesAChange) {
  Writable served(std::string(town) + "keep-out 20 0 30 0 30 59 20 59\nclearance-price 2 1\ngoal 5 55\n");
  const Json before = served.query();
  const std::string scene = served.scene();
  EXPECT_NE(scene.find("keep-out 20 0"), std::string::npos) << scene;
  EXPECT_NE(scene.find("clearance-price 2 1"), std::string::npos) << scene;
  const Json change = {{"walls", {{1, 1, 1.5, 1.5}}}};
  ASSERT_EQ(served.update({{"add", change}}).status, 200U);
  ASSERT_EQ(served.update({{"remove", change}}).status, 200U);
  EXPECT_EQ(served.scene(), scene);
  EXPECT_EQ(served.query().at("path"), before.at("path"));
}

TEST(WritableService, WhatTheServiceForbidsAndAsksForOutlivesAChangeOfAMap) {
  Question body{.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.2}};
  body.prices.clearance = ClearancePrice{3.0, 1.5};
  body.prices.keep_out.push_back({{{8.0, 2.0}, {8.5, 2.0}, {8.5, 9.8}, {8.0, 9.8}}, 0});
  Writable served(hall(), body);
  const Json before = served.query();
  ASSERT_EQ(served.update({{"block", {{12.0, 9.0, 12.4, 9.4}}}}).status, 200U);
  Scene now = hall();
  change_cells(now, Box{{12.0, 9.0}, {12.4, 9.4}}, true);
  const Answer expected = solve(now, body);
  ASSERT_TRUE(expected.verified && expected.cost);
  const Json after = served.query();
  EXPECT_NE(after.at("cost"), before.at("cost"));
  EXPECT_EQ(after.at("cost").get<double>(), *expected.cost);
  EXPECT_EQ(after.at("path").size(), expected.path.size());
}

/// Off the grid it is a maze no more; where that is taken back it is one again.
TEST(WritableService, AWallAnywhereInAMazeIsGoneAround) {
  Writable served(maze_scene({12, 12, 3}, false, {}));
  const std::string before = served.hash();
  const std::string scene = served.scene();
  for (const Json& wall :
       {Json{2.1, 2.2, 2.6, 2.9}, Json{3, 3, 3.4, 3}, Json{-5, 1, -4, 1}, Json{0.5, 3.5, 1.5, 3.5}}) {
    SCOPED_TRACE(wall.dump());
    const Json drawn = {{"walls", {wall}}};
    ASSERT_EQ(served.update({{"add", drawn}}).status, 200U);
    const Json now = served.query();
    ASSERT_TRUE(now.contains("status")) << now;
    EXPECT_EQ(now.at("status"),
              solve(scene_of(served.scene())).outcome == Outcome::solved ? "solved" : "not_connected");
    ASSERT_EQ(served.update({{"remove", drawn}}).status, 200U);
    EXPECT_EQ(served.hash(), before);
    EXPECT_EQ(served.scene(), scene);
  }
}

TEST(WritableService, OldTilesAreGoneAndNewOnesShowTheChange) {
  Writable served;
  const std::string old = "/v/" + served.hash() + "/tiles/0/0/0.png";
  const std::string bytes = served.asked({.path = old}).body;
  ASSERT_EQ(served.update(wall_across).status, 200U);
  EXPECT_EQ(served.asked({.path = old}).status, 404U);
  const HttpResponse now = served.asked({.path = "/v/" + served.hash() + "/tiles/0/0/0.png"});
  EXPECT_EQ(now.status, 200U);
  EXPECT_NE(now.body, bytes);
}

TEST(WritableService, ErasingTakesWhatIsNearest) {
  Writable served;
  const Json wall = Json::parse(served.update({{"erase", {{30, 26, 2}}}}).body);
  EXPECT_EQ(wall.at("removed"), Json::parse(R"({"walls":[[10.0,10.0,50.0,40.0]],"polygons":[]})"));
  const Json polygon = Json::parse(served.update({{"erase", {{75, 30, 2}}}}).body);
  EXPECT_EQ(polygon.at("removed").at("polygons").size(), 1U);
  const Json nothing = Json::parse(served.update({{"erase", {{75, 30, 2}}}}).body);
  EXPECT_EQ(nothing.at("removed").at("polygons").size(), 0U);
  EXPECT_EQ(nothing.at("before"), nothing.at("hash"));
}

TEST(WritableService, ARoadmapIsUpdatedAsUpdateDoes) {
  const SolveOptions options{.planner = PlannerKind::prm, .roadmap = {.samples = 500}};
  Writable served(build(scene_of(town), {}, options));
  ASSERT_EQ(served.update(wall_across).status, 200U);
  const Roadmap expected = build(scene_of(std::string(town) + "wall 55 0 55 59\n"), {}, options);
  EXPECT_EQ(served.hash(), expected.world_hash);
  EXPECT_EQ(served.query().at("length").get<double>(),
            RoadmapQuery(expected, Execution{}, Questions::one).ask({}, {}).length);
}

TEST(WritableService, WhatCanNotBeDrawnIsRefusedAndChangesNothing) {
  Writable served;
  const std::string before = served.hash();
  struct Case {
    std::string body;
    unsigned status;
    std::string said;
  };
  std::string many = "{\"add\":{\"walls\":[";
  for (int i = 0; i < 20'000; ++i) many += "[0,0,1,1],";
  many += "[0,0,1,1]]}}";
  for (const Case& c : {
           Case{R"({"add":{"polygons":[[[1,1],[3,3],[3,1],[1,3]]]}})", 400, "polygon 1"},
           Case{R"({"add":{"polygons":[[[1,1],[3,3]]]}})", 400, "three corners or more"},
           Case{R"({"add":{"walls":[[1,1,1,1]]}})", 400, "two different ends"},
           Case{R"({"add":{"walls":[[1,1,1]]}})", 400, "add.walls[0]: expected 4 numbers"},
           Case{R"({"add":{"walls":[[1,1,1,1e61]]}})", 400, "at most 1e60"},
           Case{R"({"add":{"walls":[[1,1,1,NaN]]}})", 400, "expected JSON"},
           Case{R"({"add":{"walls":[[1,1,1,1e999]]}})", 400, "double"},
           Case{R"({"remove":{"walls":[[1,1,2,2]]}})", 400, "not in the world"},
           Case{R"({"wall":[]})", 400, "the keys add, remove, erase"},
           Case{R"({"add":{"walls":[[50,5,50,55]]},"add":{"walls":[]}})", 400, "each key of an object once"},
           Case{R"({"add":{"walls":[[50,5,50,55]],"walls":[]}})", 400, "each key of an object once"},
           Case{R"({"erase":[[30,26,-2]]})", 400, "erase[0]: expected x, y and a reach of 0 or more"},
           Case{"{\"add\":" + std::string(10'000, '[') + "}", 400, "nested"},
           Case{many, 400, "a list of at most " + grouped(10'000)},
       }) {
    SCOPED_TRACE(c.said);
    const HttpResponse said = served.asked({.method = "POST", .path = "/api/update", .body = c.body});
    EXPECT_EQ(said.status, c.status) << said.body;
    EXPECT_NE(said.body.find(c.said), std::string::npos) << said.body;
  }
  EXPECT_EQ(served.hash(), before);
  EXPECT_EQ(served.asked({.method = "POST", .path = "/api/update", .body = std::string(5'000'000, ' ')}).status, 413U);
}

TEST(WritableService, NoSceneIsWrittenThatNobodyCouldRead) {
  Writable served;
  const HttpResponse said = served.asked({.path = "/api/scene", .query = {{"start", "1e300,1"}}});
  EXPECT_EQ(said.status, 400U);
  EXPECT_NE(said.body.find("start: coordinates are numbers of at most 1e60"), std::string::npos) << said.body;
}

TEST(WritableService, LargeMazesAndReadersAreToldWhy) {
  Writable maze(read_world("maze:300x300,seed=1", {}));
  EXPECT_NE(maze.update(wall_across).body.find("warren update"), std::string::npos);
  EXPECT_EQ(Json::parse(maze.asked({.path = "/api/world"}).body).at("writable"), false);
  Writable reader(town, {}, false);
  const HttpResponse said = reader.update(wall_across);
  EXPECT_EQ(said.status, 403U);
  EXPECT_EQ(Json::parse(said.body).at("error").at("code"), "read_only");
}

TEST(WritableService, WallsOfALargeMazeAreNotMadeForAChangeThatIsRefused) {
  auto world = std::make_unique<ServedWorld>(read_world("maze:1500x1500,seed=1", {}), Question{}, Execution{});
  const auto service = writable_service(std::move(world), {.writable = true, .scene_bytes = 1000}, {});
  const SignalFlag flag{0};
  const std::size_t held = resident_bytes();
  const HttpResponse change =
      answer_of(*service, {.method = "POST", .path = "/api/update", .body = wall_across.dump()}, flag);
  EXPECT_EQ(change.status, 400U) << change.body;
  const HttpResponse scene = answer_of(*service, {.path = "/api/scene"}, flag);
  EXPECT_EQ(scene.status, 413U) << scene.body;
  EXPECT_LT(resident_bytes(), held + (std::size_t{4} << 20U));
}

TEST(WritableService, OnlyWhoKnowsTheTokenChanges) {
  Writable served(town, "0123456789abcdef");
  EXPECT_EQ(served.update(wall_across).status, 401U);
  for (const char* wrong : {"0123456789abcdef", "Bearer 0123456789abcdeF", "Bearer ", "Bearer 0123456789abcdef0"}) {
    EXPECT_EQ(served.post("/api/update", wall_across, wrong).status, 403U) << wrong;
  }
  EXPECT_EQ(served.post("/api/update", wall_across, "Bearer 0123456789abcdef").status, 200U);
  EXPECT_EQ(served.query().at("status"), "solved");
}

TEST(WritableService, WhoAsksMeanwhileIsAnsweredInOneWorldOrTheOther) {
  Writable served;
  std::vector<std::pair<std::string, double>> known{{served.hash(), served.query().at("length")}};
  served.update(wall_across);
  known.emplace_back(served.hash(), served.query().at("length"));
  std::atomic<bool> done{false};
  std::atomic<int> wrong{0};
  std::vector<std::thread> clients;
  for (int i = 0; i < 4; ++i) {
    clients.emplace_back([&] {
      while (!done) {
        const Json answer = served.query();
        const bool fits = std::any_of(known.begin(), known.end(), [&](const auto& world) {
          return answer.at("world").at("hash") == world.first && answer.at("length") == world.second;
        });
        if (!fits) ++wrong;
      }
    });
  }
  for (int i = 0; i < 20; ++i) {
    served.update({{i % 2 == 0 ? "remove" : "add", wall_across.at("add")}});
  }
  done = true;
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(wrong, 0);
}

TEST(WritableService, ABoxOfAMapsCellsIsGoneAroundAndTakenBack) {
  Writable served(hall());
  const Json about = Json::parse(served.asked({.path = "/api/world"}).body);
  EXPECT_EQ(about.at("writable"), false);
  EXPECT_EQ(about.at("cells_writable"), true);
  const Json before = served.query();
  const HttpResponse said = served.update({{"block", {{8.5, 2.1, 8.0, 9.8}}}});  // corners in any order
  ASSERT_EQ(said.status, 200U) << said.body;
  const Json change = Json::parse(said.body);
  EXPECT_EQ(change.at("before"), before.at("world").at("hash"));
  EXPECT_EQ(change.at("hash"), served.hash());
  EXPECT_EQ(change.at("blocked_cells"), 16);
  EXPECT_EQ(change.at("blocked").front(), Json({14, 0}));
  EXPECT_EQ(change.at("blocked").back(), Json({14, 15}));
  EXPECT_EQ(change.at("freed"), Json::array());
  EXPECT_EQ(change.at("can_be_taken_back"), true);
  const Json around = served.query();
  EXPECT_EQ(around.at("status"), "solved");
  EXPECT_GT(around.at("length").get<double>(), before.at("length").get<double>() + 1.0);
  EXPECT_EQ(around.at("world").at("hash"), served.hash());
  ASSERT_EQ(served.update({{"cells", {{14, 16, true}, {14, 17, true}, {14, 18, true}, {14, 19, true}}}}).status, 200U);
  EXPECT_EQ(served.query().at("status"), "infeasible");
  const Json freed = Json::parse(served.update({{"free", {{8.2, 2.0, 8.3, 12.0}}}}).body);
  EXPECT_EQ(freed.at("freed_cells"), 20);
  EXPECT_EQ(served.hash(), before.at("world").at("hash"));
  EXPECT_EQ(served.query().at("path"), before.at("path"));
}

TEST(WritableService, CellsOfAMapChangeLastAndAreTakenBackByTheirLists) {
  Writable served(hall());
  const std::string before = served.hash();
  const Json change = {
      {"block", {{1, 2, 3, 3}}}, {"free", {{1, 2, 1.9, 3}}}, {"cells", {{0, 0, true}, {3, 1, false}, {9, 9, true}}}};
  const Json said = Json::parse(served.update(change).body);
  EXPECT_EQ(said.at("blocked"), Json::parse("[[0,0],[2,0],[3,0],[2,1],[9,9]]"));
  Json back = Json::array();
  for (const Json& cell : said.at("blocked")) back.push_back({cell[0], cell[1], false});
  ASSERT_EQ(served.update({{"cells", back}}).status, 200U);
  EXPECT_EQ(served.hash(), before);
}

TEST(WritableService, WhatNoListTakesBackSaysSo) {
  Writable unknown(hall(true));
  const Json known = Json::parse(unknown.update({{"free", {{2.5, 3.5, 3, 4}}}}).body);
  EXPECT_EQ(known.at("freed"), Json::parse("[[3,3]]"));
  EXPECT_EQ(known.at("known_cells"), 1);
  EXPECT_EQ(known.at("can_be_taken_back"), false);
  Scene large = hall();
  large.map->blocked = Bitmap(150, 70);
  large.map->free = large.map->blocked.size();
  Writable served(std::move(large));
  const Json many = Json::parse(served.update({{"block", {{0, 0, 1000, 1000}}}}).body);
  EXPECT_EQ(many.at("blocked_cells"), 10'500);
  EXPECT_EQ(many.at("can_be_taken_back"), false);
  EXPECT_FALSE(many.contains("blocked") || many.contains("freed")) << many;
}

TEST(WritableService, WhatIsNoChangeOfThisWorldIsRefusedByName) {
  Writable map(hall());
  const std::string before = map.hash();
  Json many = Json::array();
  for (int i = 0; i < 10'000; ++i) many.push_back({0, 0, true});
  struct Case {
    Json body;
    unsigned status;
    std::string said;
  };
  for (const Case& c : {
           Case{wall_across, 400, "walls and polygons are for scenes"},
           Case{{{"erase", {{3, 3, 1}}}, {"free", {{1, 1, 2, 2}}}}, 400, "walls and polygons are for scenes"},
           Case{{{"cells", {{1, 1, true}, {30, 4, true}}}}, 400, "30 wide and 20 high (found: 30, 4)"},
           Case{{{"cells", {{1, -1, true}}}}, 400, "cells[0]: expected a whole number"},
           Case{{{"cells", {{1, 1, 1}}}}, 400, "cells[0]: expected column, row, true or false"},
           Case{{{"cells", {{1, 1, 1, true}}}}, 400, "cells[0]: expected column, row, true or false"},
           Case{{{"block", {{1, 2, 3}}}}, 400, "block[0]: expected 4 numbers"},
           Case{{{"cells", many}, {"free", {{1, 2, 3, 3}}}}, 413, "at most " + grouped(10'000) + " boxes and cells"},
       }) {
    SCOPED_TRACE(c.said);
    const HttpResponse said = map.update(c.body);
    EXPECT_EQ(said.status, c.status) << said.body;
    EXPECT_NE(said.body.find(c.said), std::string::npos) << said.body;
  }
  EXPECT_EQ(map.hash(), before);
  Writable walls;
  for (const Json& body : {Json{{"block", {{1, 2, 3, 3}}}}, Json{{"cells", {{1, 1, true}}}}}) {
    const HttpResponse said = walls.update(body);
    EXPECT_EQ(said.status, 400U);
    EXPECT_NE(said.body.find("block, free and cells change the cells of a map"), std::string::npos) << said.body;
  }
}

TEST(WritableService, ARoadmapOfAMapIsUpdatedAsUpdateDoes) {
  const SolveOptions options{.planner = PlannerKind::prm, .roadmap = {.samples = 200}};
  Question priced_body;
  priced_body.prices.clearance = ClearancePrice{3.0, 1.5};
  for (const Question& body : {Question{}, priced_body}) {
    Writable served(build(hall(), body, options));
    ASSERT_EQ(served.update({{"block", {{8.0, 2.0, 8.5, 9.8}}}}).status, 200U);
    Scene now = hall();
    change_cells(now, {{8.0, 2.0}, {8.5, 9.8}}, true);
    const Roadmap expected = build(std::move(now), body, options);
    EXPECT_EQ(served.hash(), expected.world_hash);
    const Json answer = served.query();
    const Answer asked = RoadmapQuery(expected, Execution{}, Questions::one).ask({}, {});
    EXPECT_EQ(answer.at("length").get<double>(), asked.length);
    EXPECT_EQ(answer.value("cost", 0.0), asked.cost.value_or(0.0));
    EXPECT_EQ(answer.contains("price"), body.prices.clearance.has_value());
  }
}

/// All but the account of the work.
Json told_by(Json answer) {
  for (const char* key : {"stages_s", "solve_s", "peak_memory_bytes", "costs"}) answer.erase(key);
  answer.at("counters").erase("expanded");
  return answer;
}

const Json priced = {{"prices", {"clearance-price 3 1.5"}}, {"robot", "disc 0.2"}};

TEST(WritableService, AQuestionThatIsAskedAgainIsRepairedAndAnsweredAsAFreshOne) {
  Writable served(hall());
  Json dearer = priced;
  dearer["prices"] = {"clearance-price 9 1.5"};
  std::uint64_t repaired = 0;
  std::uint64_t afresh = 0;
  for (int x = 3; x < 9; ++x) {
    const Json change = {{"cells", {{2 * x, 9, x % 3 != 0}, {20, x, x % 2 == 0}}}};
    ASSERT_EQ(served.update(change).status, 200U);
    for (const Json& question : {priced, x == 6 ? dearer : priced}) {
      const Json again = served.query(question);
      Scene now = hall();
      for (int k = 3; k <= x; ++k) {
        const auto at = static_cast<std::uint32_t>(k);
        change_cells(now, std::array{CellChange{{2 * at, 9}, k % 3 != 0}, CellChange{{20, at}, k % 2 == 0}});
      }
      const Json fresh = Writable(std::move(now)).query(question);
      ASSERT_EQ(again.at("status"), "solved") << again;
      ASSERT_EQ(told_by(again), told_by(fresh));
      repaired += again.at("counters").at("expanded").get<std::uint64_t>();
      afresh += fresh.at("counters").at("expanded").get<std::uint64_t>();
    }
  }
  EXPECT_LT(2 * repaired, afresh);
}

TEST(WritableService, WhoAsksAMapMeanwhileIsAnsweredInOneWorldOrTheOther) {
  Writable served(hall());
  const Json change = {{"block", {{8.0, 3.0, 8.9, 9.8}}}};
  std::vector<Json> known{told_by(served.query(priced))};
  served.update(change);
  known.push_back(told_by(served.query(priced)));
  ASSERT_NE(known[0].at("path"), known[1].at("path"));
  std::atomic<bool> done{false};
  std::atomic<int> wrong{0};
  std::vector<std::thread> clients;
  for (int i = 0; i < 2; ++i) {
    clients.emplace_back([&] {
      while (!done) {
        if (std::count(known.begin(), known.end(), told_by(served.query(priced))) != 1) ++wrong;
      }
    });
  }
  for (int i = 0; i < 10; ++i) served.update({{i % 2 == 0 ? "free" : "block", change.at("block")}});
  done = true;
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace warren::serve
