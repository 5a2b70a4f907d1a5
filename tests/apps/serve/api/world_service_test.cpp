// SPDX-License-Identifier: BSD-3-Clause
// The whole interface without sockets, held against solve() and RoadmapQuery themselves.
#include "apps/serve/api/world_service.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/serve/page/served_files.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/solve.hpp"
#include "tests/apps/serve/town.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren::serve {
namespace {

using Json = nlohmann::json;

/// What a client sees.
class Served {
 public:
  explicit Served(Scene scene, const Question& body = {}, const ServiceLimits& limits = {})
      : world_(std::move(scene), body, {}), service_(world_service(world_, limits)) {}
  explicit Served(Roadmap roadmap, const ServiceLimits& limits = {})
      : world_(std::move(roadmap), {}), service_(world_service(world_, limits)) {}

  HttpResponse asked(const HttpRequest& request, int gone = 0) {
    try {
      const std::size_t most = service_->most_body(request);
      if (request.body.size() > most) return error_response({413, "body_too_large", "body", ""});
      if (auto said = service_->at_once(request, {})) return *said;
    } catch (const HttpError& error) {
      return error_response(error);
    }
    const SignalFlag flag{gone};
    return answer_of(*service_, request, flag);
  }
  HttpResponse get(const std::string& path, std::vector<std::pair<std::string, std::string>> query = {}) {
    return asked({.path = path, .query = std::move(query)});
  }
  HttpResponse post(const std::string& path, const std::string& body) {
    return asked({.method = "POST", .path = path, .body = body});
  }
  HttpResponse query(const Json& body) { return post("/api/query", body.dump()); }
  const ServedWorld& world() const { return world_; }
  HttpService& service() { return *service_; }

 private:
  ServedWorld world_;
  std::unique_ptr<HttpService> service_;
};

std::string field(const HttpResponse& response, const std::string& name) {
  for (const auto& [key, value] : response.fields) {
    if (key == name) return value;
  }
  return "none";
}

std::string code_of(const HttpResponse& response) { return Json::parse(response.body).at("error").at("code"); }

TEST(WorldService, AQuestionIsAnsweredAsSolveAnswersIt) {
  Served served(scene_of(town));
  const Answer expected = solve(scene_of(town), {.start = {5, 5}, .goal = {95, 55}});
  const HttpResponse response = served.query({{"start", {5, 5}}, {"goal", {95, 55}}});
  ASSERT_EQ(response.status, 200U) << response.body;
  const Json answer = Json::parse(response.body);
  EXPECT_EQ(answer.at("schema"), "warren.answer/1");
  EXPECT_EQ(answer.at("status"), "solved");
  EXPECT_EQ(answer.at("verified"), true);
  EXPECT_EQ(answer.at("length").get<double>(), expected.length);
  ASSERT_EQ(answer.at("path").size(), expected.path.size());
  for (std::size_t i = 0; i < expected.path.size(); ++i) {
    EXPECT_EQ(answer.at("path")[i][0].get<double>(), expected.path[i].x);
    EXPECT_EQ(answer.at("path")[i][1].get<double>(), expected.path[i].y);
  }
  EXPECT_EQ(field(response, "Warren-Path"), path_hash(expected, {}));
}

TEST(WorldService, WhatIsNotSaidIsTheWorlds) {
  Served served(scene_of(town), {.robot = RobotSpec{.kind = RobotKind::disc, .radius = 1.0}, .clearance = 0.25});
  const Json world = Json::parse(served.get("/api/world").body);
  EXPECT_EQ(world.at("robot"), "disc 1");
  EXPECT_EQ(world.at("clearance"), 0.25);
  EXPECT_EQ(world.at("start"), Json({5.0, 30.0}));
  EXPECT_EQ(world.at("box"), Json({0.0, 0.0, 100.0, 60.0}));
  EXPECT_EQ(world.at("asks_roadmap"), false);
  const Json answer = Json::parse(served.query(Json::object()).body);
  EXPECT_EQ(answer.at("start"), Json({5.0, 30.0}));
  EXPECT_EQ(answer.at("robot"), "disc 1");
  EXPECT_GE(answer.at("min_clearance").get<double>(), 0.25);
}

TEST(WorldService, EachPlannerThatItNamesAnswers) {
  Served served(scene_of(town));
  const Json world = Json::parse(served.get("/api/world").body);
  EXPECT_GE(world.at("planners").size(), 5U);
  const std::size_t named = world.at("planners").size();
  for (const std::uint64_t i : test::seeds(named, (named + 2) / 3, 0)) {
    const Json& planner = world.at("planners")[i];
    SCOPED_TRACE(planner.dump());
    Json question{{"planner", planner}};
    const auto name = planner.get<std::string>();
    if (name == "anytime" || name.ends_with("rrt-star")) question["budget_ms"] = 4000;  // they take all that there is
    const HttpResponse response = served.query(question);
    ASSERT_EQ(response.status, 200U) << response.body;
    EXPECT_EQ(Json::parse(response.body).at("planner"), planner);
  }
}

TEST(WorldService, ABlockedEndIsAnAnswerThatSaysWhy) {
  Served served(scene_of(town));
  const HttpResponse response = served.query({{"start", {75, 30}}});
  ASSERT_EQ(response.status, 200U) << response.body;
  const Json answer = Json::parse(response.body);
  EXPECT_EQ(answer.at("status"), "start_blocked");
  EXPECT_EQ(answer.at("blocked").at("end"), "start");
  EXPECT_EQ(answer.at("blocked").at("free_place").size(), 2U);
  EXPECT_EQ(field(response, "Warren-Path"), "none");
}

TEST(WorldService, SaysWhyThereIsNoPathWhenAsked) {
  const std::string closed =
      "bounds 0 0 100 60\nwall 50 0 50 29\nwall 50 31 50 60\nrobot disc 2\nstart 5 30\ngoal 95 30\n";
  Served world(scene_of(closed));
  Json question{{"planner", "prm"}};
  EXPECT_FALSE(Json::parse(world.query(question).body).contains("explained"));
  question["explain"] = true;
  const Json answer = Json::parse(world.query(question).body);
  EXPECT_EQ(answer.at("status"), "not_connected");
  EXPECT_FALSE(answer.at("components").at("nearest_gap").is_null());
  EXPECT_FALSE(answer.at("explained").at("hints").empty());
  Served roadmap(build(scene_of(closed), {}, {.planner = PlannerKind::prm, .roadmap = {.samples = 50}}));
  const Json kept = Json::parse(roadmap.query({{"start", {5, 30}}, {"goal", {95, 30}}, {"explain", true}}).body);
  EXPECT_FALSE(kept.at("explained").at("hints").empty());
}

TEST(WorldService, SaysWhatItsBodyLooksLike) {
  Served disc(scene_of(std::string(town) + "robot disc 2\n"));
  EXPECT_EQ(Json::parse(disc.get("/api/world").body).at("radius"), 2.0);
  Served square(scene_of("bounds 0 0 100 60\nrobot polygon 0 0 1 0 1 1\n"));
  const Json said = Json::parse(square.get("/api/world").body);
  EXPECT_EQ(said.at("radius"), 0.0);
  EXPECT_EQ(said.at("outline"), Json::parse("[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]"));
}

TEST(WorldService, WhatCanNotBeAskedIsRefusedInOneForm) {
  Served served(scene_of(town));
  struct Case {
    Json body;
    unsigned status;
    std::string code;
  };
  for (const Case& c : {Case{{{"start", {1}}}, 400, "usage"}, Case{{{"start", {1, 2, 3, 4}}}, 400, "usage"},
                        Case{{{"start", {1e70, 2}}}, 400, "usage"}, Case{{{"begin", {1, 2}}}, 400, "bad_request"},
                        Case{{{"planner", "grid"}, {"optimise", true}, {"start", "x"}}, 400, "bad_request"}}) {
    SCOPED_TRACE(c.body.dump());
    const HttpResponse response = served.query(c.body);
    EXPECT_EQ(response.status, c.status) << response.body;
    EXPECT_EQ(code_of(response), c.code) << response.body;
  }
  EXPECT_EQ(served.post("/api/query", std::string(70'000, ' ')).status, 413U);
  EXPECT_EQ(served.get("/api/query").status, 405U);
  EXPECT_EQ(served.get("/etc/passwd").status, 404U);
}

TEST(WorldService, WhoTakesTooLongOrLeavesIsStopped) {
  Served served(read_world("maze:200x200", {}));
  const HttpResponse late = served.query({{"start", {1, 1}}, {"goal", {200, 200}}, {"budget_ms", 0.001}});
  EXPECT_EQ(late.status, 504U) << late.body;
  EXPECT_EQ(code_of(late), "budget");
  const HttpResponse left = served.asked({.method = "POST", .path = "/api/query", .body = "{}"}, SIGTERM);
  EXPECT_EQ(left.status, 504U) << left.body;
  Served poor(read_world("maze:20x20", {}), {}, {.memory_bytes = 1 << 20});
  EXPECT_EQ(poor.query({{"start", {1, 1}}, {"goal", {20, 20}}}).status, 503U);
}

TEST(WorldService, ALargeMazeHoldsItsWallsAsBits) {
  const char* source = "maze:300x300,seed=7,loops=0.05";
  Scene maze = read_world(source, {});
  Served served(read_world(source, {}));
  EXPECT_EQ(served.world().outline().walls.size(), 0U);
  EXPECT_EQ(served.world().hash(), scene_hash(maze));
  EXPECT_EQ(scene_hash(served.world().whole({})), scene_hash(maze));
  const Json asked = Json::parse(served.query({{"start", {1, 1}}, {"goal", {300, 300}}, {"path", true}}).body);
  const Roadmap roadmap = build(read_world(source, {}));
  const Answer expected = RoadmapQuery(roadmap).ask({1, 1}, {300, 300});
  EXPECT_EQ(asked.at("world").at("walls"), maze.walls.size());
  EXPECT_EQ(asked.at("min_clearance"), expected.min_clearance);
  ASSERT_EQ(asked.at("path").size(), expected.path.size());

  std::vector<Segment> walls;  // in another order: that is another world, which the cells don't tell
  for (std::size_t i = maze.walls.size(); i > 0; --i) walls.push_back(maze.walls.segment(i - 1));
  maze.walls = WallSet::narrowest(walls);
  const std::string hash = scene_hash(maze);
  Served other(std::move(maze));
  EXPECT_EQ(other.world().outline().walls.size(), walls.size());
  EXPECT_EQ(other.world().hash(), hash);
  EXPECT_EQ(Json::parse(other.query({{"start", {1, 1}}, {"goal", {300, 300}}}).body).at("verified"), true);
}

TEST(WorldService, ALongPathIsSeenByParts) {
  Served served(read_world("maze:60x60,seed=3", {}), {}, {.most_points = 10});
  const HttpResponse response = served.query({{"start", {1, 1}}, {"goal", {60, 60}}});
  const Json answer = Json::parse(response.body);
  ASSERT_EQ(answer.at("status"), "solved");
  EXPECT_TRUE(answer.at("path").empty());
  const std::string name = field(response, "Warren-Path");
  EXPECT_EQ(answer.at("path_hash"), name);
  const Json whole = Json::parse(served.get("/api/path/" + name).body);
  EXPECT_EQ(whole.at("points"), answer.at("path_points"));
  ASSERT_EQ(whole.at("chains").size(), 1U);
  EXPECT_EQ(whole.at("chains")[0].size(), answer.at("path_points").get<std::size_t>());
  EXPECT_EQ(whole.at("chains")[0][0], Json({1.0, 1.0}));
  const Json seen = Json::parse(served.get("/api/path/" + name, {{"z", "0"}, {"bbox", "0,0,8,8"}}).body);
  EXPECT_LT(seen.at("chains").size() * 2, whole.at("chains")[0].size());
  const HttpResponse gone = served.get("/api/path/0123456789abcdef");
  EXPECT_EQ(gone.status, 404U);
  for (const char* said : {"POST its question to /api/query again", "Warren-Path"}) {
    EXPECT_NE(gone.body.find(said), std::string::npos) << gone.body;
  }
  EXPECT_EQ(served.get("/api/path/" + name, {{"bbox", "0,0,8"}}).status, 400U);
  Served strict(read_world("maze:60x60,seed=3", {}), {}, {.most_view_points = 5});
  const HttpResponse kept = strict.query({{"start", {1, 1}}, {"goal", {60, 60}}});
  EXPECT_EQ(strict.get("/api/path/" + field(kept, "Warren-Path")).status, 413U);
}

/// No place has less than the whole path, and of many places one has hardly more.
void expect_the_judges_clearance(Served& served, const HttpResponse& answer) {
  const double least_of_all = Json::parse(answer.body).at("min_clearance");
  const std::string address = "/api/path/" + field(answer, "Warren-Path") + "/clearance";
  const Json told = Json::parse(served.get(address, {{"samples", "2000"}}).body);
  EXPECT_EQ(told.at("min_clearance"), least_of_all);
  ASSERT_EQ(told.at("places").size(), 2000U);
  double least = 1e9;
  for (const Json& place : told.at("places")) least = std::min(least, place.at("clearance").get<double>());
  EXPECT_GE(least, least_of_all - 1e-9);
  EXPECT_LE(least, least_of_all + 0.1);
  EXPECT_NEAR(told.at("places").back().at("along").get<double>(), told.at("length").get<double>(), 1e-9);
}

TEST(WorldService, ClearanceAlongAPathIsThatOfItsJudgeForEveryBody) {
  const std::string hall = "bounds 0 0 100 60\nwall 50 0 50 25\nwall 50 40 50 60\nstart 10 30 0\ngoal 90 30 0\n";
  for (const auto& [scene, robot] :
       {std::pair{std::string(town), "point"}, std::pair{std::string(town), "disc 2"},
        std::pair{hall, "polygon -4 -1 4 -1 4 1 -4 1"}, std::pair{hall, "car polygon -1 -1 4 -1 4 1 -1 1 turning 5"}}) {
    SCOPED_TRACE(robot);
    Served served(scene_of(scene), {.robot = robot_value("robot", robot)});
    const HttpResponse answer = served.query(Json::object());
    expect_the_judges_clearance(served, answer);
    const std::string address = "/api/path/" + field(answer, "Warren-Path") + "/clearance";
    EXPECT_EQ(Json::parse(served.get(address).body).at("places").size(), 200U);
    for (const char* count : {"1", "2001", "2.5", "x", "-3", ""}) {
      EXPECT_EQ(served.get(address, {{"samples", count}}).status, 400U) << count;
    }
  }
  Served served(scene_of(town));
  EXPECT_EQ(served.get("/api/path/0123456789abcdef/clearance").status, 404U);
}

TEST(WorldService, ClearanceAlongAPathIsThatOfItsJudgeOnMapsAndRoadmaps) {
  std::string map = "type octile\nheight 20\nwidth 40\nmap\n";
  for (int row = 0; row < 20; ++row)
    map += std::string(18, '.') + std::string(4, row < 12 ? '@' : '.') + std::string(18, '.') + "\n";
  const TemporaryDirectory folder;
  folder.write("a.map", map);
  const std::string three = "{\"start\":[6,14,0],\"goal\":[34,14,0]}";
  for (const auto& [robot, ends] : {std::pair{"point", std::string("{\"start\":[6,14],\"goal\":[34,14]}")},
                                    std::pair{"disc 1.5", std::string("{\"start\":[6,14],\"goal\":[34,14]}")},
                                    std::pair{"polygon -2 -1 2 -1 2 1 -2 1", three},
                                    std::pair{"car polygon -1 -1 2 -1 2 1 -1 1 turning 2", three}}) {
    for (const bool asks_roadmap : {false, true}) {
      SCOPED_TRACE(fmt::format("{}, {}", robot, asks_roadmap));
      const Question body{.robot = robot_value("robot", robot)};
      Scene world = read_world(folder.file("a.map"), {});
      Served served = asks_roadmap ? Served(build(std::move(world), body, {.planner = PlannerKind::prm}))
                                   : Served(std::move(world), body);
      const HttpResponse answer = served.post("/api/query", ends);
      ASSERT_EQ(Json::parse(answer.body).at("status"), "solved") << answer.body.substr(0, 300);
      expect_the_judges_clearance(served, answer);
    }
  }
}

/// 40 x 20 free cells, the right half of them dear, a block in the middle forbidden by the service's own words.
Question priced_body() {
  Question body{.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.4}};
  body.prices.keep_out.push_back({{{15, 0}, {25, 0}, {25, 15}, {15, 15}}});
  return body;
}
Scene open_map(const TemporaryDirectory& folder) {
  std::string map = "type octile\nheight 20\nwidth 40\nmap\n";
  for (int row = 0; row < 20; ++row) map += std::string(40, '.') + "\n";
  folder.write("a.map", map);
  return read_world(folder.file("a.map"), {});
}

TEST(WorldService, WhatTheServiceForbidsBindsAnswersEdgesAndClearance) {
  const TemporaryDirectory folder;
  Served served(open_map(folder), priced_body());
  const Json answer = Json::parse(served.query({{"start", {5, 5}}, {"goal", {35, 5}}}).body);
  ASSERT_EQ(answer.at("status"), "solved");
  EXPECT_GT(answer.at("length").get<double>(), 36.0);  // around, not 30 through it
  const Json through = Json::parse(served.post("/api/check", R"({"edges": [[5, 5, 35, 5], [5, 17, 35, 17]]})").body);
  EXPECT_FALSE(through.at("edges")[0].at("free"));
  EXPECT_TRUE(through.at("edges")[1].at("free"));
  const Json ground = Json::parse(served.get("/api/world").body).at("ground");
  ASSERT_EQ(ground.size(), 1U);
  EXPECT_EQ(ground[0].at("label"), "keep out");
  EXPECT_EQ(ground[0].at("chains")[0].size(), 4U);
}

TEST(WorldService, PricesAndChoicesOfAQuestionAreThoseOfSolve) {
  const TemporaryDirectory folder;
  Served served(open_map(folder), priced_body());
  Question asked = priced_body();
  asked.start = {5, 5};
  asked.goal = {20, 5};  // forbidden
  asked.prices.clearance = ClearancePrice{3.0, 2.0};
  asked.rule.tolerance = 6.0;
  const Answer expected = solve(open_map(folder), asked);
  ASSERT_TRUE(expected.verified);
  const Json answer = Json::parse(
      served
          .post("/api/query",
                R"({"start": [5, 5], "goal": [20, 5], "prices": ["clearance-price 3 2"], "goal_tolerance": 6})")
          .body);
  ASSERT_EQ(answer.at("status"), "solved");
  EXPECT_EQ(answer.at("cost").get<double>(), *expected.cost);
  EXPECT_GT(answer.at("price").at("clearance").get<double>(), 0.0);
  EXPECT_GT(answer.at("goal_reached").at("distance").get<double>(), 4.0);
}

TEST(WorldService, ARoadmapsAreasAreDrawn) {
  Question body;
  body.prices.areas.push_back({3.0, {{20, 20}, {40, 20}, {40, 40}}, 0});
  const SolveOptions options{.planner = PlannerKind::prm, .roadmap = {.samples = 50}};
  Served served(build(scene_of("bounds 0 0 100 60\n"), body, options));
  EXPECT_EQ(Json::parse(served.get("/api/world").body).at("ground").size(), 1U);
}

TEST(WorldService, ARoadmapKnowsNoPrices) {
  const TemporaryDirectory folder;
  Served served(build(open_map(folder), {}, {.planner = PlannerKind::prm}));
  const HttpResponse refused =
      served.post("/api/query", R"({"start": [5, 5], "goal": [20, 5], "prices": ["unknown 2"]})");
  EXPECT_EQ(refused.status, 400U);
  EXPECT_NE(refused.body.find("a roadmap knows no prices"), std::string::npos) << refused.body;
}

TEST(WorldService, TheSweepIsTheBodyOnItsWay) {
  const std::string hall = "bounds 0 0 100 60\nwall 50 0 50 25\nwall 50 40 50 60\nstart 10 30 0\ngoal 90 30 0\n";
  for (const char* robot : {"disc 2", "polygon -4 -1 4 -1 4 1 -4 1", "car polygon -1 -1 4 -1 4 1 -1 1 turning 5"}) {
    SCOPED_TRACE(robot);
    Served served(scene_of(hall), {.robot = robot_value("robot", robot)});
    const bool is_disc = served.world().robot().kind == RobotKind::disc;
    const HttpResponse answer = served.query(is_disc ? Json{{"start", {10, 30}}, {"goal", {90, 30}}} : Json::object());
    const std::string address = "/api/path/" + field(answer, "Warren-Path") + "/sweep";
    const Json told = Json::parse(served.get(address).body);
    EXPECT_EQ(told.at("outline").size(), is_disc ? 0U : 4U);
    EXPECT_EQ(told.at("radius"), is_disc ? 2.0 : 0.0);
    ASSERT_GT(told.at("places").size(), 20U);
    EXPECT_EQ(told.at("places").front()[0], 10.0);
    EXPECT_EQ(told.at("places").back()[0], 90.0);
    const double needed = Json::parse(answer.body).at("min_clearance");
    for (const Json& place : told.at("places")) {
      EXPECT_GE(served.world().clearance_at(place.get<std::vector<double>>(), {}), needed - 1e-9) << place;
    }
    const Json seen = Json::parse(served.get(address, {{"bbox", "40,0,60,60"}}).body);
    EXPECT_GT(seen.at("places").size(), 5U);
    EXPECT_LT(seen.at("places").size(), told.at("places").size());
    EXPECT_EQ(served.get(address, {{"bbox", "40,0,60"}}).status, 400U);
  }
}

TEST(WorldService, AQuestionMayNameAnotherBody) {
  const std::string hall = "bounds 0 0 100 60\nwall 50 0 50 28\nwall 50 32 50 60\nstart 10 30\ngoal 90 30\n";
  Served served(scene_of(hall), {.robot = robot_value("robot", "disc 1")});
  const std::string own = field(served.query(Json::object()), "Warren-Path");
  for (const char* robot : {"disc 1.5", "point", "[[-4, -1], [4, -1], [4, 1], [-4, 1]]"}) {
    SCOPED_TRACE(robot);
    const HttpResponse told = served.query({{"start", {10, 30, 0}}, {"robot", robot}});
    const bool turns = robot[0] == '[';
    EXPECT_EQ(told.status, turns ? 200U : 400U);
    const HttpResponse answer =
        turns ? told : served.query({{"start", {10, 30}}, {"robot", robot}, {"clearance", 0.05}});
    const Json json = Json::parse(answer.body);
    ASSERT_EQ(json.at("status"), "solved") << json;
    const std::string name = field(answer, "Warren-Path");
    EXPECT_NE(name, own);
    const Json room = Json::parse(served.get("/api/path/" + name + "/clearance").body);
    double least = 1e9;
    for (const Json& place : room.at("places")) least = std::min(least, place.at("clearance").get<double>());
    EXPECT_GE(least, json.at("min_clearance").get<double>() - 1e-9);
    EXPECT_LT(least, turns ? 1.5 : 2.0);
    const Json world = Json::parse(served.get("/api/world", {{"robot", robot}, {"clearance", "0.05"}}).body);
    EXPECT_EQ(world.at("robot"), robot_text(robot_value("robot", robot)));
    EXPECT_EQ(world.at("clearance"), 0.05);
    EXPECT_EQ(world.at("state_size"), turns ? 3 : 2);
    EXPECT_EQ(served.get("/api/path/" + name + "/sweep").status, robot == std::string("point") ? 400U : 200U);
    const std::string scene = served.get("/api/scene", {{"robot", robot}, {"start", turns ? "1,1,0" : "1,1"}}).body;
    EXPECT_NE(scene.find("robot " + robot_text(robot_value("robot", robot))), std::string::npos) << scene;
  }
  EXPECT_NE(Json::parse(served.query({{"robot", "disc 3"}}).body).at("status"), "solved");
  EXPECT_NE(Json::parse(served.query({{"clearance", 2}}).body).at("status"), "solved");
  EXPECT_EQ(Json::parse(served.query(Json::object()).body).at("status"), "solved");
}

TEST(WorldService, AHeadingOfTheWorldIsNotPassedOver) {
  Served served(scene_of("bounds 0 0 100 60\nstart 10 30 0.5\ngoal 90 30 0.5\n"));
  const HttpResponse refused = served.query(Json::object());
  EXPECT_EQ(refused.status, 400U);
  EXPECT_NE(refused.body.find("a point has no heading, and no line names the robot; say robot"), std::string::npos)
      << refused.body;
  EXPECT_EQ(served.query({{"start", {10, 30}}}).status, 400U);
  EXPECT_EQ(served.query({{"start", {10, 30}}, {"goal", {90, 30}}}).status, 200U);
  EXPECT_EQ(served.query({{"robot", "disc 1"}}).status, 200U);
}

TEST(WorldService, BodiesThatCanNotBeAskedAreRefused) {
  Served open(scene_of(town));
  for (const char* robot : {"", "disc", "disc -1", "puma560 radius 0.1", "arm table.dh radius 0.1", "[[0, 1"}) {
    EXPECT_EQ(open.query({{"robot", robot}}).status, 400U) << robot;
    EXPECT_EQ(open.get("/api/world", {{"robot", robot}}).status, 400U) << robot;
  }
  EXPECT_EQ(open.query({{"clearance", -1}}).status, 400U);
  EXPECT_EQ(open.get("/api/world", {{"clearance", "-1"}}).status, 400U);
  Served kept(build(scene_of(town)));
  EXPECT_EQ(kept.query({{"robot", "disc 0.1"}}).status, 400U);
  EXPECT_EQ(kept.query({{"robot", "point"}}).status, 200U);
}

TEST(WorldService, APointHasNoSweep) {
  Served served(scene_of(town));
  const HttpResponse answer = served.query(Json::object());
  EXPECT_EQ(served.get("/api/path/" + field(answer, "Warren-Path") + "/sweep").status, 400U);
  EXPECT_EQ(served.get("/api/path/0123456789abcdef/sweep").status, 404U);
}

TEST(WorldService, ClearanceAlongAPathOfALargeMazeIsHalfACorridor) {
  Served served(read_world("maze:300x300,seed=7,loops=0.05", {}));
  const HttpResponse answer = served.query(Json::object());
  const Json told = Json::parse(served.get("/api/path/" + field(answer, "Warren-Path") + "/clearance").body);
  for (const Json& place : told.at("places")) {
    EXPECT_GE(place.at("clearance"), 0.5);
    EXPECT_LT(place.at("clearance"), 1.5);
  }
}

TEST(WorldService, APathThatGoesNowhereHasTheClearanceOfItsPlace) {
  Served served(scene_of("wall 0 0 0 0.5\nbounds -10 -10 10 10\nstart -5 0\ngoal -5 0\n"));
  const HttpResponse answer = served.query(Json::object());
  const Json told = Json::parse(served.get("/api/path/" + field(answer, "Warren-Path") + "/clearance").body);
  EXPECT_EQ(told.at("places").size(), 1U);
  EXPECT_DOUBLE_EQ(told.at("places")[0].at("clearance"), 5.0);
}

TEST(WorldService, TilesAreKeptAndSayThatTheyNeverChange) {
  Served served(scene_of(town));
  const std::string hash = Json::parse(served.get("/api/world").body).at("hash");
  const HttpResponse first = served.get("/v/" + hash + "/tiles/1/0/0.png");
  ASSERT_EQ(first.status, 200U);
  EXPECT_EQ(first.type, "image/png");
  EXPECT_TRUE(first.body.starts_with("\x89PNG"));
  EXPECT_NE(field(first, "Cache-Control").find("immutable"), std::string::npos);
  const auto again = served.service().at_once({.path = "/tiles/1/0/0.png"}, {});
  ASSERT_TRUE(again.has_value()) << "it is not drawn anew";
  EXPECT_EQ(again->body, first.body);
  EXPECT_EQ(field(*again, "Cache-Control"), "no-cache");
  const HttpResponse same = served.asked({.path = "/tiles/1/0/0.png", .if_none_match = field(first, "ETag")});
  EXPECT_EQ(same.status, 304U);
  EXPECT_EQ(served.get("/v/0000000000000000/tiles/1/0/0.png").status, 404U);
}

TEST(WorldService, ALargeMazeIsARoadmapWithTheSameAnswers) {
  const Scene maze = read_world("maze:300x300,seed=7,loops=0.05", {});
  Served served(read_world("maze:300x300,seed=7,loops=0.05", {}));
  EXPECT_EQ(Json::parse(served.get("/api/world").body).at("asks_roadmap"), true);
  for (const auto& [start, goal] :
       {std::pair<Vec2, Vec2>{{1, 1}, {300, 300}}, {{17, 250}, {281, 3}}, {{4.3, 4.2}, {100.1, 99.8}}}) {
    const Answer expected = solve(maze, {.start = {start.x, start.y}, .goal = {goal.x, goal.y}});
    const Json answer = Json::parse(served.query({{"start", {start.x, start.y}}, {"goal", {goal.x, goal.y}}}).body);
    EXPECT_EQ(answer.at("status"), name_of(expected.outcome));
    EXPECT_NEAR(answer.at("length").get<double>(), expected.length, 1e-9 * expected.length);
  }
}

TEST(WorldService, ABatchIsForRoadmapsAndAnswersLineByLine) {
  Served served(build(scene_of(town)));
  EXPECT_EQ(Json::parse(served.get("/api/world").body).at("opened_as"), "roadmap");
  const HttpResponse response = served.post(
      "/api/query/batch",
      "{\"id\": 7, \"start\": [5, 5], \"goal\": [95, 55]}\n{\"start\": [75, 30], \"goal\": [5, 5]}\n{\"x\": 1}\n");
  ASSERT_EQ(response.status, 200U) << response.body;
  EXPECT_EQ(response.type, "application/x-ndjson");
  std::istringstream lines(response.body);
  std::string line;
  std::vector<Json> answers;
  while (std::getline(lines, line)) answers.push_back(Json::parse(line));
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].at("id"), 7);
  EXPECT_EQ(answers[0].at("status"), "solved");
  EXPECT_EQ(answers[1].at("status"), "start_blocked");
  EXPECT_TRUE(answers[2].contains("error"));
  EXPECT_EQ(served.post("/api/query/batch", "{\"start\": " + std::string(20, '[') + "\n").status, 400U);
  EXPECT_EQ(served.query({{"planner", "rrt"}}).status, 400U) << "the roadmap has its own";
  Served small(build(scene_of(town)), {.batch_answers = 100});
  EXPECT_EQ(small.post("/api/query/batch", "{\"start\": [5, 5], \"goal\": [95, 55]}\n").status, 413U);
  Served world(scene_of(town));
  EXPECT_EQ(code_of(world.post("/api/query/batch", "{}\n")), "no_roadmap");
}

TEST(WorldService, ArmsAreRefused) {
  EXPECT_THROW(Served(scene_of("robot puma560 radius 0.05\nsphere 1 1 1 0.1\n")), UsageError);
}

TEST(WorldService, SaysHowItIs) {
  Served served(scene_of(town));
  EXPECT_EQ(served.get("/api/health").body, "{\"status\":\"ok\"}\n");
  const HttpResponse metrics = served.asked({.path = "/api/metrics"});
  EXPECT_TRUE(metrics.type.starts_with("text/plain"));
  EXPECT_NE(metrics.body.find("\n# TYPE warren_connections gauge\nwarren_connections 0\n"), std::string::npos);
  EXPECT_NE(metrics.body.find("warren_responses_total{status=\"2xx\"} 0\n"), std::string::npos);
}

TEST(WorldService, ThePageIsInTheProgram) {
  Served served(scene_of(town));
  const HttpResponse page = served.get("/");
  EXPECT_EQ(page.status, 200U);
  EXPECT_EQ(served.get("/index.html").body, page.body);
  EXPECT_EQ(served.asked({.path = "/", .if_none_match = field(page, "ETag")}).status, 304U);
  EXPECT_EQ(served.get("/nothing.js").status, 404U);
}

TEST(WorldService, AllAddressesOfPageAndInterfaceAreRelativeSoThatItMayLieBelowAnyPath) {
  for (const char* name : {"index.html", "ask.js", "clearance.js", "controls.js", "draw.js", "graph.js",
                           "graph_editor.js", "heading.js", "layers.js", "measure.js", "sweep.js", "world.js"}) {
    const auto file = served_file(name);
    if (!file) continue;  // without Leaflet
    for (const char* absolute : {"\"/api", "href=\"/", "src=\"/", "fetch(\"/", "'/"}) {
      EXPECT_EQ(file->bytes.find(absolute), std::string_view::npos) << name << " " << absolute;
    }
  }
  const std::string said = Served(scene_of(town)).get("/api/world").body;
  EXPECT_NE(said.find("\"url\":\"v/"), std::string::npos) << said;
  EXPECT_EQ(said.find("\"/"), std::string::npos) << said;
}

}  // namespace
}  // namespace warren::serve
