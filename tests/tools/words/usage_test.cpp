// SPDX-License-Identifier: BSD-3-Clause
// Command lines that nobody should get away with: each ends with its exit code and one line that says what is wrong.
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

TEST(Usage, StandardOutputByAnyNameTakesTheJsonAlone) {
  const std::string json = run({"solve", "maze:5x7", "--json", "/dev/stdout"}).out;
  EXPECT_TRUE(json.starts_with('{') && json.ends_with("}\n")) << json;
}

TEST(Usage, WrongWordsAreRefusedWithTheClosestMatch) {
  const std::vector<Case> cases{
      {{}, 2, "Usage"},
      {{"slove", "maze:5x7"}, 2, "did you mean solve?"},
      {{"--verison"}, 2, "--verison"},
      {{"solve"}, 2, "WORLD is missing"},
      {{"solve", "maze:5x7", "maze:5x7"}, 2, "unexpected argument"},
      {{"solve", "maze", "5x7"}, 2, "unexpected argument '5x7'; a maze is called maze:41x41"},
      {{"generate", "maze", "5", "7", "-o", "x.npy"}, 2, "unexpected argument '7'; its size is one word, 41x41"},
      {{"solve", "5x7"}, 66, "there is no such file; a maze is called maze:41x41"},
      {{"info", "5x7"}, 66, "there is no such file; a maze is called maze:41x41"},
      {{"convert", "5x7", "--robot", "point", "-o", "x.scene"}, 66, "; a maze is called maze:41x41"},
      {{"solve", ""}, 66, "'': can't be read: there is no such file"},
      {{"generate", "maze", "abc", "-o", "x.npy"}, 2, "warren: abc: the size is missing; expected ROWSxCOLS"},
      {{"solve", "maze:5x7", "--robot", "disc", "0.2"}, 2, "'0.2'; a value of several words is quoted"},
      {{"solve", "maze:5x7", "--sampels", "5"}, 2, "did you mean --samples?"},
      {{"solve", "maze:5x7", "--samples=5=6"}, 2, "--samples"},
      {{"solve", "maze:5x7", "--seed", "1", "--seed", "2"}, 2, "--seed: given twice"},
      {{"solve", "maze:5x7", "--seed"}, 2, "--seed: N is missing"},
      {{"solve", "maze:5x7", "--quiet=1"}, 2, "--quiet: takes no value"},
      {{"solve", "maze:5x7", "--planner", "prmm"}, 2, "did you mean prm?"},
      {{"solve", "maze:5x7", "--planner", "cellss"}, 2, "did you mean cells?"},
      {{"solve", "maze:5x7", "--cell", "1"}, 2, "grid takes it"},
      {{"solve", "maze:5x7", "--sampler", "latice"}, 2, "did you mean lattice?"},
      {{"solve", "maze:5x7", "--search", "a*"}, 2, "--search"},
      {{"solve", "maze:5x7", "--queue", "stack"}, 2, "--queue"},
      {{"solve", "maze:5x7", "--contact", "maybe"}, 2, "--contact"},
      {{"solve", "maze:5x7", "--progress", "loud"}, 2, "--progress"},
      {{"solve", "maze:5x7", "--color", "red"}, 2, "--color"},
      {{"generate", "garden", "5x7", "-o", "x.walls"}, 2, "maze"},
      {{"generate", "maze", "5x7"}, 2, "-o FILE is missing"},
      {{"generate", "maze", "5x7", "-o", "x.docx"}, 2, "ends in"},
      {{"generate", "maze", "5x7", "--algorithm", "wilsn", "-o", "x.npy"}, 2, "did you mean wilson?"},
      {{"generate", "maze", "5x7", "--loops", "1.5", "-o", "x.npy"}, 2, "from 0 to 1"},
      {{"render", "maze:5x7", "-o", "x.npy"}, 2, "--output: a picture here ends in one of: .svg .png .pdf .html"},
      {{"render", "maze:5x7", "-o", "x"}, 2, "(found: 'x')"},
      {{"solve", "maze:5x7", "--picture", "out"},
       2,
       "--picture: a picture here ends in one of: .svg .png .pdf .html (found: 'out')"},
      {{"compare", "maze:5x7", "--picture", "out"}, 2, "--picture: a picture here ends in one of: .svg .png"},
      {{"compare", "maze:5x7", "--curves", "out"}, 2, "--curves: a picture here ends in one of: .svg .png"},
      {{"render", "maze:5x7"}, 2, "-o FILE is missing"},
      {{"convert", "maze:5x7", "-o", "picture"}, 2, "ends in"},
      {{"verify", "maze:5x7"}, 2, "ANSWER.json is missing"},
      {{"verify", "a.json", "maze:5x7"}, 2, "the world comes first, then its answer: warren verify maze:5x7 a.json"},
      {{"export", "x.roadmap", "-o", "x.doc"}, 2, "drawn by .svg .png .pdf .html"},
      {{"verify", "-", "-"}, 2, "can't both come from standard input"},
      {{"completion", "tcsh"}, 2, "bash, zsh, fish"},
  };
  for (const Case& c : cases) check(c);
}

TEST(Usage, ValuesOutsideTheirRangeAreRefused) {
  const std::vector<Case> cases{
      {{"solve", "maze:5x7", "--samples", "0"}, 2, "--samples: expected auto, or a whole number from 1"},
      {{"solve", "maze:5x7", "--samples", "-5"}, 2, "--samples"},
      {{"solve", "maze:5x7", "--samples", "1e3"}, 2, "--samples"},
      {{"solve", "maze:5x7", "--samples", "99999999999999999999"}, 2, "--samples"},
      {{"solve", "maze:5x7", "--neighbours", "0"}, 2, "--neighbours"},
      {{"solve", "maze:5x7", "--neighbours", "5000"}, 2, "4096"},
      {{"solve", "maze:5x7", "--radius", "0"}, 2, "--radius: expected a number above 0"},
      {{"solve", "maze:5x7", "--radius", "nan"}, 2, "--radius"},
      {{"solve", "maze:5x7", "--radius", "1e308"}, 2, "--radius"},
      {{"solve", "maze:5x7", "--clearance", "-0.1"}, 2, "--clearance"},
      {{"solve", "maze:5x7", "--clearance", "nan"}, 2, "--clearance"},
      {{"solve", "maze:5x7", "--clearance", "inf"}, 2, "--clearance"},
      {{"solve", "maze:5x7", "--clearance", "0.1m"}, 2, "--clearance"},
      {{"solve", "maze:5x7", "--clearance", "+-0"}, 2, "--clearance: expected a number from 0"},
      {{"solve", "maze:5x7", "--clearance", ""}, 2, "--clearance"},
      {{"solve", "maze:5x7", "--seed", "-1"}, 2, "--seed"},
      {{"solve", "maze:5x7", "--seed", "18446744073709551616"}, 2, "--seed"},
      {{"solve", "maze:5x7", "--threads", "0"}, 2, "--threads: expected a whole number from 1"},
      {{"solve", "maze:5x7", "--threads", "two"}, 2, "--threads"},
      {{"solve", "maze:5x7", "--budget", "0s"}, 2, "--budget: expected a time above 0"},
      {{"solve", "maze:5x7", "--budget", "-1s"}, 2, "--budget"},
      {{"solve", "maze:5x7", "--budget", "20"}, 2, "--budget"},
      {{"solve", "maze:5x7", "--budget", "infs"}, 2, "--budget"},
      {{"solve", "maze:5x7", "--memory", "0B"}, 2, "--memory"},
      {{"solve", "maze:5x7", "--memory", "20"}, 2, "--memory"},
      {{"solve", "maze:5x7", "--memory", "-1GiB"}, 2, "--memory"},
      {{"solve", "maze:5x7", "--start", "1"}, 2, "--start: a point or disc takes X,Y"},
      {{"solve", "maze:5x7", "--start", "1,nan"}, 2, "--start"},
      {{"solve", "maze:5x7", "--start", "1,inf"}, 2, "--start"},
      {{"solve", "maze:5x7", "--start", "+-1,1"}, 2, "--start: expected X,Y"},
      {{"solve", "maze:5x7", "--start", "1e308,1"}, 2, "--start"},
      {{"solve", "maze:5x7", "--start", "1,1,0"}, 2, "a point or disc takes X,Y"},
      {{"solve", "maze:5x7", "--goal", "x,y"}, 2, "--goal"},
      {{"solve", "maze:5x7", "--robot", "disc"}, 2, "--robot"},
      {{"solve", "maze:5x7", "--robot", "disc -1"}, 2, "--robot"},
      {{"solve", "maze:5x7", "--robot", "disc nan"}, 2, "--robot"},
      {{"solve", "maze:5x7", "--robot", "blob 1"}, 2, "--robot"},
      {{"solve", "maze:5x7", "--robot", "car radius 1 turning 2"}, 2, "a car takes X,Y,THETA"},
  };
  for (const Case& c : cases) check(c);
}

TEST(Usage, MazesOfImpossibleSizeAreRefused) {
  const std::vector<Case> cases{
      {{"solve", "maze:"}, 2, "maze:"},
      {{"solve", "maze:5"}, 2, "ROWSxCOLS"},
      {{"solve", "maze:0x7"}, 2, "ROWS"},
      {{"solve", "maze:-5x7"}, 2, "ROWS"},
      {{"solve", "maze:5x7x9"}, 2, "maze:"},
      {{"solve", "maze:5.5x7"}, 2, "ROWS"},
      {{"solve", "maze:5x7,seed=x"}, 2, "seed"},
      {{"solve", "maze:5x7,loops=2"}, 2, "loops"},
      {{"solve", "maze:5x7,loops=nan"}, 2, "loops"},
      {{"solve", "maze:5x7,algorithm=magic"}, 2, "magic"},
      {{"solve", "maze:5x7,colour=red"}, 2, "colour"},
      {{"solve", "maze:4000000000x4000000000"}, 2, "2^32"},
      {{"generate", "maze", "0x0", "-o", "x.npy"}, 2, "ROWS"},
      {{"generate", "maze", "5x7,seed=3", "-o", "x.npy"}, 2, "expected ROWSxCOLS"},
  };
  for (const Case& c : cases) check(c);
}

TEST(Usage, ContradictionsAreRefusedAndSayWhoTakesTheOption) {
  const std::vector<Case> cases{
      {{"solve", "maze:5x7", "--planner", "prm", "--lazy", "expansion"}, 2, "lazy-prm takes this option"},
      {{"solve", "maze:5x7", "--planner", "lazy-prm", "--lazy", "path"}, 2, "is none of expansion"},
      {{"solve", "maze:5x7", "--planner", "lazy-prm", "--search", "bfs"}, 2, "the planner prm takes bfs"},
      {{"solve", "maze:5x7", "--search", "dfs", "--queue", "heap"}, 2, "dfs has no priority queue"},
      {{"solve", "maze:5x7", "--neighbours", "8", "--radius", "1"}, 2, "not both"},
      {{"solve", "maze:5x7", "--sampler", "lattice", "--samples", "9"}, 2, "lattice takes every cell centre"},
      {{"solve", "maze:5x7", "--contact", "allowed"}, 2, "--contact"},
      {{"solve", "maze:5x7", "--planner", "lazy-prm", "--pipeline", "tiled"}, 2, "the planner prm takes"},
      {{"solve", "maze:5x7", "--pipeline", "tiled", "--search", "bfs"}, 2, "--pipeline plain"},
      {{"solve", "maze:5x7", "--planner", "prm", "--pipeline", "tiled", "--sampler", "uniform"},
       2,
       "tiled takes the lattice of a maze"},
      {{"solve", "maze:5x7", "--json", "-", "--svg", "-"}, 2, "standard output takes one"},
  };
  for (const Case& c : cases) check(c);
}

TEST(Usage, LatticeWithoutAMazeIsRefused) {
  const Folder folder;
  const std::string world = folder.write("a.walls", "0 0 4 0\n0 4 4 4\nstart 1 1\ngoal 3 3\n");
  check({{"solve", world, "--sampler", "lattice"}, 2, "lattice needs a maze"});
}

TEST(Usage, MissingEndsAreAskedFor) {
  const Folder folder;
  const std::string world = folder.write("a.walls", "0 0 4 0\n0 4 4 4\n");
  check({{"solve", world}, 2, "--start: the world has none"});
  check({{"solve", world, "--start", "1,1"}, 2, "--goal: the world has none"});
}

TEST(Usage, HelpVersionCompletionsAndManualComeOnStandardOutput) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--help"},
                                                                                     {"solve", "--help"},
                                                                                     {"generate", "-h"},
                                                                                     {"completion", "bash"},
                                                                                     {"completion", "zsh"},
                                                                                     {"completion", "fish"},
                                                                                     {"man"}}) {
    SCOPED_TRACE(shown(words));
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_GT(outcome.out.size(), 500U) << outcome.out;
  }
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("warren ", 0), 0U) << version.out;
}

TEST(Usage, AnIgnoredOptionIsToldWithTheProblemThatItIsNotFor) {
  const Folder folder;
  const std::string turning = folder.write(
      "t.scene", "bounds 0 0 9 9\npolygon 3 3 5 3 5 5\nrobot polygon 0 0 1 0 0 1\nstart 1 1 0\ngoal 8 1 0\n");
  check({{"solve", turning, "--planner", "visibility", "--sampled-edges", "1"},
         2,
         "--sampled-edges: visibility would ignore it for a polygon that turns; visibility takes it for a point"});
  check({{"solve", turning, "--planner", "grid", "--optimise"},
         2,
         "--optimise: grid would ignore it for a polygon that turns; prm, lazy-prm, rrt, rrt-connect, "
         "rrt-star and informed-rrt-star take it"});
}

/// A word that nobody takes here is told before one that another planner takes, with which it would not help.
TEST(Usage, WhatIsIgnoredIsTheWordThatNobodyTakes) {
  const Folder folder;
  const std::string scene =
      folder.write("p.scene", "bounds 0 0 9 9\nclearance-price 3 1\npolygon 3 3 5 3 5 5\nstart 1 1\ngoal 8 1\n");
  for (const std::vector<std::string>& planner : {std::vector<std::string>(), {"--planner", "prm"}}) {
    std::vector<std::string> words{"solve", scene, "--alternatives", "2"};
    words.insert(words.end(), planner.begin(), planner.end());
    check({words, 2, "--alternatives: "});
  }
  const std::string unknown = folder.write("u.scene", "bounds 0 0 9 9\nunknown 2\nstart 1 1\ngoal 8 1\n");
  check({{"solve", unknown}, 2, "its line 'unknown': only maps have unknown cells"});
  const std::string turned = folder.write("h.scene", "bounds 0 0 9 9\nstart 1 1 0.5\ngoal 8 1 0.5\n");
  check({{"solve", turned}, 2, "a point has no heading, and no line names the robot; say --robot"});
  EXPECT_EQ(run({"solve", turned, "--robot", "disc 0.2"}).code, 0);
}

TEST(Usage, CellsThatAreTooSmallAreRefusedByTheirOptionAndInFewDigits) {
  const Folder folder;
  const std::string scene = folder.write("s.scene", "bounds 0 0 9 9\nwall 1 1 2 2\nstart 4 4\ngoal 5 5\n");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"solve", scene, "--planner", "grid", "--cell", "1e-300"},
                                             {"solve", scene, "--planner", "grid", "--cell", "1e-5"},
                                             {"convert", scene, "--cell", "1e-300", "-o", folder.path("a.map")},
                                             {"convert", scene, "--cell", "1e-5", "-o", folder.path("a.png")}}) {
    check({words, 2, "--cell: 1e-"});
    EXPECT_LT(run(words).err.size(), 200U);
  }
}

TEST(Usage, DoubleDashEndsTheOptions) { check({{"info", "--", "--no-such-file"}, 66, "--no-such-file"}); }

}  // namespace
}  // namespace warren::test
