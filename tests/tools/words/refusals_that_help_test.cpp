// SPDX-License-Identifier: BSD-3-Clause
// What is said where something does not fit: what, where, how much, and what would do.
#include <fmt/format.h>

#include "tests/tools/grid_worlds.hpp"
#include "tests/tools/process.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::test {
namespace {

using Words = std::vector<std::string>;

std::string said(const Words& words, int code = 1) {
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.code, code) << shown(words) << outcome.err;
  return outcome.out + outcome.err;
}

void expect_said(const std::string& text, const Words& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

TEST(RefusalsThatHelp, TooNarrowIsToldWithTheRoomAndThePlaceInFewDigits) {
  const Folder folder;
  const std::string world = folder.write("w.scene", "bounds 0 0 10 4\nwall 5 0 5 2\nstart 1 1\ngoal 9 3\n");
  expect_said(said({"solve", world, "--robot", "disc 0.3", "--goal", "5.1,1"}),
              {"goal blocked", "in the way is wall 0", "0.1 there, 0.3 needed", "free place    (5.31, 1), 0.21 away"});
  const Json blocked = answered({"solve", world, "--robot", "disc 0.3", "--goal", "5.1,1"}, 1)["blocked"];
  EXPECT_NEAR(blocked["room"].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(blocked["needed"], 0.3);
  expect_said(said({"solve", world, "--start", "12,1"}),
              {"outside of the bounds 0 0 10 4", "free place    (9.999, 1), 2.001 away"});
}

TEST(RefusalsThatHelp, ArmsAreToldTheirLimitsInDegreesAndTheirReach) {
  const std::string world = world_file("puma.scene");
  expect_said(said({"solve", world, "--start", "0,0,0,0,0,400"}),
              {"joint 6 at 400", "-266 to 266 degrees", "400 degrees are 400deg"});
  const std::string far = said({"solve", world, "--goal", "9,9,9"});
  expect_said(far, {"outside of what the tool reaches", "it is 15.5885 from the base"});
  EXPECT_EQ(far.find("a heading of"), std::string::npos) << far;
}

TEST(RefusalsThatHelp, HowDeepIsToldBesideTheFreePlace) {
  const Folder folder;
  const std::string world = folder.write("w.scene", "bounds 0 0 10 4\npolygon 4 1 7 1 7 3 4 3\nstart 1 1\ngoal 9 3\n");
  expect_said(said({"solve", world, "--start", "4.5,2"}), {"in the way is polygon 0", "depth         0.5 in it"});
  const Json blocked = answered({"solve", world, "--start", "4.5,2"}, 1)["blocked"];
  EXPECT_NEAR(blocked["depth"].get<double>(), 0.5, 1e-3);
  expect_said(said({"solve", world_file("puma.scene"), "--goal", "-0.25,-0.4,0.05"}),
              {"in the way is sphere 2", "depth         0.15 in it", "free place    ("});
}

TEST(RefusalsThatHelp, TheEndingSaysThePicturesKind) {
  for (const std::string kind : {"png", "pdf", "html"})
    check({{"solve", "maze:5x5", "--" + kind, "x." + kind}, 2, "a picture's ending says its kind: --picture FILE.png"});
}

TEST(RefusalsThatHelp, FootprintsOfNav2AreBodies) {
  const Folder folder;
  const std::string world = folder.write("w.scene", "bounds 0 0 10 4\nwall 5 0 5 2\n");
  const Words ends{"--start", "1,1,0", "--goal", "9,3,90deg"};
  const Json by_list = answered(joined({"solve", world, "--robot", "[[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2]]"}, ends));
  const Json by_words = answered(joined({"solve", world, "--robot", "polygon 0.3 0.2 -0.3 0.2 -0.3 -0.2"}, ends));
  EXPECT_EQ(by_list["robot"], by_words["robot"]);
  EXPECT_EQ(by_list["path"], by_words["path"]);
  check({joined({"solve", world, "--robot", "[[0.3, 0.2], [-0.3"}, ends), 2, "--robot"});
}

TEST(RefusalsThatHelp, RobotsAreRefusedWithTheFormsThatOptionsTake) {
  const Words ask{"solve", world_file("flat.yaml"), "--start", "0.5,0.5", "--goal", "4.3,0.5", "--robot"};
  for (const char* robot : {"circle 0.3", "0.3", "disc", "[[0.4,0.3],[0.4,-0.3]]"}) {
    expect_said(said(joined(ask, {robot}), 2),
                {"expected `point, disc R, [[X, Y], [X, Y], [X, Y], ...]", "car polygon X Y X Y X Y ... turning RHO"});
  }
  expect_said(said(joined(ask, {"[[0.4, 0.3], [0.4, -0.3], [0, 0]"}), 2), {"here brackets are missing"});
  expect_said(said(joined(ask, {"car radius 1"}), 2), {"expected `car radius R|polygon"});
}

TEST(RefusalsThatHelp, UnknownCellsAreToldFromOccupiedOnesAndWhereTheyAre) {
  const Folder folder;
  folder.write("m.pgm", std::string("P5\n3 2\n255\n") + "\xfe\xfe\xcd\xfe\xfe\x01");
  const std::string map = folder.write(
      "m.yaml",
      "image: m.pgm\nresolution: 2\norigin: [10, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  expect_said(said({"solve", map, "--start", "11,1", "--goal", "15,3"}),
              {"in the way is cell 2, 1\n", "hint          the cell is unknown, at 15, 3 m"});
  expect_said(said({"solve", map, "--start", "11,1", "--goal", "15,1"}),
              {"in the way is cell 2, 0\n", "hint          the cell is at 15, 1 m"});
  for (const char* edge : {"10.2,1", "11,0.2", "11,3.8"}) {  // all that lies around the map is blocked
    expect_said(said({"solve", map, "--robot", "disc 0.5", "--start", "11,1", "--goal", edge}),
                {"in the way is cell ", "hint          the cell is outside of the map\n"});
  }
}

TEST(RefusalsThatHelp, AMazeThatDoesNotFitIsToldWhatTakesLess) {
  const Words ask{"solve", "maze:20000x20000", "--memory", "100MiB"};
  for (const Words& more : {Words{}, Words{"--explain"}}) {
    expect_said(said(joined(ask, more), 124),
                {"it needs more memory than it may hold, ", " at least\n", "try           mazes of algorithm=mst",
                 "--pipeline streamed --no-path"});
  }
  EXPECT_NE(run(joined(ask, {"--quiet"})).err.find("may hold, "), std::string::npos);
}

TEST(RefusalsThatHelp, WhatWasNotDoneIsNotCounted) {
  const std::string text = said({"solve", world_file("town.geojson"), "--start", "1.5,1.5", "--goal", "9.5,8.5"}, 0);
  EXPECT_EQ(text.find("0 edges checked"), std::string::npos) << text;
  EXPECT_EQ(text.find("0 rounds"), std::string::npos) << text;
  expect_said(text, {"work          6 places expanded by the search\n"});
  const std::string trees = said({"solve", world_file("walls.scene"), "--planner", "rrt-connect"}, 0);
  EXPECT_EQ(trees.find(" expanded"), std::string::npos) << trees;
}

TEST(RefusalsThatHelp, GreyThatBecomesFreeIsToldOnce) {
  const Folder folder;
  folder.write("m.pgm", std::string("P5\n3 2\n255\n") + "\xfe\xfe\xcd\xcd\xfe\x01");
  const std::string yaml = "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n";
  const std::string loose = folder.write("loose.yaml", yaml + "free_thresh: 0.25\n");
  const std::string strict = folder.write("strict.yaml", yaml + "free_thresh: 0.196\n");
  expect_said(run({"info", loose}).err, {"2 pixels of grey 205", "free_thresh"});
  EXPECT_EQ(run({"info", loose, "--quiet"}).err, "");
  EXPECT_EQ(run({"info", strict}).err, "");
}

TEST(RefusalsThatHelp, MapsWithoutAFreeCellAreTold) {
  const Folder folder;
  expect_said(said({"convert", "maze:5x5", "--cell", "0.5", "-o", folder.path("m.png")}, 0),
              {"no cell of the map is free"});
}

TEST(RefusalsThatHelp, SummariesHaveUnits) {
  const Folder folder;
  const std::string map = folder.write("a.map", small_map);
  const std::string text = said({"solve", map, "--start", "0.5,0.5", "--goal", "0.5,4.5"}, 0);
  expect_said(text, {"world         map\n", "in steps from cell to cell"});
  expect_said(said({"solve", world_file("walls.scene"), "--seed", "1"}, 0), {" degrees\n"});
}

TEST(RefusalsThatHelp, MiddlesOfDoorsAreNotTheShortestWay) {
  const Folder folder;
  const std::string world = folder.write("w.scene", "bounds 0 0 10 4\npolygon 4 0 6 0 6 2 4 2\nstart 1 1\ngoal 9 1\n");
  expect_said(said({"solve", world, "--planner", "cells"}, 0), {"--doors funnel"});
  EXPECT_EQ(said({"solve", world, "--planner", "cells", "--doors", "funnel"}, 0).find("--doors funnel"),
            std::string::npos);
}

TEST(RefusalsThatHelp, AQuietRunThatRunsOutOfTimeSaysSo) {
  const Outcome outcome = run({"solve", "maze:2000x2000", "--quiet", "--budget", "1ms"});
  EXPECT_EQ(outcome.code, 124);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("warren: stopped"), std::string::npos);
}

TEST(RefusalsThatHelp, WhatABarLeftOnANarrowerScreenIsErased) {
  EXPECT_EQ(tools::erasing(60, 80), "\r\x1b[K");
  EXPECT_EQ(tools::erasing(80, 80), "\r\x1b[K");
  EXPECT_EQ(tools::erasing(79, 40), "\r\x1b[1A\x1b[J");
  EXPECT_EQ(tools::erasing(79, 20), "\r\x1b[3A\x1b[J");
}

}  // namespace
}  // namespace warren::test
