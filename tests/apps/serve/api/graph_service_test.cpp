// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "solve/kept/export_roadmap.hpp"
#include "tests/apps/serve/town.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren::serve {
namespace {

using Json = nlohmann::json;

constexpr const char* route = R"({"type":"FeatureCollection","name":"yard","features":[
{"type":"Feature","properties":{"id":7,"frame":"map","metadata":{"speed":1.0,"lamps":3}},"geometry":{"type":"Point","coordinates":[5,5]}},
{"type":"Feature","properties":{"id":3},"geometry":{"type":"Point","coordinates":[95,5,0]}},
{"type":"Feature","properties":{"id":9,"startid":7,"endid":3,"cost":2.5,"overridable":false},"geometry":{"type":"LineString","coordinates":[]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[]}}]})";

class Graphs {
 public:
  explicit Graphs(const std::string& scene = town, const std::string& robot = "disc 1")
      : world_(scene_of(scene), {.robot = robot_value("robot", robot)}, {}) {}
  explicit Graphs(Roadmap roadmap) : world_(std::move(roadmap), {}) {}
  HttpResponse asked(Place place, const std::string& body) {
    try {
      return answer_of_graphs(world_, place, body, {});
    } catch (const HttpError& error) {
      return error_response(error);
    } catch (const UsageError& error) {
      return error_response({400, "usage", "", error.what()});
    }
  }
  Json json(Place place, const std::string& body) { return Json::parse(asked(place, body).body); }
  std::string why(Place place, const std::string& body) { return json(place, body).at("error").at("message"); }
  const ServedWorld& world() const { return world_; }

 private:
  ServedWorld world_;
};

void expect_all_free(const Json& graph) {
  EXPECT_FALSE(graph.at("verdicts").empty());
  for (const Json& verdict : graph.at("verdicts")) EXPECT_TRUE(verdict.at("free").get<bool>());
}

/// What nav2_route's loader asks of a file, and that ids are given once.
void expect_that_nav2_loads(const Json& file) {
  std::set<std::uint64_t> ids;
  std::map<std::uint64_t, Json> nodes;
  std::size_t edges = 0;
  for (const Json& feature : file.at("features")) {
    const Json& properties = feature.at("properties");
    EXPECT_TRUE(properties.at("id").is_number_unsigned());
    EXPECT_TRUE(ids.insert(properties.at("id").get<std::uint64_t>()).second);
    if (feature.at("geometry").at("type") == "Point") {
      nodes[properties.at("id").get<std::uint64_t>()] = feature.at("geometry").at("coordinates");
    }
  }
  for (const Json& feature : file.at("features")) {
    if (feature.at("geometry").at("type") != "MultiLineString") continue;
    ++edges;
    const Json& p = feature.at("properties");
    EXPECT_EQ(feature.at("geometry").at("coordinates"),
              Json({{nodes.at(p.at("startid").get<std::uint64_t>()), nodes.at(p.at("endid").get<std::uint64_t>())}}));
    EXPECT_TRUE(p.at("cost").is_number());
  }
  EXPECT_FALSE(nodes.empty());
  EXPECT_GT(edges, 0U);
  EXPECT_EQ(nodes.size() + edges, file.at("features").size());
}

TEST(GraphService, ABuiltGraphIsTheOneThatBuildAndExportWrite) {
  Graphs graphs;
  for (const auto& [kind, planner] :
       {std::pair{"axis", PlannerKind::voronoi}, std::pair{"roadmap", PlannerKind::prm}}) {
    SCOPED_TRACE(kind);
    Json body{{"kind", kind}};
    if (planner == PlannerKind::prm) body["samples"] = 200;
    const HttpResponse built = graphs.asked(Place::graph, body.dump());
    ASSERT_EQ(built.status, 200U) << built.body;
    expect_all_free(Json::parse(built.body));
    const Json saved = graphs.json(Place::save_graph, built.body);
    expect_that_nav2_loads(saved);
    const TemporaryDirectory folder;
    SolveOptions options{.planner = planner};
    if (planner == PlannerKind::prm) options.roadmap.samples = 200;
    const Roadmap roadmap = build(scene_of(town), {.robot = robot_value("robot", "disc 1")}, options);
    export_of_roadmap(roadmap, folder.file("a.geojson"));
    EXPECT_EQ(saved, Json::parse(folder.read("a.geojson")));
  }
}

TEST(GraphService, WhatPeopleHaveWrittenIsKept) {
  Graphs graphs;
  const HttpResponse opened = graphs.asked(Place::open_graph, route);
  ASSERT_EQ(opened.status, 200U) << opened.body;
  EXPECT_EQ(Json::parse(opened.body).at("left_out"), 1);
  const std::string text = graphs.asked(Place::save_graph, opened.body).body;
  const Json saved = Json::parse(text);
  expect_that_nav2_loads(saved);
  EXPECT_EQ(saved.at("name"), "yard");
  EXPECT_NE(text.find(R"("metadata":{"speed":1.0,"lamps":3})"), std::string::npos) << text;  // types are by the point
  EXPECT_EQ(saved.at("features")[2].at("properties"),
            Json::parse(R"({"id":9,"startid":7,"endid":3,"cost":2.5,"overridable":false})"));
}

/// As Nav2's loader takes its own graphs: edges are told apart by their ends, nodes by their ids, the last of which
/// wins.
TEST(GraphService, EdgesMayShareTheirIdsAndLeadFromANodeToItself) {
  constexpr const char* file = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":1,"frame":"map"},"geometry":{"type":"Point","coordinates":[75,30]}},
{"type":"Feature","properties":{"id":1,"frame":"map"},"geometry":{"type":"Point","coordinates":[5,5]}},
{"type":"Feature","properties":{"id":2,"frame":"map"},"geometry":{"type":"Point","coordinates":[95,5]}},
{"type":"Feature","properties":{"id":2,"startid":1,"endid":2},"geometry":{"type":"LineString","coordinates":[]}},
{"type":"Feature","properties":{"id":2,"startid":2,"endid":1},"geometry":{"type":"LineString","coordinates":[]}},
{"type":"Feature","properties":{"id":2,"startid":2,"endid":2,"cost":0},"geometry":{"type":"LineString","coordinates":[]}}]})";
  for (const char* robot : {"disc 1", "polygon -2 -1 2 -1 2 1 -2 1"}) {
    SCOPED_TRACE(robot);
    Graphs graphs(town, robot);
    const HttpResponse opened = graphs.asked(Place::open_graph, file);
    ASSERT_EQ(opened.status, 200U) << opened.body;
    const Json graph = Json::parse(opened.body);
    EXPECT_EQ(graph.at("left_out"), 1);
    EXPECT_EQ(graph.at("nodes").size(), 2U);
    EXPECT_EQ(graph.at("nodes")[0].at("at"), Json({5, 5}));
    EXPECT_EQ(graph.at("edges").size(), 3U);
    expect_all_free(graph);
    const Json saved = graphs.json(Place::save_graph, opened.body);
    EXPECT_EQ(saved.at("features").size(), 5U);
    EXPECT_EQ(saved.at("features")[4].at("properties"), Json::parse(R"({"id":2,"startid":2,"endid":2,"cost":0.0})"));
    EXPECT_EQ(graphs.asked(Place::open_graph, saved.dump()).status, 200U);
  }
  Graphs graphs;
  Json twice = graphs.json(Place::open_graph, file);
  twice["nodes"].push_back(twice["nodes"][0]);
  EXPECT_EQ(graphs.why(Place::save_graph, twice.dump()), "the id 1 is given to two nodes");
}

/// Nav2's graph saver gives edges no coordinates at all, operations stand in an object by their names, metadata hold
/// objects and lists, and two nodes may stand at one place. What is not known here stays as it was.
TEST(GraphService, AGraphAsNav2SavesItStaysWhatItWas) {
  constexpr const char* file =
      R"({"crs":{"properties":{"name":"urn:ogc:def:crs:EPSG::3857"},"type":"name"},"date_generated":"Wed","features":[
{"geometry":{"coordinates":[5,5],"type":"Point"},"properties":{"frame":"map","id":0,
 "metadata":{"region":{"properties":{"class_type":"living_room","number_of_lights":10},"x_values":[1.0,-1.0]}},
 "operations":{"stop":{"metadata":{"wait_for":5.0},"trigger":"NODE","type":"stop"}}},"type":"Feature"},
{"geometry":{"coordinates":[95,5],"type":"Point"},"properties":{"frame":"map","id":1},"type":"Feature"},
{"geometry":{"coordinates":[95,5],"type":"Point"},"properties":{"frame":"map","id":33},"type":"Feature"},
{"geometry":{"type":"MultiLineString"},"properties":{"cost":10.0,"endid":1,"id":9,"metadata":{"speed_limit":0.85},
 "operations":{"take_picture":{"metadata":{"resolution":[1080,720]},"trigger":"ON_EXIT","type":"take_picture"}},
 "overridable":false,"startid":0},"type":"Feature"},
{"geometry":{"type":"MultiLineString"},"properties":{"cost":0.0,"endid":33,"id":8,"overridable":true,"startid":0},"type":"Feature"},
{"geometry":{"type":"MultiLineString"},"properties":{"cost":0.0,"endid":33,"id":10,"overridable":true,"startid":1},"type":"Feature"}
],"name":"graph","type":"FeatureCollection"})";
  Graphs graphs;
  const HttpResponse opened = graphs.asked(Place::open_graph, file);
  ASSERT_EQ(opened.status, 200U) << opened.body;
  expect_all_free(Json::parse(opened.body));
  const Json saved = graphs.json(Place::save_graph, opened.body);
  expect_that_nav2_loads(saved);
  const Json given = Json::parse(file);
  EXPECT_EQ(saved.at("date_generated"), "Wed");
  ASSERT_EQ(saved.at("features").size(), given.at("features").size());
  for (std::size_t i = 0; i < saved.at("features").size(); ++i) {
    EXPECT_EQ(saved.at("features")[i].at("properties"), given.at("features")[i].at("properties")) << i;
  }
}

TEST(GraphService, AnEdgeThroughAWallIsToldAndNotSaved) {
  Graphs graphs;
  Json graph = graphs.json(Place::open_graph, route);
  graph["nodes"][1]["at"] = {75, 30};
  const HttpResponse said = graphs.asked(Place::save_graph, graph.dump());
  EXPECT_EQ(said.status, 422U);
  EXPECT_EQ(Json::parse(said.body).at("error").at("message").get<std::string>().substr(0, 84),
            "1 of 1 edges are not free, so nothing is saved; edge 9 from node 7 to 3: it meets po");
  const Json verdict = graphs.json(Place::check, R"({"edges":[[5,5,75,30],[5,5,95,5]]})").at("edges");
  EXPECT_EQ(verdict[0].at("free"), false);
  EXPECT_EQ(verdict[1].at("free"), true);
}

TEST(GraphService, BodiesThatTurnHaveHeadings) {
  Graphs graphs(town, "polygon -2 -1 2 -1 2 1 -2 1");
  const HttpResponse built =
      graphs.asked(Place::graph, R"({"kind":"roadmap","samples":)" + std::to_string(test::share(100, 40)) + "}");
  ASSERT_EQ(built.status, 200U) << built.body;
  EXPECT_TRUE(Json::parse(built.body).at("nodes")[0].contains("theta"));
  expect_all_free(Json::parse(built.body));
  const Json saved = graphs.json(Place::save_graph, built.body);
  expect_that_nav2_loads(saved);
  EXPECT_TRUE(saved.at("features")[0].at("properties").at("metadata").at("theta").is_number_float());
  const Json axis = graphs.json(Place::graph, R"({"kind":"axis"})");
  EXPECT_FALSE(axis.at("nodes")[0].contains("theta"));
  expect_all_free(axis);
}

/// Other writers than Nav2's have ids as 3.0, and null for what is not there; Nav2 loads both.
TEST(GraphService, WholeNumbersMayHaveAPointAndMetadataMayBeNull) {
  constexpr const char* file = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":1.0,"metadata":null,"operations":null},"geometry":{"type":"Point","coordinates":[5,5]}},
{"type":"Feature","properties":{"id":2.0},"geometry":{"type":"Point","coordinates":[95,5]}},
{"type":"Feature","properties":{"id":3.0,"startid":1.0,"endid":2},"geometry":{"type":"LineString","coordinates":[]}}]})";
  Graphs graphs;
  const HttpResponse opened = graphs.asked(Place::open_graph, file);
  ASSERT_EQ(opened.status, 200U) << opened.body;
  const Json saved = graphs.json(Place::save_graph, opened.body);
  EXPECT_EQ(saved.at("features")[2].at("properties").at("startid").dump(), "1");
  for (const char* id : {"1.5", "-1.0", "\"1\"", "1e300", "4294967295.0"}) {
    std::string text = file;
    text.replace(text.find("1.0"), 3, id);
    EXPECT_EQ(graphs.why(Place::open_graph, text).substr(0, 42), "feature 1: id: expected a whole number, 0 ") << id;
  }
}

TEST(GraphService, WhatNav2WouldNotLoadIsRefusedWithItsPlace) {
  Graphs graphs;
  struct Case {
    std::string from;
    std::string to;
    std::string said;
  };
  for (const Case& c : {
           Case{"\"id\":3}", "\"id\":7}", "edge 9: there is no node 3"},
           Case{"\"id\":9", "\"id\":-9", "feature 3: id: expected a whole number, 0 to 4294967294"},
           Case{"\"id\":9", "\"id\":4294967295", "feature 3: id: expected a whole number, 0 to 4294967294"},
           Case{"\"endid\":3", "\"endid\":4", "edge 9: there is no node 4"},
           Case{"\"endid\":3", "\"endid\":9", "edge 9: there is no node 9"},
           Case{"\"endid\":3,", "", "feature 3: endid: expected a whole number"},
           Case{"[95,5,0]", "[95]", "feature 2: expected coordinates x, y"},
           Case{"[95,5,0]", "[95,\"5\"]", "feature 2: y: expected a number"},
           Case{"[95,5,0]", "[95,1e61]", "feature 2: y: expected a number of at most 1e60"},
           Case{"\"id\":3}", "\"id\":3,\"frame\":\"odom\"}", "feature 2: frame: expected map, as nodes before have it"},
           Case{"\"lamps\":3", "\"lamps\":null", "feature 1: metadata.lamps: expected a number, a text"},
           Case{"\"overridable\"", "\"operations\":[{\"type\":\"x\"}],\"o\"",
                "feature 3: operations: expected trigger"},
           Case{"\"LineString\"", "\"Line\"", "Nav2 loads no route graph without edges"},
           Case{"\"features\"", "\"feature\"", "body: expected a FeatureCollection"},
           Case{"]})", "]}", "line 5: expected JSON"},
       }) {
    SCOPED_TRACE(c.to);
    std::string text = route;
    const std::size_t at = text.rfind(c.from);
    if (at != std::string::npos) text.replace(at, c.from.size(), c.to);
    if (c.from == "]})") text.pop_back();
    EXPECT_EQ(graphs.why(Place::open_graph, text).substr(0, c.said.size()), c.said);
  }
}

TEST(GraphService, HostileBodiesAreRefused) {
  Graphs graphs;
  for (const std::string& body :
       {std::string("{\"edges\":[[0,0,1,NaN]]}"), std::string("{\"edges\":[[0,0,1,1e999]]}"), std::string("[]"),
        std::string("{\"edges\":") + std::string(100'000, '['), std::string("{\"edges\":[[0,0,1,\"1\"]]}"),
        std::string("{\"edges\":[[0,0,2000,1,1,2000]]}"), std::string("{\"edges\":[],\"more\":1}"), std::string()}) {
    SCOPED_TRACE(body.substr(0, 40));
    EXPECT_EQ(graphs.asked(Place::check, body).status, 400U);
  }
  Json graph = graphs.json(Place::open_graph, route);
  graph["nodes"][0]["more"] = R"({"id":5,"frame":"x","a":1})";  // what is told beside it is not told twice
  EXPECT_EQ(graphs.json(Place::save_graph, graph.dump()).at("features")[0].at("properties"),
            Json::parse(R"({"id":7,"frame":"map","a":1})"));
  graph["nodes"][0]["more"] = "}{";
  EXPECT_EQ(graphs.asked(Place::save_graph, graph.dump()).status, 400U);
  EXPECT_EQ(graphs.asked(Place::graph, R"({"kind":"roadmap","samples":30000})").status, 413U);
}

TEST(GraphService, CarsAreRefusedWithTheReason) {
  Graphs graphs("bounds 0 0 100 60\n", "car radius 1 turning 5");
  for (const Place place : {Place::graph, Place::check}) {
    EXPECT_NE(graphs.why(place, place == Place::check ? R"({"edges":[]})" : "{}").find("a car drives curves"),
              std::string::npos);
  }
}

/// A round differential drive is a disc that turns at nodes, unless its roadmap steers it otherwise.
TEST(GraphService, ARoundDifferentialDriveHasGraphs) {
  const std::string open = "bounds 0 0 100 60\n";
  const std::string drive = "car radius 1 turning 5 steering differential";
  Graphs graphs(open, drive);
  const Json graph = graphs.json(Place::graph, R"({"kind":"roadmap","samples":100,"neighbours":4})");
  expect_all_free(graph);
  EXPECT_FALSE(graph.at("nodes")[0].contains("theta"));
  SolveOptions options{.planner = PlannerKind::prm, .roadmap = {.samples = 50}};
  options.car.steering = SteeringKind::reeds_shepp;
  Graphs curves(build(scene_of(open), {.robot = robot_value("robot", drive)}, options));
  EXPECT_NE(curves.why(Place::check, R"({"edges":[]})").find("a car drives curves"), std::string::npos);
}

}  // namespace
}  // namespace warren::serve
