// SPDX-License-Identifier: BSD-3-Clause
// What the program promises for maps: readers by content, grid paths verified against closed cells, every planner on
// them, scenario files, conversions there and back.
#include <algorithm>
#include <cmath>

#include "tests/tools/grid_worlds.hpp"

namespace warren::test {
namespace {

TEST(Maps, InfoCountsTheCells) {
  const Folder folder;
  const Json info = answered({"info", folder.write("a.map", small_map)});
  EXPECT_EQ(info["kind"], "map");
  EXPECT_EQ(info["width"], 7);
  EXPECT_EQ(info["height"], 5);
  EXPECT_EQ(info["free"], 24);
  EXPECT_EQ(info["occupied"], 11);
}

TEST(Maps, GridPathsAreOptimalAndVerifiedAgainstClosedCells) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  // From the lower left to the upper right: 4 right, round the corner of the gap, and up the right side.
  const Json answer = answered({"solve", map, "--start", "0.5,0.5", "--goal", "6.5,4.5"});
  EXPECT_EQ(answer["planner"], "grid");
  EXPECT_EQ(answer["status"], "solved");
  EXPECT_EQ(answer["verified"], true);
  EXPECT_NEAR(answer["length"].get<double>(), 10.0, 1e-12);
  EXPECT_NEAR(answer["min_clearance"].get<double>(), 0.5, 1e-12);
  for (const char* search : {"astar", "dijkstra", "bfs"}) {
    const Json other = answered({"solve", map, "--start", "0.5,0.5", "--goal", "6.5,4.5", "--search", search});
    EXPECT_NEAR(other["length"].get<double>(), 10.0, 1e-12) << search;
  }
  const std::string file = folder.write("answer.json", answer.dump());
  EXPECT_EQ(answered({"verify", map, file})["verified"], true);
  Json bent = answer;
  bent["path"] = {{0.5, 0.5}, {6.5, 4.5}};
  bent["length"] = nullptr;
  EXPECT_EQ(answered({"verify", map, folder.write("bent.json", bent.dump())}, 1)["verified"], false);
}

TEST(Maps, OptimisedPathsLeaveTheGridAndStayVerified) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* robot : {"point", "disc 0.3"}) {
    const Json answer =
        answered({"solve", map, "--start", "0.5,0.5", "--goal", "6.5,4.5", "--optimise", "--robot", robot});
    EXPECT_EQ(answer["verified"], true);
    EXPECT_NEAR(answer["raw_length"].get<double>(), 10.0, 1e-12);
    EXPECT_LT(answer["length"].get<double>(), 9.9);
    EXPECT_GE(answer["length"].get<double>(), std::sqrt(52.0));
  }
}

TEST(Maps, WhatIsProvedIsInfeasibleAndBlockedEndsAreNamed) {
  const Folder folder;
  const std::string map = folder.write("a.map", sealed_map);
  const auto status = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"solve", map};
    words.insert(words.end(), more.begin(), more.end());
    return answered(words, 1)["status"].get<std::string>();
  };
  EXPECT_EQ(status({"--start", "0.5,0.5", "--goal", "4.5,0.5"}), "infeasible");
  EXPECT_EQ(status({"--start", "0.5,0.5", "--goal", "4.5,0.5", "--robot", "disc 0.3"}), "infeasible");
  EXPECT_EQ(status({"--start", "2.5,0.5", "--goal", "4.5,0.5"}), "start_blocked");
  EXPECT_EQ(status({"--start", "0.5,0.5", "--goal", "2.5,0.5"}), "goal_blocked");
  EXPECT_EQ(status({"--start", "0.5,0.5", "--goal", "9,0.5"}), "goal_blocked");
  EXPECT_EQ(status({"--start", "0.5,0.5", "--goal", "4.5,0.5", "--robot", "disc 0.6"}), "start_blocked");
}

/// What a planner may be asked on a map, and with which bodies.
struct MapPlanner {
  const char* name;
  std::vector<std::string> options;
  bool is_sampled = true;
};
std::vector<MapPlanner> map_planners() {
  return {{"prm", {}},
          {"prm", {"--sampler", "corridor"}},
          {"lazy-prm", {}},
          {"prm", {"--sampler", "uniform"}},
          {"prm", {"--sampler", "halton"}},
          {"lazy-prm", {"--sampler", "corridor", "--optimise"}},
          {"rrt", {}},
          {"rrt-connect", {}},
          {"rrt-connect", {"--sampler", "corridor"}},
          {"voronoi", {}, false},
          {"voronoi", {"--objective", "clearance"}, false}};
}

TEST(Maps, AllPlannersSolveThemForPointsDiscsAndPolygonsVerified) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* robot : {"point", "disc 0.3", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"}) {
    const bool turns = std::string_view(robot).starts_with("polygon");
    for (const MapPlanner& planner : map_planners()) {
      SCOPED_TRACE(std::string(robot) + ", " + planner.name);
      std::vector<std::string> words{"solve",   map,      "--planner", planner.name,
                                     "--robot", robot,    "--start",   turns ? "0.5,0.5,0" : "0.5,0.5",
                                     "--goal",  "6.5,4.5"};
      words.insert(words.end(), planner.options.begin(), planner.options.end());
      const Json answer = answered(words);
      EXPECT_EQ(answer["status"], "solved");
      EXPECT_EQ(answer["verified"], true);
      EXPECT_GT(answer["min_clearance"].get<double>(), 0.0);
      EXPECT_EQ(answered({"verify", map, folder.write("answer.json", answer.dump())})["verified"], true);
      std::vector<std::string> again = words;
      again.insert(again.end(), {"--threads", "3"});
      EXPECT_EQ(answered(again)["path"], answer["path"]);
    }
  }
}

TEST(Maps, DiscsThatDoNotFitAtTheMiddleOfTheirCellAreJoinedToOthers) {
  const Folder folder;
  // The middle of the start's cell is too near to the blocked one; the next is not.
  const std::string corner =
      folder.write("b.map", "type octile\nheight 4\nwidth 6\nmap\n......\n......\n......\n@.....\n");
  const Json joined = answered({"solve", corner, "--robot", "disc 0.8", "--start", "1.85,0.85", "--goal", "4.5,2.5"});
  EXPECT_EQ(joined["status"], "solved");
  EXPECT_EQ(joined["verified"], true);
}

TEST(Maps, RoadmapsOfNarrowMapsTakeTheMiddlesOfCells) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* planner : {"prm", "lazy-prm"}) {
    const Json answer = answered({"solve", map, "--planner", planner, "--start", "0.4,0.5", "--goal", "6.5,4.5"});
    EXPECT_EQ(answer["sampler"], "cell-centres");
    EXPECT_EQ(answer["verified"], true);
    EXPECT_LT(answer["roadmap"]["milestones"], 24 + 2);
    EXPECT_NEAR(answer["length"].get<double>(), 10.1, 1e-9);
    const Json disc = answered(
        {"solve", map, "--planner", planner, "--start", "0.5,0.5", "--goal", "6.5,4.5", "--robot", "disc 0.45"});
    EXPECT_EQ(disc["sampler"], "cell-centres");
    EXPECT_EQ(disc["verified"], true);
  }
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"solve",  map,       "--start",   "0.5,0.5",
                                   "--goal", "6.5,4.5", "--sampler", "cell-centres"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).code;
  };
  EXPECT_EQ(refused({"--planner", "prm", "--samples", "10"}), 2);
  EXPECT_EQ(refused({"--planner", "rrt"}), 2);
  const std::string scene = folder.write("w.scene", "bounds 0 0 6 4\nwall 2.5 1 2.5 2.5\nstart 1 1\ngoal 5 3\n");
  EXPECT_EQ(run({"solve", scene, "--planner", "prm", "--sampler", "cell-centres"}).code, 2);
}

TEST(Maps, OnlyTheGridPlannerProvesThatAMapIsSealed) {
  const Folder folder;
  const std::string map = folder.write("a.map", sealed_map);
  const std::vector<std::string> ends{"--start", "0.5,0.5", "--goal", "4.5,0.5"};
  for (const MapPlanner& planner : map_planners()) {
    SCOPED_TRACE(planner.name);
    std::vector<std::string> words{"solve", map, "--planner", planner.name};
    words.insert(words.end(), ends.begin(), ends.end());
    words.insert(words.end(), planner.options.begin(), planner.options.end());
    EXPECT_EQ(answered(words, 1)["status"], "not_connected");
    std::vector<std::string> turning = words;
    turning[std::find(turning.begin(), turning.end(), "--start") - turning.begin() + 1] = "0.5,0.5,0";
    turning.insert(turning.end(), {"--robot", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"});
    EXPECT_EQ(answered(turning, 1)["status"], "not_connected");
    words.insert(words.end(), {"--robot", "disc 0.6"});
    EXPECT_EQ(answered(words, 1)["status"], "start_blocked");
  }
}

TEST(Maps, WhatGrowsSoonGivesUpWhereItIsProvedThatThereIsNoWay) {
  const Folder folder;
  const std::string map = folder.write("a.map", sealed_map);
  for (const char* robot : {"point", "disc 0.3", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"}) {
    SCOPED_TRACE(robot);
    const char* start = std::string_view(robot).starts_with("polygon") ? "0.5,0.5,0" : "0.5,0.5";
    const auto asked = [&](const char* planner) {
      return answered({"solve", map, "--planner", planner, "--sampler", "uniform", "--robot", robot, "--start", start,
                       "--goal", "4.5,0.5"},
                      1);
    };
    for (const char* planner : {"prm", "lazy-prm"}) EXPECT_LE(asked(planner)["counters"]["rounds"], 1) << planner;
    for (const char* planner : {"rrt", "rrt-connect"}) {
      EXPECT_LE(asked(planner)["roadmap"]["milestones"], 2 * 1000) << planner;
    }
  }
}

TEST(Maps, BodiesAmongBlockedCellsStartBlocked) {
  const Folder folder;
  const std::string map =
      folder.write("b.map", "type octile\nheight 3\nwidth 9\nmap\n.........\n.@@@@@@@.\n.........\n");
  for (const char* robot : {"point", "disc 0.1", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"}) {
    for (const MapPlanner& planner : map_planners()) {
      SCOPED_TRACE(std::string(robot) + ", " + planner.name);
      const Json blocked = answered(
          {"solve", map, "--start", std::string_view(robot)[0] == 'p' && robot[2] == 'l' ? "2.5,1.5,0" : "2.5,1.5",
           "--goal", "6.5,1.5", "--planner", planner.name, "--robot", robot},
          1);
      EXPECT_EQ(blocked["status"], "start_blocked");
    }
  }
}

TEST(Maps, CorridorsAreOfMapsAndWayPointsArePassed) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  const std::string scene = folder.write("w.scene", "bounds 0 0 6 4\nwall 2.5 1 2.5 2.5\nstart 1 1\ngoal 5 3\n");
  const Outcome refused = run({"solve", scene, "--planner", "prm", "--sampler", "corridor"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("corridor is for occupancy maps"), std::string::npos) << refused.err;
  const Json answer = answered({"solve", map, "--planner", "rrt-connect", "--start", "0.5,0.5", "--goal", "6.5,4.5",
                                "--via", "3.5,0.5;0.5,4.5"});
  const std::vector<Json> path = answer["path"];
  EXPECT_NE(std::find(path.begin(), path.end(), Json::parse("[0.5, 4.5]")), path.end());
  EXPECT_EQ(answer["via"], Json::parse("[[3.5, 0.5], [0.5, 4.5]]"));
  EXPECT_EQ(run({"verify", map, folder.write("told.json", answer.dump())}).code, 0);
  Json turned = answer;
  turned["via"] = Json::parse("[[0.5, 4.5], [3.5, 0.5]]");
  const Outcome refuted = run({"verify", map, folder.write("turned.json", turned.dump())});
  EXPECT_EQ(refuted.code, 1);
  EXPECT_NE((refuted.out + refuted.err).find("via: the path passes place 2 by"), std::string::npos) << refuted.out;
  EXPECT_EQ(run({"solve", map, "--planner", "rrt", "--start", "0.5,0.5", "--goal", "6.5,4.5", "--via", "3.5,1.5"}).code,
            2);
}

TEST(Maps, MazeImagesBringTheirEnds) {
  const Folder folder;
  const std::string image =
      folder.write("m.pgm", "P2\n5 5\n1\n0 1 0 0 0\n0 1 1 1 0\n0 0 0 1 0\n0 1 1 1 0\n0 1 0 0 0\n");
  const Json answer = answered({"solve", image});
  EXPECT_EQ(answer["status"], "solved");
  EXPECT_NEAR(answer["length"].get<double>(), 8.0, 1e-12);
  EXPECT_EQ(answer["start"], Json::parse("[1.5, 4.5]"));
  EXPECT_EQ(answer["goal"], Json::parse("[1.5, 0.5]"));
}

TEST(Maps, ConvertGoesFromCellsToWallsAndBack) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  EXPECT_EQ(run({"convert", map, "-o", folder.path("a.scene"), "--quiet"}).code, 0);
  EXPECT_EQ(answered({"info", folder.path("a.scene")})["kind"], "walls");
  for (const char* name : {"b.map", "b.pgm", "b.png", "b.yaml"}) {
    EXPECT_EQ(run({"convert", map, "-o", folder.path(name), "--quiet"}).code, 0) << name;
    EXPECT_EQ(answered({"info", folder.path(name)})["free"], 24) << name;
    EXPECT_EQ(run({"convert", folder.path(name), "-o", folder.path("back.map"), "--quiet"}).code, 0) << name;
    EXPECT_EQ(folder.read("back.map"), small_map) << name;
  }
  const std::string scene = folder.write("w.scene", "bounds 0 0 6 4\nwall 2.5 1 2.5 2.5\n");
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("w.map")}).code, 2);  // no --cell
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("w.map"), "--cell", "1", "--quiet"}).code, 0);
  EXPECT_EQ(answered({"info", folder.path("w.map")})["occupied"], 3);
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("w.png"), "--cell", "1", "--quiet"}).code, 0);
  EXPECT_EQ(answered({"info", folder.path("w.png")})["occupied"], 3);
}

TEST(Maps, WhatAFormatHasNoWordsForIsLeftOutWithANote) {
  const Folder folder;
  const std::string scene =
      folder.write("w.scene", "robot disc 0.1\nclearance 0.1\nstart 1 1\ngoal 5 1\nwall 2.5 1 2.5 2.5\nwall 0 0 6 0\n");
  const std::pair<const char*, const char*> cases[]{{"w.wkt", "has no start, goal, robot, clearance: left out"},
                                                    {"w.npy", "has no start, goal, robot, clearance: left out"},
                                                    {"w.geojson", "has no robot, clearance: left out"}};
  for (const auto& [name, said] : cases) {
    const Outcome outcome = run({"convert", scene, "-o", folder.path(name)});
    EXPECT_EQ(outcome.code, 0) << name;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << name << outcome.err;
  }
  EXPECT_NE(run({"convert", scene, "--cell", "0.5", "-o", folder.path("w.map")}).err.find("has no start, goal"),
            std::string::npos);
  for (const char* name : {"a.scene", "a.svg"}) EXPECT_EQ(run({"convert", scene, "-o", folder.path(name)}).err, "");
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("a.wkt"), "--quiet"}).err, "");
  EXPECT_EQ(run({"convert", "maze:4x4", "-o", folder.path("a.npy")}).err, "") << "read anew, a maze has the same ones";
}

TEST(Maps, WhereAMapLiesIsSaidWhereItsFormatHasNoWordsForIt) {
  const Folder folder;
  folder.write("m.pgm", "P2 3 1 255\n254 205 0\n");
  const std::string yaml = folder.write("m.yaml",
                                        "image: m.pgm\nresolution: 0.5\norigin: [12.5, -3.25, 0.7]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  for (const char* name : {"b.map", "b.pgm", "b.png"}) {
    EXPECT_NE(run({"convert", yaml, "-o", folder.path(name)})
                  .err.find("has no resolution, origin, yaw, unknown cells: left out"),
              std::string::npos)
        << name;
  }
  EXPECT_EQ(run({"convert", yaml, "-o", folder.path("b.yaml")}).err, "");
  EXPECT_NE(run({"convert", yaml, "-o", folder.path("b.scene")}).err.find("has no unknown cells: left out"),
            std::string::npos);
  const std::string scene = folder.write("w.scene", "bounds 1 1 6 4\nwall 2.5 1 2.5 2.5\ngrid 0.5 8\n");
  EXPECT_NE(run({"convert", scene, "--cell", "0.5", "-o", folder.path("w.map")})
                .err.find("has no grid, resolution, origin: left out"),
            std::string::npos);
  EXPECT_NE(run({"convert", scene, "-o", folder.path("w.geojson")}).err.find("has no grid: left out"),
            std::string::npos);
  const std::string moving_ai = folder.write("a.map", "type octile\nheight 1\nwidth 3\nmap\n.W@\n");
  EXPECT_NE(run({"convert", moving_ai, "-o", folder.path("c.yaml")}).err.find("has no water: left out"),
            std::string::npos);
  EXPECT_EQ(run({"convert", moving_ai, "-o", folder.path("c.map")}).err, "");
}

TEST(Maps, UnknownCellsStayClosedInImagesWithoutYaml) {
  const Folder folder;
  folder.write("m.pgm", "P2 3 1 255\n254 205 0\n");
  const std::string yaml = folder.write(
      "m.yaml",
      "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  for (const char* name : {"b.map", "b.pgm", "b.png"}) {
    EXPECT_EQ(run({"convert", yaml, "-o", folder.path(name), "--quiet"}).code, 0) << name;
    EXPECT_EQ(answered({"info", folder.path(name)})["free"], 1) << name;
  }
  EXPECT_EQ(run({"convert", yaml, "-o", folder.path("b.yaml"), "--quiet"}).code, 0);
  EXPECT_EQ(answered({"info", folder.path("b.yaml")})["unknown"], 1);
}

TEST(Maps, BadFilesAreDataErrorsAndMissingImagesReadErrors) {
  const Folder folder;
  EXPECT_EQ(run({"info", folder.write("a.map", "type octile\nheight 2\nwidth 2\nmap\n..\n.?\n")}).code, 65);
  const std::string yaml = "resolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\nnegate: 0\n";
  const Outcome gone = run({"info", folder.write("m.yaml", "image: gone.png\n" + yaml)});
  EXPECT_EQ(gone.code, 66);
  EXPECT_NE(gone.err.find("gone.png"), std::string::npos) << gone.err;
  EXPECT_EQ(run({"info", folder.write("n.yaml", "image: [a]\n" + yaml)}).code, 65);
}

TEST(Maps, PlannersWhosePathsTouchAreRefused) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* planner : {"visibility", "cells"}) {
    const Outcome outcome = run({"solve", map, "--planner", planner, "--start", "0.5,0.5", "--goal", "6.5,4.5"});
    EXPECT_EQ(outcome.code, 2) << planner;
    EXPECT_NE(outcome.err.find("blocked cells are closed"), std::string::npos) << outcome.err;
  }
}

TEST(Maps, PlannersAreComparedOnThemPolygonsToo) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* robot : {"disc 0.3", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"}) {
    SCOPED_TRACE(robot);
    const bool turns = robot[0] == 'p';
    std::vector<std::string> words{"compare", map, "--robot", robot, "--trials", "2", "--goal", "6.5,4.5", "--start"};
    words.insert(words.end(), {turns ? "0.5,0.5,0" : "0.5,0.5", "--planners",
                               turns ? "voronoi,prm,rrt" : "grid,voronoi,prm,rrt", "--pictures", folder.path("out")});
    const Json answer = answered(words);
    for (const Json& row : answer["rows"]) {
      EXPECT_EQ(row["solved"], 2) << row["planner"];
      EXPECT_GE(row["cells"]["median"], 7.0);
      EXPECT_EQ(row.contains("turn_rad"), turns);
    }
    EXPECT_NE(folder.read(turns ? "out/prm_sampler_uniform.svg" : "out/prm_sampler_cell-centres.svg")
                  .find("<g id=\"blocked\""),
              std::string::npos);
  }
}

TEST(BenchScen, ExitsWithZeroOnlyWhereEveryLengthIsTheOptimum) {
  const Folder folder;
  folder.write("a.map", small_map);
  const auto scenario = [&](const char* name, double length) {
    return folder.write(name, "version 1\n0\ta.map\t7\t5\t0\t4\t6\t0\t" + std::to_string(length) +
                                  "\r\n0\tmaps/a.map\t7\t5\t0\t0\t0\t0\t0\r\n");
  };
  EXPECT_EQ(run({"bench-scen", scenario("two.scen", 10.0)}).code, 65);  // two maps in one file
  const std::string right = folder.write("a.scen", "version 1\n0\tmaps/x/a.map\t7\t5\t0\t4\t6\t0\t10.0\n");
  const Json good = answered({"bench-scen", right});
  EXPECT_EQ(good["scenarios"], 1);
  EXPECT_EQ(good["differing"], 0);
  EXPECT_GT(good["median_speedup"], 0.0);
  const Json bad =
      answered({"bench-scen", folder.write("b.scen", "version 1\n0\ta.map\t7\t5\t0\t4\t6\t0\t10.002\n")}, 1);
  EXPECT_EQ(bad["differing"], 1);
  EXPECT_EQ(bad["differences"][0]["line"], 2);
  const auto published = [&](const std::string& length) {
    const std::string line = "version 1\n0\ta.map\t7\t5\t0\t4\t6\t0\t" + length + "\n";
    return run({"bench-scen", folder.write("f.scen", line)}).code;
  };
  for (const char* rounded : {"10", "10.0", "10.00", "10.0004", "1.0e1"}) EXPECT_EQ(published(rounded), 0) << rounded;
  for (const char* wrong : {"10.1", "10.01", "11", "9", "10.41"}) EXPECT_EQ(published(wrong), 1) << wrong;
  const Json apart = answered({"bench-scen", folder.write("e.scen", "version 1\n0\ts.map\t5\t3\t0\t0\t4\t0\t4.0\n"),
                               "--map", folder.write("s.map", sealed_map)},
                              1);
  EXPECT_EQ(apart["differing"], 1);  // there is no path, whatever the file says
  EXPECT_EQ(run({"bench-scen", folder.write("c.scen", "version 1\n0\tgone.map\t7\t5\t0\t4\t6\t0\t10\n")}).code, 66);
  EXPECT_EQ(run({"bench-scen", folder.write("d.scen", "version 1\n0\ta.map\t7\t5\t0\t4\t7\t0\t10\n")}).code, 65);
}

}  // namespace
}  // namespace warren::test
