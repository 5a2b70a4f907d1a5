// SPDX-License-Identifier: BSD-3-Clause
// Polygon worlds through the program: made, converted, drawn, solved, verified, refused. The figures of the worlds in
// tests/data were computed as visibility_figures_test.cpp says.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/paths.hpp"
#include "tests/seeds.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::vector<std::string> arguments, int code = 0) {
  SCOPED_TRACE(shown(arguments));
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err;
  return Json::accept(outcome.out) ? Json::parse(outcome.out) : Json();
}

const std::string two_squares =
    "bounds -5 -5 10 10\npolygon 0 0 2 0 2 2 0 2\npolygon 2 2 2 4 4 4 4 2\nstart 1 3\ngoal 3 1\n";

TEST(Polygons, AreGeneratedConvertedAndToldApart) {
  const Folder folder;
  const std::string scene = folder.path("a.scene");
  ASSERT_EQ(run({"generate", "polygons", "50", "--corners", "9", "--seed", "3", "-o", scene}).code, 0);
  const Json info = json_of({"info", scene});
  EXPECT_EQ(info["kind"], "polygons");
  EXPECT_EQ(info["polygons"], 50);
  EXPECT_EQ(info["corners"], 450);
  ASSERT_EQ(run({"convert", scene, "-o", folder.path("b.geojson")}).code, 0);
  ASSERT_EQ(run({"convert", folder.path("b.geojson"), "-o", folder.path("c.scene")}).code, 0);
  const Json back = json_of({"info", folder.path("c.scene")});
  for (const char* key : {"polygons", "corners", "box", "bounds", "start", "goal"})
    EXPECT_EQ(back[key], info[key]) << key;
  for (const char* name : {"a.svg", "a.png", "a.html"}) {
    EXPECT_EQ(run({"render", scene, "-o", folder.path(name)}).code, 0) << name;
  }
  EXPECT_NE(folder.read("a.svg").find("id=\"polygons\""), std::string::npos);
  check({{"convert", scene, "-o", folder.path("d.wkt")}, 65, "polygons and walls alone"});
  check({{"convert", scene, "-o", folder.path("d.npy")}, 65, "walls alone"});
}

TEST(Polygons, RoadmapPlannersSolveAndVerifyThem) {
  const Folder folder;
  const std::string scene = folder.path("a.scene");
  ASSERT_EQ(run({"generate", "polygons", "40", "-o", scene}).code, 0);
  for (const std::vector<std::string>& how :
       std::vector<std::vector<std::string>>{{"--planner", "prm"},
                                             {"--planner", "lazy-prm"},
                                             {"--planner", "prm", "--optimise"},
                                             {"--planner", "lazy-prm", "--robot", "disc 0.2", "--clearance", "0.05"}}) {
    std::vector<std::string> arguments{"solve", scene};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const Json answer = json_of(arguments);
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["contact"], "blocked");
    EXPECT_EQ(answer["world"]["polygons"], 40);
    EXPECT_GT(answer["min_clearance"], 0.0);
    const std::string file = folder.write("answer.json", answer.dump());
    EXPECT_EQ(json_of({"verify", scene, file})["verified"], true);
    EXPECT_EQ(json_of({"verify", scene, file, "--clearance", "3"}, 1)["verified"], false);
  }
}

TEST(Polygons, VerifyKnowsBothKindsOfContact) {
  const Folder folder;
  const std::string scene = folder.write("a.scene", two_squares);
  const auto verdict = [&](const std::string& path, const std::string& contact, int code) {
    const std::string file = folder.write("p.json", "{\"path\": " + path + ", \"start\": null, \"goal\": null}");
    return json_of({"verify", scene, file, "--contact", contact, "--start", "1,3", "--goal", "3,1"}, code)["verified"];
  };
  const std::string around = "[[1, 3], [0, 2], [0, 0], [2, 0], [3, 1]]";
  EXPECT_EQ(verdict(around, "allowed", 0), true);
  EXPECT_EQ(verdict(around, "blocked", 1), false);
  EXPECT_EQ(verdict("[[1, 3], [3, 1]]", "allowed", 1), false) << "through the common corner";
  EXPECT_EQ(verdict("[[1, 3], [-1, 3], [-1, -1], [3, -1], [3, 1]]", "blocked", 0), true);
}

TEST(Polygons, PlacesInsideThemAreBlockedAndTouchingOnesEnclose) {
  const Folder folder;
  const std::string scene = folder.write("a.scene", two_squares);
  EXPECT_EQ(json_of({"solve", scene, "--planner", "prm", "--start", "1,1"}, 1)["status"], "start_blocked");
  EXPECT_EQ(json_of({"solve", scene, "--planner", "prm", "--goal", "2,3"}, 1)["status"], "goal_blocked");
  EXPECT_EQ(json_of({"solve", scene, "--planner", "prm", "--goal", "9,11"}, 1)["status"], "goal_blocked");
}

TEST(Polygons, ThatAreNoneAreRefusedByEveryVerbWithFileAndLine) {
  const Folder folder;
  const auto refused = [&](const std::string& name, const std::string& text, std::string_view said) {
    const std::string file = folder.write(name, text);
    check({{"solve", file, "--start", "9,9", "--goal", "8,8"}, 65, said});
    check({{"info", file}, 65, said});
    check({{"convert", file, "-o", folder.path("out.scene")}, 65, said});
  };
  refused("a.scene", "bounds -9 -9 9 9\npolygon 0 0 1 1\n", "a.scene:2: expected `polygon X Y");
  refused("a.scene", "bounds -9 -9 9 9\npolygon 0 0 1 1 0 0 1 1\n", "a.scene:2: this polygon has no area");
  refused("a.scene", "polygon 0 0 1 0 0 0\n", "a.scene:1: a polygon needs at least three different corners");
  refused("a.scene", "polygon 0 0 2 2 2 0 0 2\n", "a.scene:1: a polygon's outline must not cross or touch itself");
  refused("a.geojson", "{\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [1, 0], [0, 1]]]}",
          "a.geojson:1: a ring needs");
  refused("a.geojson", "{\"type\": \"Polygon\", ", "a.geojson:1: this is not JSON");
  refused("a.wkt", "POLYGON ((0 0, 1 0, 0 1))", "a.wkt:1: a ring needs");
  refused("a.wkt", "POLYGON (0 0, 1 0, 0 1)", "a.wkt:1: expected `(`");
  refused("a.poly", "0 0\n1 0\n\n", "a.poly:1: a polygon needs at least three");
  refused("a.environment", "// hi\n0 0 0\n", "a.environment:2: expected two numbers");
  EXPECT_FALSE(std::filesystem::exists(folder.path("out.scene")));
}

TEST(Polygons, AreGeneratedAsWktWithoutItsBoundsAndEndsAndThisIsSaid) {
  const Folder folder;
  const std::string file = folder.path("town.wkt");
  check({{"generate", "polygons", "30", "-o", file},
         0,
         "town.wkt: its format has no bounds, start, goal, robot: left out"});
  const Json info = json_of({"info", file});
  EXPECT_EQ(info["polygons"], 30);
  EXPECT_FALSE(info.contains("bounds") || info.contains("start"));
  check({{"generate", "polygons", "30", "-o", file, "--quiet"}, 0, ""});
}

TEST(Polygons, ImpossibleWordsOfGenerateAreUsageErrors) {
  check({{"generate", "polygons", "0", "-o", "/tmp/x.scene"}, 2, "COUNT"});
  check({{"generate", "polygons", "-5", "-o", "/tmp/x.scene"}, 2, ""});
  check({{"generate", "polygons", "5x5", "-o", "/tmp/x.scene"}, 2, "COUNT"});
  check({{"generate", "polygons", "5", "--corners", "2", "-o", "/tmp/x.scene"}, 2, "--corners"});
  check({{"generate", "polygons", "5", "--loops", "0.5", "-o", "/tmp/x.scene"}, 2, "generate maze"});
  check({{"generate", "maze", "5x5", "--corners", "4", "-o", "/tmp/x.scene"}, 2, "generate polygons"});
  check({{"generate", "polygons", "1000000000", "--corners", "9", "-o", "/tmp/x.scene"}, 2, "2^31"});
  check({{"generate", "spheres", "5", "-o", "/tmp/x.scene"}, 2, "maze or polygons"});
}

const std::string sparse = source_dir() + "/tests/data/sparse.scene";
const std::string dense = source_dir() + "/tests/data/dense.scene";

TEST(Polygons, KnownWorldsHaveTheirShortestPaths) {
  const Json answer = json_of({"solve", sparse});
  EXPECT_EQ(answer["planner"], "visibility");
  EXPECT_EQ(answer["contact"], "allowed");
  EXPECT_EQ(answer["optimal"], true);
  EXPECT_EQ(answer["verified"], true);
  EXPECT_TRUE(answer["sampler"].is_null());
  EXPECT_NEAR(answer["length"], 0.984660989043, 1e-9);
  EXPECT_EQ(answer["roadmap"]["edges"], 30);
  EXPECT_EQ(json_of({"solve", sparse, "--full"})["roadmap"]["edges"], 44);
  for (const char* how : {"--full", "--lazy", "--search=dijkstra", "--queue=sorted-array"}) {
    EXPECT_NEAR(json_of({"solve", dense, how})["length"], 0.826491095336, 1e-9) << how;
  }
  const Json bfs = json_of({"solve", dense, "--full", "--search", "bfs"});
  EXPECT_NEAR(bfs["length"], 1.281945865151, 1e-9);
  EXPECT_FALSE(bfs.contains("optimal"));
}

// Corners come within 0.01 of lines of sight, so that edges looked at every 0.01 cut them off.
TEST(Polygons, SampledEdgesAreToldWhereTheyAreWrong) {
  const Json answer = json_of({"solve", dense, "--sampled-edges", "0.01"}, 1);
  EXPECT_EQ(answer["status"], "refuted");
  EXPECT_EQ(answer["verified"], false);
  EXPECT_TRUE(answer["length"].is_null());
  EXPECT_EQ(answer["path"], Json::array());
  EXPECT_NEAR(answer["refuted"]["length"], 0.826484515350, 1e-9);
  EXPECT_EQ(answer["roadmap"]["edges"], 232);
  Json edges = Json::array();
  for (const Json& wrong : answer["wrong_edges"]) edges.push_back(wrong["edge"]);
  EXPECT_EQ(edges, Json::parse("[[0, 28], [0, 31], [0, 37], [8, 39], [11, 16], [18, 36], [18, 38], [31, 41]]"));
  EXPECT_FALSE(answer["refuted"]["first_violation"].is_null());
  EXPECT_GT(answer["refuted"]["path"].size(), 2U);
}

TEST(Polygons, WrongEdgesAndTheRefutedLengthAreToldOnTheScreenAndTheirProofIsNoPartOfTheTime) {
  const std::string said = run({"solve", dense, "--sampled-edges", "0.01", "--threads", "1"}).out;
  EXPECT_NE(said.find("length        0.826485, of the refuted path"), std::string::npos) << said;
  EXPECT_NE(said.find("8 of 232 pass through polygons, the deepest by "), std::string::npos) << said;
  EXPECT_NE(said.find("; proved in "), std::string::npos) << said;
  bool is_apart = false;  // the proof takes a hundred times as long; now and then another program may have the core
  for (int i = 0; i < 5 && !is_apart; ++i) {
    const Json answer = json_of({"solve", dense, "--sampled-edges", "0.01", "--threads", "1"}, 1);
    is_apart = answer["solve_s"].get<double>() < answer["proof_s"].get<double>();
  }
  EXPECT_TRUE(is_apart);
}

TEST(Polygons, VisibilityGoesAroundWallsAndSaysWhereThereIsNoWay) {
  const Folder folder;
  const std::string scene = folder.write("a.scene", two_squares);
  const Json answer = json_of({"solve", scene});
  EXPECT_NEAR(answer["length"], 4 + 2 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(json_of({"verify", scene, folder.write("b.json", answer.dump())})["verified"], true);
  const std::string closed =
      folder.write("c.scene",
                   "bounds 0 0 9 9\npolygon 3 3 6 3 6 4 3 4\npolygon 3 4 4 4 4 6 3 6\npolygon 4 6 4 5 6 5 6 6\n"
                   "polygon 6 4 6 5 5 5 5 4\nstart 1 1\ngoal 4.5 4.5\n");
  EXPECT_EQ(json_of({"solve", closed}, 1)["status"], "infeasible");
  EXPECT_EQ(json_of({"solve", scene, "--start", "1,1"}, 1)["status"], "start_blocked");
  EXPECT_EQ(json_of({"solve", scene, "--start", "0,0"})["status"], "solved") << "on the outline";
  EXPECT_NEAR(json_of({"solve", folder.write("w.walls", "0 0 0 4\nstart -1 2\ngoal 1 2\n"), "--planner", "visibility",
                       "--start=0,1", "--goal=0,3"})["length"],
              2.0, 1e-12)
      << "along a wall";
}

TEST(Polygons, StartsInsideOfOneThatWasCutForItsHolesAreBlocked) {
  const Folder folder;
  const std::string ring = "[[0,0],[9,0],[9,9],[0,9],[0,0]],[[3,4],[6,4],[6,5],[3,5],[3,4]]";
  const std::string json = folder.write("a.geojson", "{\"type\": \"Polygon\", \"coordinates\": [" + ring + "]}");
  const std::string wkt = folder.write("a.wkt", "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 4, 6 4, 6 5, 3 5, 3 4))");
  for (const std::string& file : {json, wkt}) {
    for (const char* planner : {"visibility", "cells"}) {
      SCOPED_TRACE(file + " " + planner);
      const auto status = [&](const char* start, const char* goal) {
        return json_of({"solve", file, "--planner", planner, "--start", start, "--goal", goal}, 1)["status"];
      };
      // Cuts run from corners of the hole to corners of the outline: of any such line each middle is solid.
      constexpr const char* solid[] = {"1.5,2", "1.5,7", "7.5,7", "7.5,2", "1.5,2.5", "7.5,6.5", "1.5,6.5", "7.5,2.5"};
      for (const std::uint64_t seed : seeds(std::size(solid))) {
        const char* place = solid[seed - 1];
        EXPECT_EQ(status(place, "4,4.5"), "start_blocked") << place;
        EXPECT_EQ(status("4,4.5", place), "goal_blocked") << place;
      }
      EXPECT_EQ(status("0,0", "4,4.5"), "infeasible") << "a corner that is cut from";
      EXPECT_EQ(json_of({"solve", file, "--planner", planner, "--start", "3,4", "--goal", "6,5"})["status"], "solved");
    }
  }
}

TEST(Polygons, CellsAndAdjacenciesAreAsManyAsTheFormulasSay) {
  const Folder folder;
  const std::string scene = folder.path("a.scene");
  ASSERT_EQ(run({"generate", "polygons", "40", "--corners", "11", "-o", scene}).code, 0);
  const Json best = json_of({"solve", scene, "--planner", "cells"});
  EXPECT_EQ(best["roadmap"]["cells"], 440 + 40 + 1);
  EXPECT_EQ(best["roadmap"]["adjacencies"], 440 + 2 * 40);
  EXPECT_FALSE(best.contains("optimal"));
  EXPECT_GE(json_of({"solve", scene, "--planner", "cells", "--search", "dfs"})["length"], best["length"]);
  const Json shortest = json_of({"solve", scene});
  const Json funnel = json_of({"solve", scene, "--planner", "cells", "--doors", "funnel"});
  EXPECT_NEAR(funnel["length"].get<double>() / shortest["length"].get<double>(), 1.0, 1e-12);
  EXPECT_LE(funnel["length"].get<double>(), best["length"].get<double>() * (1 + 1e-12));
  EXPECT_EQ(run({"solve", scene, "--planner", "cells", "--svg", folder.path("a.svg")}).code, 0);
  EXPECT_NE(folder.read("a.svg").find("<g id=\"cells\""), std::string::npos);
}

TEST(Polygons, WithoutBoundsPathsRunAlongTheObstaclesBoxButNotBehindAMazesOutline) {
  const Folder folder;
  struct Case {
    const char* text;
    double length;  // 0: there is no path
  };
  const Case cases[] = {
      {"polygon 0 5 5 0 10 5 5 8\nstart 1 1\ngoal 9 1\n", 2 * std::sqrt(17.0)},        // round a corner on the box
      {"polygon 0 0 1 0 1 2 0 2\npolygon 3 0 4 0 4 2 3 2\nstart 0 1\ngoal 4 1\n", 6},  // along sides on it
      {"wall 0 3 10 3\nwall 5 3 5 8\nstart 1 4\ngoal 9 4\n", 2 * std::sqrt(32.0)},     // round a wall's end on it
      {"wall 0 0 10 0\nwall 5 0 5 8\nstart 5 0\ngoal 9 1\n", std::sqrt(17.0)},
      {"0 0 4 0\n4 0 4 4\n4 4 0 4\n0 4 0 3\n0 2 0 0\n2 0 2 4\nstart 0 2.5\ngoal 3 3\n", 0},  // a maze's outline
  };
  for (const Case& c : cases) {
    const std::string scene = folder.write("a.scene", c.text);
    for (const std::vector<std::string>& planner :
         {std::vector<std::string>{"visibility"}, std::vector<std::string>{"visibility", "--full"},
          std::vector<std::string>{"visibility", "--lazy"}, std::vector<std::string>{"cells", "--doors", "funnel"}}) {
      std::vector<std::string> arguments{"solve", scene, "--planner"};
      arguments.insert(arguments.end(), planner.begin(), planner.end());
      const Json answer = json_of(arguments, c.length > 0 ? 0 : 1);
      EXPECT_EQ(answer["status"], c.length > 0 ? "solved" : "infeasible") << c.text << planner.back();
      if (c.length > 0) {
        EXPECT_NEAR(answer["length"], c.length, 1e-12) << c.text << planner.back();
      }
    }
    if (c.length == 0) continue;
    EXPECT_EQ(json_of({"solve", scene, "--planner", "cells"})["verified"], true) << c.text;
    EXPECT_EQ(json_of({"solve", scene, "--planner", "visibility", "--start=-1,1"}, 1)["status"], "start_blocked");
    EXPECT_EQ(json_of({"solve", scene, "--planner", "cells", "--goal=-1,1"}, 1)["status"], "goal_blocked");
  }
}

TEST(Polygons, TheMedialAxisKeepsAsMuchRoomAsThereIs) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene",
                                         "bounds 0 0 800 300\nwall 200 0 200 200\nwall 100 200 300 200\n"
                                         "wall 400 100 400 300\nwall 600 0 600 200\nwall 500 200 700 200\n"
                                         "start 50 50\ngoal 750 50\n");
  const Json answer = json_of({"solve", scene, "--planner", "voronoi", "--svg", folder.path("a.svg")});
  EXPECT_NEAR(answer["length"], 1570.7, 15.7);
  EXPECT_NEAR(answer["min_clearance"], 50.0, 1e-9);
  EXPECT_EQ(answer["contact"], "blocked");
  EXPECT_NE(folder.read("a.svg").find("<g id=\"medial_axis\""), std::string::npos);
  EXPECT_EQ(json_of({"solve", scene, "--planner", "voronoi", "--clearance", "49.99"})["status"], "solved");
  EXPECT_NE(json_of({"solve", scene, "--planner", "voronoi", "--clearance", "50.01"}, 1)["status"], "solved");
  EXPECT_NEAR(json_of({"solve", scene, "--planner", "visibility"})["length"], 999.0705, 1e-4);
}

TEST(Polygons, ThatOverlapAreTakenByAllButCellsAndVoronoi) {
  const Folder folder;
  const std::string scene = folder.write(
      "a.scene", "bounds -5 -5 10 10\npolygon 0 0 2 0 2 2 0 2\npolygon 1 1 3 1 3 3 1 3\nstart -1 3\ngoal 4 1\n");
  for (const char* planner : {"prm", "lazy-prm", "visibility"}) {
    EXPECT_EQ(json_of({"solve", scene, "--planner", planner})["status"], "solved") << planner;
  }
  for (const char* planner : {"cells", "voronoi"}) {
    check({{"solve", scene, "--planner", planner}, 65, "the polygon of line 3"});
  }
}

TEST(Polygons, PlannersRefuseWhatTheyWouldIgnore) {
  const Folder folder;
  const std::string scene = folder.write("a.scene", two_squares);
  check({{"solve", scene, "--samples", "50"}, 2, "visibility would ignore it"});
  check({{"solve", scene, "--planner", "prm", "--full"}, 2, "--full: prm would ignore it"});
  check({{"solve", scene, "--planner", "cells", "--clearance", "0.1"}, 2, "plans for a point"});
  check({{"solve", scene, "--planner", "cells", "--robot", "disc 1"}, 2, "plans for a point"});
  for (const char* option : {"--full", "--lazy", "--sampled-edges=1", "--search=dijkstra", "--queue=heap"}) {
    check({{"solve", scene, "--planner", "visibility", "--clearance", "0.1", option}, 2, "would ignore it for a disc"});
  }
  check({{"solve", scene, "--planner", "visibility", "--contact", "blocked"}, 2, "--contact"});
  check({{"solve", scene, "--planner", "prm", "--contact", "allowed"}, 2, "--contact"});
  check({{"solve", scene, "--lazy", "--full"}, 2, "--lazy"});
  check({{"solve", scene, "--lazy", "--search", "dijkstra"}, 2, "--lazy"});
  check({{"solve", scene, "--lazy=path"}, 2, "--lazy"});
  check({{"solve", scene, "--planner", "cells", "--doors", "funnel", "--queue", "lazy-heap"}, 2, "--queue"});
  check({{"solve", scene, "--sampled-edges", "0"}, 2, "--sampled-edges"});
  check({{"solve", scene, "--search", "bfs", "--queue", "heap"}, 2, "no priority queue"});
  check({{"solve", "maze:5x5", "--planner", "lazy-prm", "--lazy"}, 2, "WHEN is missing"});
  EXPECT_EQ(json_of({"solve", scene, "--clearance", "0.1"})["planner"], "visibility") << "who keeps away, too";
  EXPECT_EQ(json_of({"solve", scene, "--clearance", "0.1", "--samples", "500"})["planner"], "lazy-prm")
      << "what is asked for decides";
}

TEST(Polygons, BodiesAndWorldsWithoutAPlannerAreSaidToHaveNone) {
  const Folder folder;
  const std::string spheres = folder.write("s.scene", "sphere 0 0 0 1\nstart 1 1\ngoal 2 2\n");
  check({{"solve", spheres}, 2, "spheres and boxes take an arm"});
  check({{"solve", "maze:5x5", "--planner", "nonsense"}, 2, "is none of"});
}

}  // namespace
}  // namespace warren::test
