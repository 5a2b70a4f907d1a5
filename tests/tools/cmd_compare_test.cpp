// SPDX-License-Identifier: BSD-3-Clause
// `warren compare` as users and scripts meet it. No claim about time.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "pictures/formats/write_picture.hpp"
#include "tests/paths.hpp"
#include "tests/tools/compared.hpp"
#include "tests/tools/process.hpp"
#include "tests/tools/program.hpp"

namespace warren::tools {
namespace {

using Json = nlohmann::ordered_json;
using test::check;
using test::compared;
using test::Folder;
using test::joined;

std::string name_of_row(const Json& row) {
  return row["search"].get<std::string>() + (row["queue"].is_null() ? "" : " " + row["queue"].get<std::string>());
}

TEST(Compare, PricesGoToThePlannersThatTakeThem) {
  const std::string words = test::source_dir() +
                            "/examples/worlds/flat.yaml --robot 'disc 0.2' --start 0.5,0.5 --goal 4.3,0.5 --seeds 2 "
                            "--clearance-price 3,0.5 --planners ";
  const Json json = compared(words + "grid,rrt-connect,prm");
  ASSERT_EQ(json["rows"].size(), 2U);
  for (const Json& row : json["rows"]) EXPECT_GT(row["cost"]["median"], row["length"]["median"]);
  EXPECT_LE(json["rows"][0]["cost"]["median"], json["rows"][1]["cost"]["median"]);
  ASSERT_EQ(json["notes"].size(), 1U);
  EXPECT_NE(json["notes"][0].get<std::string>().find("rrt-connect"), std::string::npos);
  EXPECT_FALSE(compared(test::source_dir() + "/examples/worlds/flat.yaml --planners grid --seeds 1 --robot 'disc 0.2' "
                                             "--start 0.5,0.5 --goal 4.3,0.5")["rows"][0]
                   .contains("cost"));
  const ProgramRun refused = run_program("compare " + words + "rrt-connect");
  EXPECT_EQ(refused.exit_code, 2);
}

TEST(Compare, SearchesTakeEveryQueueAndAgreeOnLengths) {
  const Json json = compared(
      "maze:21x21,loops=0.2 --searches bfs,dfs,dijkstra,astar --queues "
      "heap,lazy-heap,sorted-array,resorted-array,linear-scan --trials 3");
  EXPECT_EQ(json["schema"], "warren.compare/1");
  ASSERT_EQ(json["rows"].size(), 12U);
  std::map<std::string, Json> rows;
  for (const Json& row : json["rows"]) {
    rows[name_of_row(row)] = row;
    EXPECT_EQ(row["planner"], "prm");
    EXPECT_EQ(row["runs"], 3);
    EXPECT_EQ(row["solved"], 3);
    EXPECT_EQ(row["length"]["q1"], row["length"]["q3"]);
    EXPECT_TRUE(row["time_s"]["ci95"].is_array());
    EXPECT_EQ(row["problem"]["vertices"], 21 * 21 + 2);
  }
  const Json& best = rows["dijkstra heap"];
  for (const char* queue : {"heap", "lazy-heap", "sorted-array", "resorted-array", "linear-scan"}) {
    for (const char* search : {"dijkstra ", "astar "}) {
      const Json& row = rows[search + std::string{queue}];
      EXPECT_NEAR(row["length"]["median"].get<double>(), best["length"]["median"].get<double>(), 1e-9) << queue;
    }
    EXPECT_EQ(rows["dijkstra " + std::string{queue}]["expanded"], best["expanded"]) << queue;
  }
  EXPECT_LE(rows["astar heap"]["expanded"], best["expanded"]);
  EXPECT_LE(rows["bfs"]["hops"], best["hops"]);
  EXPECT_GE(rows["dfs"]["length"]["median"], best["length"]["median"]);
}

TEST(Compare, SearchesGiveTheLengthThatSolveGives) {
  const Json json = compared("maze:15x15,loops=0.3 --searches astar --queues heap --trials 2");
  const Json solved = Json::parse(run_program("solve maze:15x15,loops=0.3 --quiet --json -").out);
  EXPECT_NEAR(json["rows"][0]["length"]["median"].get<double>(), solved["length"].get<double>(), 1e-9);
}

TEST(Compare, OptionsOfTheGraphReachIt) {
  const Json json =
      compared("maze:8x8 --sampler uniform --samples 2000 --neighbours 9 --seed 4 --searches bfs --trials 1");
  EXPECT_GT(json["rows"][0]["problem"]["vertices"], 1000);
  EXPECT_LE(json["rows"][0]["problem"]["vertices"], 2002);
}

TEST(Compare, ARoadmapAmongPolygonsIsSearchedToo) {
  const Folder folder;
  const std::string world = folder.write("a.scene",
                                         "polygon 3 1 5 1 5 6 3 6\npolygon 6 3 8 3 8 9 6 9\nbounds 0 0 10 10\n"
                                         "start 1 5\ngoal 9 5\n");
  const Json json =
      compared(world + " --graph prm --samples 400 --clearance 0.1 --searches bfs,astar --queues heap --trials 2");
  ASSERT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["rows"][1]["planner"], "prm");
  EXPECT_EQ(json["rows"][1]["options"]["samples"], 400);
  EXPECT_GT(json["rows"][1]["length"]["median"], 8.5) << "straight ahead stand two polygons";
}

TEST(Compare, AKnownVisibilityGraphHasItsFigures) {  // from where, says visibility_figures_test.cpp
  const Json json = compared(test::source_dir() + "/tests/data/dense.scene --full --trials 3");
  ASSERT_EQ(json["rows"].size(), 12U);
  for (const Json& row : json["rows"]) {
    SCOPED_TRACE(name_of_row(row));
    EXPECT_EQ(row["planner"], "visibility");
    EXPECT_EQ(row["problem"]["vertices"], 45);
    const double length = row["length"]["median"];
    if (row["search"] == "bfs") {
      EXPECT_NEAR(length, 1.281945865151, 1e-9);
      EXPECT_EQ(row["hops"], 3);
    } else if (row["search"] != "dfs") {
      EXPECT_NEAR(length, 0.826491095336, 1e-9);
      EXPECT_EQ(row["expanded"], row["search"] == "astar" ? 7 : 38);
    }
  }
}

TEST(Compare, BodiesThatTurnHavePlannersToCompareAndNoPlaneGraph) {
  const Folder folder;
  const std::string world =
      folder.write("a.scene",
                   "polygon 3 1 5 1 5 6 3 6\nbounds 0 0 10 10\n"
                   "robot polygon -0.5 -0.2 0.5 -0.2 0.5 0.2 -0.5 0.2\nstart 1 5 0\ngoal 9 5 0\n");
  check({{"compare", world, "--searches", "bfs"}, 2, "graphs in the plane"});
  const Json json = compared(world + " --planners rrt-connect --seeds 3");
  EXPECT_EQ(json["rows"][0]["solved"], 3);
}

TEST(Compare, OfTheSummaryEverySearchHasALine) {
  const ProgramRun run = run_program("compare maze:9x9 --trials 2 --color never --progress none");
  EXPECT_EQ(run.exit_code, 0);
  for (const char* word : {"bfs", "dfs", "dijkstra", "astar", "linear-scan", "median", "settled", "95 %"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  }
}

TEST(Compare, ThePeerIsCompared) {
  const ProgramRun run = run_program("compare maze:15x15,loops=0.2 --peer boost --trials 2 --quiet --json - 2>&1");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  std::map<std::string, double> lengths;
  std::set<std::string> peers;
  const Json json = Json::parse(run.out);
  for (const Json& row : json["rows"]) {
    const double length = row["length"]["median"];
    const std::string search = row["search"];
    if (row["library"] == "boost") peers.insert(search);
    EXPECT_NEAR(lengths.try_emplace(search, length).first->second, length, 1e-9) << search;
  }
  EXPECT_EQ(peers, (std::set<std::string>{"astar", "bfs", "dfs", "dijkstra"}));
}

TEST(Compare, SizesNeedNoWorldAndTellWhereQueuesCross) {
  const Folder folder;
  const Json json = compared(
      "--sizes 30,10,20 --seeds 2 --degree 6 --searches dijkstra,astar --queues heap,sorted-array --trials 4 --svg " +
      folder.path("sweep.svg"));
  EXPECT_EQ(json["rows"].size(), 3U * 2 * 2 * 2);
  std::set<int> sizes;
  for (const Json& row : json["rows"]) {
    sizes.insert(row["problem"]["vertices"].get<int>());
    EXPECT_EQ(row["planner"], "geometric");
    EXPECT_EQ(row["options"]["degree"], 6);
  }
  EXPECT_EQ(sizes, (std::set<int>{10, 20, 30}));
  ASSERT_EQ(json["crossings"].size(), 2U);
  for (const Json& crossing : json["crossings"]) {
    EXPECT_EQ(crossing["array"], "sorted-array");
    EXPECT_EQ(crossing["ratios"].size(), 3U);
    EXPECT_EQ(crossing["ratios"][0][0], 10.0) << "sizes ascend, however they were given";
  }
  const std::string svg = folder.read("sweep.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns="));
  EXPECT_NE(svg.find("where array and heap cross"), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(Compare, AWorldAndSizesAreComparedTogether) {
  const Json json = compared("maze:6x6 --sizes 10,20 --seeds 1 --searches dijkstra --queues heap --trials 1");
  std::set<std::string> graphs;
  for (const Json& row : json["rows"]) graphs.insert(row["problem"]["source"].get<std::string>());
  EXPECT_EQ(graphs, (std::set<std::string>{"geometric:10", "geometric:20", "maze:6x6"}));
}

TEST(Compare, AQueueGoesOnlyToSearchesThatHaveOne) {
  const Json json = compared("maze:5x5 --planners prm --searches bfs,dijkstra --queues heap,sorted-array --trials 1");
  std::vector<std::string> rows;
  for (const Json& row : json["rows"]) rows.push_back(name_of_row(row));
  EXPECT_EQ(rows, (std::vector<std::string>{"bfs", "dijkstra heap", "dijkstra sorted-array"}));
}

TEST(Compare, LowSuccessIsAResultAndNoneIsAnExitCode) {
  const Json some = compared("maze:5x5 --planners prm,lazy-prm --samples 3,600 --seeds 3");
  std::map<int, int> solved;
  for (const Json& row : some["rows"]) solved[row["options"]["samples"].get<int>()] += row["solved"].get<int>();
  EXPECT_EQ(solved[3], 0);
  EXPECT_EQ(solved[600], 6);
  EXPECT_EQ(run_program("compare maze:5x5 --planners prm --samples 3 --seeds 2 --quiet").exit_code, 1);
  EXPECT_EQ(run_program("compare maze:5x5 --sampler uniform --samples 3 --trials 1 --quiet").exit_code, 1);
  EXPECT_EQ(run_program("compare maze:5x5 --start 0.5,0.5 --quiet").exit_code, 1) << "blocked";
}

TEST(Compare, APageHasTheTablesOfTheSummaryAndThePlots) {
  const ProgramRun run = run_program("compare maze:5x5 --planners prm,lazy-prm --seeds 2 --html - --quiet");
  EXPECT_TRUE(run.out.starts_with("<!DOCTYPE html>"));
  for (const char* part :
       {"<td class=\"word\">lazy-prm", "<button>length q1</button>", "maze:5x5: solved</title>", "</html>\n"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part;
  }
}

TEST(Compare, PlotsAreWrittenInTheFormatThatTheirEndingSays) {
  const Folder folder;
  const auto plotted = [&](const std::string& name) {
    EXPECT_EQ(run_program("compare maze:5x5 --planners prm --seeds 2 --quiet --svg " + folder.path(name)).exit_code, 0);
    return folder.read(name);
  };
  EXPECT_TRUE(plotted("k.svg").starts_with("<svg "));
  EXPECT_TRUE(plotted("k.png").starts_with("\x89PNG"));
  if (can_write_pdf()) {
    EXPECT_TRUE(plotted("k.pdf").starts_with("%PDF"));
  }
  check({{"compare", "maze:5x5", "--svg", folder.path("k.html")},
         2,
         "--picture: a picture here ends in one of: .svg .png"});
}

TEST(Compare, EachPlotIsAFileOfItsOwnWhenAsked) {
  const Folder folder;
  const std::string words =
      "compare maze:5x5 --planners prm --sampler uniform --samples 100,300 --seeds 3 --quiet --figures ";
  ASSERT_EQ(run_program(words + folder.path("k.svg")).exit_code, 0);
  for (const char* name : {"k-length.svg", "k-time.svg", "k-solved.svg", "k-runs-solved-against-samples.svg"}) {
    EXPECT_TRUE(folder.read(name).starts_with("<svg ")) << name;
  }
  EXPECT_EQ(folder.read("k.svg"), "");
  check({{"compare", "maze:5x5", "--planners", "prm", "--figures", folder.path("k")}, 2, "--figures: expected a name"});
  check({{"compare", "maze:5x5", "--planners", "prm", "--figures", folder.path("k.svg"), "--picture",
          folder.path("k-length.svg")},
         2,
         "--figures: "});
}

TEST(Compare, TablesAreForDocumentsToo) {
  const Folder folder;
  const std::string words = "compare maze:5x5 --planners prm,lazy-prm --seeds 2 --quiet --table ";
  ASSERT_EQ(run_program(words + folder.path("a.md")).exit_code, 0);
  const std::string markdown = folder.read("a.md");
  EXPECT_TRUE(markdown.starts_with("| planner | solved | 95 % | length q1 | ")) << markdown;
  EXPECT_NE(markdown.find("\n|---|---:|---:|"), std::string::npos) << markdown;
  EXPECT_EQ(std::count(markdown.begin(), markdown.end(), '\n'), 4);
  ASSERT_EQ(run_program(words + folder.path("a.tex")).exit_code, 0);
  const std::string latex = folder.read("a.tex");
  EXPECT_TRUE(latex.starts_with("\\begin{tabular}{lr")) << latex;
  EXPECT_NE(latex.find(" & 95 \\% & "), std::string::npos) << latex;
  EXPECT_TRUE(latex.ends_with("\\bottomrule\n\\end{tabular}\n")) << latex;
}

TEST(Compare, WhatAPictureDrawsOtherwiseThanUsualIsANote) {
  const Folder folder;
  const std::string town = folder.path("town.scene");
  ASSERT_EQ(run_program("generate polygons 300 --quiet -o " + town).exit_code, 0);
  const Json searches = compared(town + " --searches astar --queues heap --trials 1 --pictures " + folder.path("s"));
  EXPECT_NE(searches["notes"].dump().find("searches.svg: drawn thinner and paler, being so many"), std::string::npos)
      << searches["notes"];
  const Json planners = compared(town + " --planners visibility --pictures " + folder.path("p"));
  EXPECT_NE(planners["notes"].dump().find("visibility.svg: drawn thinner"), std::string::npos) << planners["notes"];
}

TEST(Compare, OutputsAreWrittenSideBySide) {
  const Folder folder;
  const ProgramRun run =
      run_program("compare maze:6x6 --planners prm,lazy-prm --trials 3 --quiet --json " + folder.path("a.json") +
                  " --csv " + folder.path("a.csv") + " --log " + folder.path("a.log") + " --svg " +
                  folder.path("a.svg") + " --runs " + folder.path("runs.csv"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(Json::parse(folder.read("a.json"))["rows"].size(), 2U);
  const std::string csv = folder.read("a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  const std::string runs = folder.read("runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 2 * 3);
  const std::string log = folder.read("a.log");
  EXPECT_NE(log.find("2 planners\nwarren_prm"), std::string::npos) << log;
  EXPECT_NE(log.find("3 runs\n6; "), std::string::npos) << log;
  EXPECT_NE(folder.read("a.svg").find("per cent of the runs solved within"), std::string::npos);
}

TEST(Compare, ARunCutByItsBudgetIs124WithTheRunsSoFar) {
  const ProgramRun planners =
      run_program("compare maze:50x50 --planners prm --seeds 2 --budget 0.001us --quiet --json -");
  EXPECT_EQ(planners.exit_code, 124);
  EXPECT_EQ(Json::parse(planners.out)["rows"][0]["solved"], 0);
  EXPECT_EQ(run_program("compare --sizes 3000 --seeds 1 --searches bfs --budget 0.001us --quiet").exit_code, 124);
}

/// The program is stopped once it has said so; it would run on for some twenty times as long.
TEST(Compare, TellsHowLongAllRunsWillTake) {
  const Folder folder;
  const std::string said = folder.path("said");
  const ProgramRun run =
      run_program("compare maze:9x9 --planners prm --sampler uniform --seeds 20000 --progress plain --quiet 2>" + said +
                  " & p=$!; while kill -0 $p 2>/dev/null && ! grep -q 'left in all' " + said +
                  "; do sleep 0.05; done; kill -INT $p; wait $p");
  const std::string progress = folder.read("said");
  EXPECT_NE(progress.find(", about "), std::string::npos)
      << progress;  // a stage's own time follows with its second line
}

TEST(Compare, AnInterruptPrintsWhatThereIs) {
  const std::vector<std::string> common{"compare", "maze:9x9", "--quiet", "--json", "-"};
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--planners", "prm", "--sampler", "uniform", "--seeds", "1000000"},
        {"--trials", "1000000"}}) {
    SCOPED_TRACE(more.back());
    test::Process process(joined(common, more));
    process.wait_until_it_works_for(std::chrono::seconds(1));
    process.send(SIGINT);
    const test::Outcome run = process.wait();
    EXPECT_EQ(run.code, 130);
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json["stopped_by"], "SIGINT");
    EXPECT_GT(json["rows"][0]["runs"], 0);
  }
}

TEST(Compare, BadOptionsAreUsageErrorsOfOneLineThatNameTheOption) {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"", "WORLD is missing"},
      {"--planners prm", "WORLD is missing"},
      {"maze:5x5 --searches astar,bsf", "did you mean bfs?"},
      {"maze:5x5 --searches astar,astar", "there twice"},
      {"maze:5x5 --searches ,", "--searches"},
      {"maze:5x5 --queues stack", "--queues"},
      {"maze:5x5 --searches bfs --queues heap", "no priority queue"},
      {"maze:5x5 --trials 0", "--trials"},
      {"maze:5x5 --trials 1e4", "--trials"},
      {"maze:5x5 --peer pgraph", "--peer"},
      {"maze:5x5 --graph cube", "--graph"},
      {"maze:5x5 --seeds 3", "--seeds"},
      {"maze:5x5 --degree 3", "--degree"},
      {"maze:5x5 --samples 100,200", "--samples"},
      {"maze:5x5 --samples 0", "--samples"},
      {"maze:5x5 --optimise", "--optimise"},
      {"maze:5x5 --search astar", "say --searches"},
      {"maze:5x5 --planner prm", "--planner"},
      {"maze:5x5 --planners prm --search bfs --searches astar", "--search"},
      {"maze:5x5 --clearance -1", "--clearance"},
      {"maze:5x5 --budget 0s", "--budget"},
      {"maze:5x5 --threads 0", "--threads"},
      {"maze:5x5 --json - --csv -", "--csv"},
      {"maze:5x5 --svg plot.html", "--picture"},
      {"maze:5x5 --planners prm,nobody", "nobody"},
      {"maze:5x5 --planners prm --peer boost", "--peer"},
      {"maze:5x5 --planners prm --sizes 10", "--sizes"},
      {"maze:5x5 --planners prm --graph prm", "--graph"},
      {"maze:5x5 --planners prm --seeds 0", "--seeds"},
      {"maze:5x5 --planners prm --seeds 2 --trials 2", "--trials"},
      {"maze:5x5 --planners prm --samples 0", "--samples"},
      {"maze:5x5 --planners prm --queues linear-scan", "linear-scan"},
      {"maze:5x5 --planners prm --lazy expansion", "--lazy"},
      {"maze:5x5 --planners prm --neighbours 4,x", "--neighbours"},
      {"maze:5x5 --planners prm --neighbours 4,8 --radius 1", "give one of them"},
      {"maze:5x5 --planners prm --clearance 0.1,-1", "--clearance"},
      {"maze:5x5 --planners prm --step 1,2", "--step: prm would ignore it"},
      {"maze:5x5 --neighbours 4,8", "one graph"},
      {"maze:5x5 --clearance 0.1,0.2", "one graph"},
      {"maze:5x5 --parallel", "--parallel"},
      {"maze:5x5 --planners lazy-prm --searches bfs", "bfs"},
      {"--sizes 1", "--sizes"},
      {"--sizes 10,x", "--sizes"},
      {"--sizes 10 --degree 0", "--degree"},
      {"--sizes 10 --clearance 1", "--clearance"},
      {"--sizes 10 --samples 5", "--samples"},
      {"--sizes 10 --log x.log", "--log"},
      {"maze:5x5 maze:5x5", "unexpected argument"},
  };
  for (const auto& [words, named] : cases) {
    SCOPED_TRACE(words);
    const ProgramRun run = run_program(std::string{"compare "} + words + " 2>&1");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.out.find(named), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find('\n'), run.out.size() - 1) << "one line: " << run.out;
  }
}

TEST(Compare, FilesThatCannotBeReadOrWrittenHaveTheirCodes) {
  check({{"compare", "/nowhere.scene"}, 66, "/nowhere.scene"});
  check({{"compare", "maze:5x5", "--json", "/nowhere/a.json"}, 73, "/nowhere"});
}

TEST(Compare, BlamesTheListOfPlanners) {
  check({{"compare", "maze:5x5", "--robot", "disc 0.1", "--planners", "cells"},
         2,
         "--planners: cells plans for a point"});
}

TEST(Compare, SaysHowManyHeatMapsAreLeftOut) {
  const Folder folder;
  const test::Outcome outcome = test::run({"compare", "maze:3x3", "--planners", "prm,lazy-prm", "--sampler",
                                           "uniform,halton,random,bridge,gaussian,mixture", "--neighbours", "4,5,6",
                                           "--samples", "9,12,15", "--search", "astar,dijkstra", "--seeds", "1",
                                           "--clearance", "0.1,0.2", "--html", folder.path("c.html")});
  EXPECT_NE(outcome.out.find("60 of 72 heat maps are drawn"), std::string::npos) << outcome.out << outcome.err;
}

TEST(Compare, CurvesOfPlannersWithOneAnswerAreAStepEach) {
  const Folder folder;
  const std::string words = "compare maze:7x7 --planners prm,rrt-connect --seeds 2 --quiet --curves ";
  ASSERT_EQ(run_program(words + folder.path("k.csv")).exit_code, 0);
  std::istringstream csv(folder.read("k.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1U + 1U + 2U) << "no seed changes prm's answer";
  EXPECT_EQ(lines[0], "planner,seed,seconds,cost,length,by,lower_bound,options");
  EXPECT_EQ(lines[1].substr(0, 6), "prm,1,");
  EXPECT_NE(lines[2].find(",answer,"), std::string::npos);
  ASSERT_EQ(run_program(words + folder.path("k.svg")).exit_code, 0);
  const std::string svg = folder.read("k.svg");
  for (const char* part : {"maze:7x7: cost against time", "maze:7x7: solved", ">prm, astar, sampler lattice<",
                           ">rrt-connect, ", "best of all: "}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
}

TEST(Compare, CurvesAreRefusedWhereThereAreNone) {
  const Folder folder;
  check({{"compare", "maze:5x5", "--curves", folder.path("k.svg")}, 2, "--curves: shows how planners"});
  check({{"compare", "maze:5x5", "--planners", "prm", "--curves", folder.path("k.gif")}, 2, ".svg .png .pdf .csv"});
  check({{"compare", "maze:5x5", "--planners", "prm", "--curves", folder.path("k.csv"), "--csv", folder.path("k.csv")},
         2,
         "would both write"});
}

}  // namespace
}  // namespace warren::tools
