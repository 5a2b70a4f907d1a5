// SPDX-License-Identifier: BSD-3-Clause
// What the program promises for maps and grids: readers by content, grid paths verified against closed cells, the
// figures of the course's scene, scenario files, conversions there and back.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::testing {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* small_map =
    "type octile\nheight 5\nwidth 7\nmap\n"
    ".......\n"
    ".@@@@@.\n"
    ".......\n"
    "@@@@@.@\n"
    ".......\n";
constexpr const char* sealed_map = "type octile\nheight 3\nwidth 5\nmap\n..@..\n.@@..\n..@..\n";
constexpr const char* course_scene =
    "bounds 0 0 800 300\nrobot polygon -25 -25 25 -25 25 25 -25 25\n"
    "wall 200 0 200 200\nwall 100 200 300 200\nwall 400 100 400 300\nwall 600 0 600 200\nwall 500 200 700 200\n"
    "start 50 50 0\ngoal 750 50\n";

Json answered(std::vector<std::string> arguments, int code = 0) {
  SCOPED_TRACE(shown(arguments));
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err << outcome.out;
  return Json::parse(outcome.out, nullptr, false);
}

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
    if (std::string_view(planner.name).starts_with("rrt")) words.insert(words.end(), {"--nodes", "500"});
    EXPECT_EQ(answered(words, 1)["status"], "not_connected");
    words.insert(words.end(), {"--robot", "disc 0.6"});
    EXPECT_EQ(answered(words, 1)["status"], "start_blocked");
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
  for (const char* name : {"b.map", "b.pgm", "b.yaml"}) {
    EXPECT_EQ(run({"convert", map, "-o", folder.path(name), "--quiet"}).code, 0) << name;
    EXPECT_EQ(answered({"info", folder.path(name)})["free"], 24) << name;
  }
  const std::string scene = folder.write("w.scene", "bounds 0 0 6 4\nwall 2.5 1 2.5 2.5\n");
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("w.map")}).code, 2);  // no --cell
  EXPECT_EQ(run({"convert", scene, "-o", folder.path("w.map"), "--cell", "1", "--quiet"}).code, 0);
  EXPECT_EQ(answered({"info", folder.path("w.map")})["occupied"], 3);
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

TEST(Lattice, TheCourseSceneHasItsFigures) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::vector<std::string> common{"solve",    scene, "--planner",     "grid",       "--cell", "2",
                                        "--angles", "72",  "--face-motion", "--diagonal", "unit"};
  const Json exact = answered(common);
  EXPECT_EQ(exact["cost"], 684.0);
  EXPECT_EQ(exact["moves"], 558);
  EXPECT_EQ(exact["free_states"], 2'049'072);
  EXPECT_EQ(exact["verified"], true);
  EXPECT_EQ(exact["path"][0].size(), 3U);
  EXPECT_EQ(answered({"verify", scene, folder.write("exact.json", exact.dump())})["verified"], true);
  std::vector<std::string> report = common;
  report.insert(report.end(), {"--layers", "report004"});
  const Outcome outcome = run([&] {
    std::vector<std::string> words = report;
    words.insert(words.end(), {"--json", "-"});
    return words;
  }());
  const Json answer = Json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(answer["cost"], 735.0);
  EXPECT_EQ(answer["moves"], 609);
  EXPECT_EQ(answer["cells"], 610);
  EXPECT_EQ(answer["turn_steps"], 126);
  EXPECT_EQ(outcome.code, answer["verified"].get<bool>() ? 0 : 1);
}

TEST(Lattice, AFourHundredthOfTheLongerSideIsTheCellThatNobodyNamed) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const Json answer = answered({"solve", scene, "--planner", "grid"});
  EXPECT_EQ(answer["options"]["cell"], 2.0);
  EXPECT_EQ(answer["options"]["angles"], 72);
  EXPECT_EQ(answer["verified"], true);
}

/// Report 004's comparison in one command, of fewer seeds.
TEST(Lattice, TheCoursesPlannersAreComparedAndDrawn) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::string pictures = folder.path("pictures");
  const Json compared = answered({"compare", scene, "--planners", "grid,voronoi,prm,rrt", "--samples", "50,500",
                                  "--seeds", "3", "--pictures", pictures});
  ASSERT_EQ(compared["rows"].size(), 5U);
  const Json& grid = compared["rows"][0];
  EXPECT_EQ(grid["solved"], 3);
  EXPECT_EQ(grid["cells"]["median"], 559.0);
  EXPECT_GT(grid["expanded"], 1000);
  const Json& voronoi = compared["rows"][1];
  EXPECT_NEAR(voronoi["length"]["median"].get<double>(), 2 * 785.356, 0.1);  // the oracle's units are cells
  EXPECT_NEAR(voronoi["cells"]["median"].get<double>(), 722.0, 0.02 * 722.0);
  EXPECT_EQ(voronoi["turn_rad"]["median"], 0.0);
  const Json& prm = compared["rows"][3];
  EXPECT_EQ(prm["options"]["samples"], 500);
  EXPECT_EQ(prm["solved"], 3);
  EXPECT_GT(prm["turn_rad"]["median"], 1.0);
  EXPECT_GT(compared["rows"][4]["expanded"], 100);  // the tree's nodes
  for (const char* name : {"pictures/grid_layer_0.svg", "pictures/grid_layer_45.svg", "pictures/grid_layer_90.svg"}) {
    EXPECT_NE(folder.read(name).find("<g id=\"layer_"), std::string::npos) << name;
  }
  for (const char* name :
       {"pictures/grid_cell_2_0_angles_72_diagonal_sqrt2.svg", "pictures/voronoi_objective_length.svg",
        "pictures/prm_sampler_uniform_samples_500.svg", "pictures/rrt_sampler_uniform-gaussian.svg"}) {
    const std::string svg = folder.read(name);
    EXPECT_NE(svg.find("<g id=\"sweep\""), std::string::npos) << name;
    EXPECT_NE(svg.find("<g id=\"path\""), std::string::npos) << name;
  }
  EXPECT_EQ(run({"compare", scene, "--planners", "rrt", "--pictures", folder.path("gone/pictures")}).code, 73);
  EXPECT_EQ(run({"compare", scene, "--graph", "prm", "--pictures", pictures}).code, 2);
}

TEST(Lattice, RoadmapsAndTreesSolveTheCourseSceneAsOftenAsTheyShould) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", std::string(course_scene) + "grid 2 72\n");
  const Json compared = answered(
      {"compare", scene, "--planners", "prm,rrt-connect", "--samples", "500", "--neighbours", "10", "--seeds", "60"});
  EXPECT_GE(compared["rows"][0]["solved"], 57);  // 95 % of 60
  EXPECT_LE(compared["rows"][0]["cells"]["median"], 660.0);
  EXPECT_EQ(compared["rows"][1]["solved"], 60);
}

TEST(Maps, PlannersAreComparedOnThemPolygonsToo) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  for (const char* robot : {"disc 0.3", "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2"}) {
    SCOPED_TRACE(robot);
    const bool turns = robot[0] == 'p';
    std::vector<std::string> words{"compare", map, "--robot", robot, "--seeds", "2", "--goal", "6.5,4.5", "--start"};
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

TEST(Lattice, EndsOffTheGridAreJoinedToIt) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::string polygons =
      folder.write("p.scene", "bounds 0 0 40 30\npolygon 10 0.5 20 0.5 20 20 10 20\nwall 30 29.5 30 12\n");
  struct Case {
    std::string world;
    const char* robot;
    const char* start;
    const char* goal;
    double straight;  // how far apart the ends are
  };
  const char* square = "polygon -25 -25 25 -25 25 25 -25 25";
  for (const Case& c :
       {Case{scene, square, "51.3,49.1,0.3", "750.7,50.3", 699.4},
        Case{scene, square, "51.3,49.1,0.3", "750.7,50.3,1.1", 699.4},
        Case{scene, square, "50,50,0", "750,50.5,0", 700.0}, Case{scene, "disc 20", "51.3,49.1", "750.7,50.3", 699.4},
        Case{scene, "point", "51.3,49.1", "750.7,50.3", 699.4},
        Case{polygons, "disc 1.5", "3.03,4.04", "36.1,3.3", 33.0},
        Case{polygons, "polygon -2 -1 2 -1 2 1 -2 1", "3.03,4.04,0.1", "36.1,3.3,2", 33.0}}) {
    SCOPED_TRACE(std::string(c.robot) + " from " + c.start);
    const Json answer = answered({"solve", c.world, "--planner", "grid", "--cell", "1.9", "--angles", "36", "--robot",
                                  c.robot, "--start", c.start, "--goal", c.goal});
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["verified"], true);
    EXPECT_GT(answer["length"].get<double>(), c.straight);
    EXPECT_EQ(answer["path"].front(), answer["start"]);
    EXPECT_EQ(answer["path"].back()[0], answer["goal"][0]);
    EXPECT_EQ(answer["path"].back()[1], answer["goal"][1]);
    EXPECT_EQ(answered({"verify", c.world, folder.write("answer.json", answer.dump())})["verified"], true);
  }
  const std::vector<std::string> blocked{"solve", scene, "--planner", "grid", "--cell", "2", "--goal", "750,50"};
  for (const char* start : {"24.9,50,0", "190,50,0", "199.9,100.1,0.2"}) {
    std::vector<std::string> words = blocked;
    words.insert(words.end(), {"--start", start});
    EXPECT_EQ(answered(words, 1)["status"], "start_blocked") << start;
  }
}

TEST(Lattice, ReportsLayersJoinNothingAndCellsThatAreNoneAreUsageErrors) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::vector<std::string> report{"solve", scene,      "--planner", "grid",   "--cell",
                                        "2",     "--layers", "report004", "--start"};
  for (const char* start : {"51,50,0", "50,50,0.01"}) {
    std::vector<std::string> words = report;
    words.push_back(start);
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("no state of the grid"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run({"solve", scene, "--planner", "grid", "--cell", "0"}).code, 2);
}

TEST(Lattice, PolygonsTurnOnTheGridOfAMap) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  const std::string body = "polygon -0.2 -0.2 0.3 -0.2 0.2 0.2";
  const std::vector<std::string> common{"solve", map, "--planner", "grid", "--robot", body};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = common;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  for (const char* goal : {"6.5,4.5", "6.4,4.55,2.5"}) {
    const Json answer = answered(with({"--start", "0.45,0.55,0.1", "--goal", goal, "--face-motion"}));
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["verified"], true);
    EXPECT_EQ(answer["states"], 7 * 5 * 72);
    EXPECT_GT(answer["length"].get<double>(), 7.0);
    EXPECT_EQ(answered({"verify", map, folder.write("answer.json", answer.dump())})["verified"], true);
    EXPECT_EQ(answered(with({"--start", "0.45,0.55,0.1", "--goal", goal, "--face-motion", "--threads", "3"}))["path"],
              answer["path"]);
  }
  EXPECT_EQ(answered(with({"--start", "3.5,1.5,0", "--goal", "6.5,4.5"}), 1)["status"], "start_blocked");
  EXPECT_EQ(answered(with({"--start", "0.5,0.5,0", "--goal", "3.5,1.5"}), 1)["status"], "goal_blocked");
  EXPECT_EQ(run(with({"--start", "0.5,0.5,0", "--goal", "6.5,4.5", "--cell", "0.5"})).code, 2);
  EXPECT_EQ(run(with({"--start", "0.5,0.5,0", "--goal", "6.5,4.5", "--layers", "exact"})).code, 2);
  const std::string sealed = folder.write("s.map", sealed_map);
  EXPECT_EQ(
      answered({"solve", sealed, "--planner", "grid", "--robot", body, "--start", "0.5,0.5,0", "--goal", "4.5,0.5"},
               1)["status"],
      "not_connected");
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
  const Json apart = answered({"bench-scen", folder.write("e.scen", "version 1\n0\ts.map\t5\t3\t0\t0\t4\t0\t4.0\n"),
                               "--map", folder.write("s.map", sealed_map)},
                              1);
  EXPECT_EQ(apart["differing"], 1);  // there is no path, whatever the file says
  EXPECT_EQ(run({"bench-scen", folder.write("c.scen", "version 1\n0\tgone.map\t7\t5\t0\t4\t6\t0\t10\n")}).code, 66);
  EXPECT_EQ(run({"bench-scen", folder.write("d.scen", "version 1\n0\ta.map\t7\t5\t0\t4\t7\t0\t10\n")}).code, 65);
}

}  // namespace
}  // namespace warren::testing
