// SPDX-License-Identifier: BSD-3-Clause
// What the program promises for grids of positions and headings: the figures of the course's scene, ends off the grid,
// turning bodies on maps, and report 004's comparison.

#include "tests/tools/grid_worlds.hpp"

namespace warren::test {
namespace {

TEST(Lattice, TheCourseSceneHasItsFigures) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::vector<std::string> common{"solve",    scene, "--planner",     "grid",       "--cell", "2",
                                        "--angles", "72",  "--face-motion", "--diagonal", "unit"};
  const Json exact = answered(common);
  EXPECT_EQ(exact["cost"], 684.0);
  EXPECT_EQ(exact["moves"], 558);
  EXPECT_EQ(exact["free_states"], 2'049'072);
  EXPECT_EQ(exact["free_at_headings"][0], 34'375);
  EXPECT_EQ(exact["free_at_headings"][9], 26'005);  // 45 degrees
  EXPECT_EQ(exact["distinct_layers"], 18);
  EXPECT_EQ(exact["verified"], true);
  EXPECT_EQ(exact["path"][0].size(), 3U);
  EXPECT_EQ(answered({"verify", scene, folder.write("exact.json", exact.dump())})["verified"], true);
  std::vector<std::string> sqrt2 = common;
  sqrt2.back() = "sqrt2";
  EXPECT_NEAR(answered(sqrt2)["cost"].get<double>(), 733.706, 1e-3);
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

TEST(Lattice, StepsAndTurnsCostWhatIsSaid) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const auto solved = [&](const char* step, const char* turn) {
    return answered(
        {"solve", scene, "--planner", "grid", "--diagonal", "unit", "--step-cost", step, "--turn-cost", turn});
  };
  const Json usual = solved("1", "1");
  const Json both = solved("2.5", "2.5");
  EXPECT_EQ(both["cost"], 2.5 * usual["cost"].get<double>());
  EXPECT_EQ(both["options"]["step_cost"], 2.5);
  EXPECT_EQ(usual["turn_steps"], 9);
  const Json dear = solved("1", "40");
  EXPECT_EQ(dear["cost"], dear["moves"].get<double>() + 40.0 * dear["turn_steps"].get<double>());
  EXPECT_EQ(dear["turn_steps"], 0);
  EXPECT_GT(dear["moves"], usual["moves"]);
  for (const char* bad : {"0", "-1", "nan", "inf", "x"}) {
    EXPECT_EQ(run({"solve", scene, "--planner", "grid", "--turn-cost", bad}).code, 2) << bad;
    EXPECT_EQ(run({"solve", scene, "--planner", "grid", "--step-cost", bad}).code, 2) << bad;
  }
}

TEST(Lattice, ACellWiderThanTheWorldIsAWrongOption) {
  const Folder folder;
  const std::string room = folder.write("room.scene", "bounds 0 0 10 4\nstart 1 1\ngoal 9 3\n");
  EXPECT_EQ(run({"solve", room, "--planner", "grid", "--cell", "4"}).code, 1) << "a cell each way, but no path";
  const Outcome outcome = run({"solve", room, "--planner", "grid", "--cell", "4.1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--cell: 4.1 is too large: the world has 10 x 4"), std::string::npos) << outcome.err;
  const std::string own = folder.write("own.scene", "bounds 0 0 10 4\ngrid 5 72\nstart 1 1\ngoal 9 3\n");
  EXPECT_EQ(run({"solve", own, "--planner", "grid"}).code, 65) << "the file's cell";
}

TEST(Lattice, ABodyThatDoesNotTurnTakesNoOptionsOfTurns) {
  const Folder folder;
  const std::string scene = folder.write("walls.scene", course_scene);
  const std::vector<std::vector<std::string>> options = {{"--angles", "36"}, {"--face-motion"}, {"--turn-cost", "3"}};
  for (const char* robot : {"point", "disc 1"}) {
    for (const std::vector<std::string>& option : options) {
      std::vector<std::string> command{"solve", scene, "--planner", "grid", "--robot", robot};
      command.insert(command.end(), option.begin(), option.end());
      const auto refused = run(command);
      EXPECT_EQ(refused.code, 2) << robot;
      EXPECT_NE(refused.err.find(option[0] + ": a point and a disc do not turn"), std::string::npos) << refused.err;
    }
  }
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
  EXPECT_EQ(grid["solved"], 1);  // once: no seed changes it
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
  const std::string paths = folder.read("pictures/paths.svg");
  for (const char* label : {"grid, cell 2.0", "voronoi, ", "prm, ", "rrt, "}) {
    EXPECT_NE(paths.find(std::string("data-label=\"") + label), std::string::npos) << label;
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
    std::vector<std::string> words{"solve",   c.world, "--planner", "grid",  "--cell", "1.9",
                                   "--robot", c.robot, "--start",   c.start, "--goal", c.goal};
    if (std::string_view(c.robot).starts_with("polygon")) words.insert(words.end(), {"--angles", "36"});
    const Json answer = answered(words);
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

}  // namespace
}  // namespace warren::test
