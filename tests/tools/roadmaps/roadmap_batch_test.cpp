// SPDX-License-Identifier: BSD-3-Clause
// `warren query --batch`: many questions, CSV or JSON lines, a line of answer each, in their order.
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

constexpr const char* csv =
    "start_x,start_y,goal_x,goal_y\n1,1,5,5\n1,1,2,2\nx,1,2,2\n1,1,5\n1,1,5,5,5\n,1,5,5\n0.5,0.5,1,1\n";

class RoadmapBatch : public ::testing::Test {
 protected:
  void SetUp() override { build("maze:9x9", {}); }
  void build(const std::string& world, const Words& more) const {
    Words words{"build", world, "-o", roadmap_, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Outcome asked(const std::string& questions, const Words& more = {}) const {
    Words words{"query", roadmap_, "--batch", folder_.write("questions", questions)};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  static std::vector<Json> lines_of(const std::string& text) {
    std::vector<Json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  double length_to(const std::string& start, const std::string& goal) const {
    const Outcome outcome = run({"query", roadmap_, "--start=" + start, "--goal=" + goal, "--json", "-"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["length"];
  }

  Folder folder_;
  std::string roadmap_ = folder_.path("r.roadmap");
};

TEST_F(RoadmapBatch, AnswersEachLineInItsOrder) {
  const Outcome outcome = asked(csv);
  EXPECT_EQ(outcome.code, 65);
  EXPECT_EQ(outcome.err, "7 questions, 2 solved, 4 wrong\n");
  const std::vector<Json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 7U);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i]["id"], i + 1);
  EXPECT_EQ(lines[0]["status"], "solved");
  EXPECT_EQ(lines[0]["length"], length_to("1,1", "5,5"));
  EXPECT_EQ(lines[0]["verified"], true);
  EXPECT_EQ(lines[0]["path"].front(), Json::parse("[1, 1]"));
  EXPECT_EQ(lines[0]["path"].back(), Json::parse("[5, 5]"));
  EXPECT_EQ(lines[2]["error"], "expected a number (found: x)");
  EXPECT_EQ(lines[3]["error"], "expected 4 fields");
  EXPECT_EQ(lines[4]["error"], "expected 4 fields");
  EXPECT_EQ(lines[5]["error"], "a number is missing");
  EXPECT_EQ(lines[6]["status"], "start_blocked");
  EXPECT_TRUE(lines[6]["length"].is_null());
}

/// Coordinates and angles that readers admit, of every body: each is blocked there, at once.
TEST_F(RoadmapBatch, EndsFarOutsideAreBlocked) {
  struct World {
    std::string text;
    std::string end;  // behind its first number
  };
  const std::string room = "bounds 0 0 10 10\nwall 5 0 5 7\n";
  const World worlds[] = {{"type octile\nheight 3\nwidth 3\nmap\n..@\n...\n...\n", ",1]"},
                          {room, ",1]"},
                          {room + "robot disc 0.3\n", ",1]"},
                          {room + "robot polygon -0.4 -0.2 0.4 -0.2 0.4 0.2 -0.4 0.2\n", ",1,0]"},
                          {room + "robot car radius 0.3 turning 0.7\n", ",1,0]"},
                          {room + "robot car radius 0.3 turning 0.7 steering reeds-shepp\n", ",1,0]"},
                          {"robot puma560 radius 0.03 limits classic\nsphere 5 5 5 0.1\n", ",1,0,0,0,0]"}};
  for (const auto& [text, end] : worlds) {
    SCOPED_TRACE(text);
    build(folder_.write("world", text), {"--samples", "50"});
    std::string questions;
    for (const std::string far : {"1e7", "-1e7", "1e19", "-1e20", "1e60"}) {
      questions += "{\"start\":[" + far + end + ",\"goal\":[1" + end + "}\n";
      questions += "{\"start\":[1" + end + ",\"goal\":[" + far + end + "}\n";
    }
    const Outcome outcome = asked(questions, {"--budget", "20s"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<Json> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 10U);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i]["status"], i % 2 == 0 ? "start_blocked" : "goal_blocked") << i;
    }
  }
}

TEST_F(RoadmapBatch, NoPathIsAnAnswer) {
  const Outcome outcome = asked("start_x,start_y,goal_x,goal_y\n0.5,0.5,1,1\n", {"--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "{\"id\":1,\"status\":\"start_blocked\",\"length\":null,\"verified\":false,\"path\":[]}\n");
}

TEST_F(RoadmapBatch, AnswersInFewerWordsOrAsCsv) {
  const std::string text = "start_x,start_y,goal_x,goal_y\n1,1,1,1\n0.5,0.5,1,1\n?,1,1,1\n";
  EXPECT_EQ(asked(text, {"--lengths-only"}).out,
            "{\"id\":1,\"status\":\"solved\",\"length\":0.0}\n{\"id\":2,\"status\":\"start_blocked\",\"length\":null}\n"
            "{\"id\":3,\"error\":\"expected a number (found: ?)\"}\n");
  EXPECT_EQ(asked(text, {"--csv"}).out,
            "id,status,length,verified\n1,solved,0.0,true\n2,start_blocked,,false\n3,error,,\n");
  EXPECT_EQ(asked(text, {"--csv", "--lengths-only"}).out,
            "id,status,length\n1,solved,0.0\n2,start_blocked,\n3,error,\n");
}

TEST_F(RoadmapBatch, ReadsWhatSpreadsheetsWrite) {
  const std::string plain = asked("start_x,start_y,goal_x,goal_y\n1,1,5,5\n2,2,3,3\n").out;
  EXPECT_EQ(lines_of(plain).size(), 2U);
  EXPECT_EQ(asked("start_x,start_y,goal_x,goal_y\r\n1,1,5,5\r\n\r\n2,2,3,3").out, plain);
  EXPECT_EQ(asked("\xef\xbb\xbfstart_x,start_y,goal_x,goal_y\n1,1,5,5\n2,2,3,3\n").out, plain);
  EXPECT_EQ(asked("goal_y, goal_x, start_y, start_x\n5, 5, 1, 1\n3, 3, 2, 2\n").out, plain);
  EXPECT_EQ(Process({"query", roadmap_, "--batch", "-"}, folder_.path("questions")).wait().out, plain);
}

TEST_F(RoadmapBatch, ReadsJsonLinesWithIdsOfTheirOwn) {
  const Outcome outcome = asked(R"({"id": "ä\"", "start": [1, 1], "goal": [5, 5]}
{"id": 70, "start": [1, 1], "goal": [5, 5]}
{"start": [1, 1], "goal": "5,5"}
{"id": 3.5, "strat": [1, 1], "goal": [5, 5]}
{"id": [], "start": [1, 1], "goal": [5, 5]}

nonsense
{"id": "six", "start": [1, 1, 0], "goal": [5, 5]}
{"id": 1e0, "start": [1, 1], "goal": [5, null]}
{"goal": [1, 1]})",
                                {"--lengths-only"});
  EXPECT_EQ(outcome.code, 65);
  const std::vector<Json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 9U);
  EXPECT_EQ(lines[0]["id"], "ä\"");
  EXPECT_EQ(lines[0]["length"], length_to("1,1", "5,5"));
  EXPECT_EQ(lines[1]["id"], 70);
  EXPECT_EQ(lines[1]["length"], lines[0]["length"]);
  EXPECT_EQ(lines[2], Json::parse(R"({"id": 3, "error": "goal: expected a list of numbers"})"));
  EXPECT_EQ(lines[3], Json::parse(R"({"id": 3.5, "error": "strat: expected the keys id, start, goal"})"));
  EXPECT_EQ(lines[4], Json::parse(R"({"id": 5, "error": "id: expected a text or a number"})"));
  EXPECT_EQ(lines[5]["id"], 6);
  EXPECT_EQ(lines[5].size(), 2U);
  EXPECT_EQ(lines[6]["id"], "six");
  EXPECT_EQ(lines[6]["error"], "start: a point or disc takes X,Y (found: 3 numbers)");
  EXPECT_EQ(lines[7]["error"], "goal: expected a list of numbers");
  EXPECT_EQ(lines[8]["status"], "solved");  // from the world's own start
}

TEST_F(RoadmapBatch, IdsAreQuotedAsCsvQuotesThem) {
  EXPECT_EQ(asked(R"({"id": "a \"b\", c", "goal": [1, 1]}
{"id": "plain", "goal": [1, 1]}
{"id": "two\nlines", "goal": [1, 1]}
{"id": "d,", "goal": [1]})",
                  {"--csv", "--lengths-only"})
                .out,
            "id,status,length\n\"a \"\"b\"\", c\",solved,0.5\nplain,solved,0.5\ntwo\\x0alines,solved,0.5\n"
            "\"d,\",error,\n");
}

TEST_F(RoadmapBatch, NothingIsAskedByAnEmptyFile) {
  for (const char* text : {"", "\n\r\n", "start_x,start_y,goal_x,goal_y\n"}) {
    const Outcome outcome = asked(text);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(asked("", {"--csv"}).out, "id,status,length,verified\n");
}

TEST_F(RoadmapBatch, AHeaderThatSaysNothingIsRefused) {
  const auto refused = [&](const std::string& text, std::string_view said) {
    const Outcome outcome = asked(text);
    EXPECT_EQ(outcome.code, 65) << text;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("a,b\n1,2\n", "questions:1: expected the header start_x,start_y,goal_x,goal_y");
  refused("start_x,start_y,goal_x,weight\n", "(found: weight)");
  refused("start_x,start_7\n", "(found: start_7)");
  refused("start_x,start_x,goal_x,goal_y\n", "expected each column once (found: start_x)");
  refused("start_x,start_y,start_theta,goal_x,goal_y\n", "(found: start_theta)");
  refused("start_1,start_2,goal_1,goal_2\n", "(found: start_1)");
}

TEST_F(RoadmapBatch, AColumnThatIsMissingIsNamedBeforeAnyAnswer) {
  const auto refused = [&](const std::string& text, std::string_view said) {
    const Outcome outcome = asked(text);
    EXPECT_EQ(outcome.code, 65) << text;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("start_x,start_y,goal_x\n1,1,5\n", "questions:1: lacks the column goal_y");
  refused("\n\nstart_y,goal_x,goal_y\n1,1,5\n", "questions:3: lacks the column start_x");
  EXPECT_EQ(asked("goal_x,goal_y\n5,5\n").code, 0);  // from the maze's own start
  build(folder_.write("w.scene", "bounds 0 0 9 9\ngoal 8 8\n"), {"--samples", "50"});
  refused("goal_x,goal_y\n5,5\n", "lacks the column start_x, for the world has no start");
  EXPECT_EQ(asked("start_x,start_y\n5,5\n").code, 0);
  build(source_dir() + "/examples/worlds/car-20.scene", {"--samples", "50"});
  refused("start_x,start_y,goal_x,goal_y\n", "lacks the column start_theta");
  EXPECT_EQ(asked("start_x,start_y,start_theta,goal_x,goal_y\n").code, 0);  // any heading
}

TEST_F(RoadmapBatch, AnEmptyHeadingIsAnyHeading) {
  build(source_dir() + "/examples/worlds/parking-lot.scene", {"--planner", "prm", "--samples", "300"});
  const Json meta = Json::parse(run({"query", roadmap_, "--json", "-"}).out);
  const std::string goal = meta["goal"][0].dump() + "," + meta["goal"][1].dump();
  const std::string start = meta["start"][0].dump() + "," + meta["start"][1].dump() + "," + meta["start"][2].dump();
  const std::string fixed = goal + "," + meta["goal"][2].dump();
  const Outcome outcome = asked("start_x,start_y,start_theta,goal_x,goal_y,goal_theta\n" + start + "," + fixed + "\n" +
                                start + "," + goal + ",\n" + start.substr(0, start.rfind(',')) + ",," + fixed + "\n");
  EXPECT_EQ(outcome.code, 65);
  const std::vector<Json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0]["length"], meta["length"]);
  EXPECT_EQ(lines[0]["path"].back(), meta["goal"]);
  EXPECT_EQ(lines[1]["length"], length_to(start, goal));
  EXPECT_TRUE(lines[2].contains("error"));  // a start has a heading
}

TEST_F(RoadmapBatch, ArmsAreAskedByTheirJoints) {
  build(source_dir() + "/examples/worlds/puma.scene", {"--planner", "prm", "--samples", "300"});
  const Json own = Json::parse(run({"query", roadmap_, "--json", "-"}).out);
  std::string header;
  std::string line;
  for (const char* end : {"start", "goal"}) {
    for (std::size_t i = 0; i < 6; ++i) {
      header += (header.empty() ? "" : ",") + std::string(end) + "_" + std::to_string(i + 1);
      line +=
          (line.empty() ? "" : ",") + own["path"][end == std::string("start") ? 0 : own["path"].size() - 1][i].dump();
    }
  }
  const Outcome outcome = asked(header + "\n" + line + "\n");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  const std::vector<Json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["status"], "solved");
  EXPECT_EQ(lines[0]["path"].front(), own["path"].front());
  EXPECT_EQ(lines[0]["path"].back(), own["path"].back());
}

TEST_F(RoadmapBatch, AnswersAreTheSameForAnyNumberOfThreads) {
  build("maze:15x15,loops=0.2", {"--planner", "lazy-prm", "--samples", "2000"});
  std::string questions = "start_x,start_y,goal_x,goal_y\n";
  for (int i = 0; i < 2000; ++i) {
    const auto place = [&](int k) {
      return std::to_string(1 + i * k % 15) + "," + std::to_string(1 + i * (k + 4) % 15);
    };
    questions += place(3) + "," + place(11) + "\n";
  }
  std::string first;
  std::string learnt;
  for (const char* threads : {"1", "2", "7"}) {
    const Outcome outcome = asked(questions, {"--threads", threads, "--keep", folder_.path("learnt.roadmap")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    if (first.empty()) first = outcome.out;
    if (learnt.empty()) learnt = folder_.read("learnt.roadmap");
    EXPECT_TRUE(outcome.out == first) << threads;
    EXPECT_TRUE(folder_.read("learnt.roadmap") == learnt) << threads;
  }
  EXPECT_EQ(lines_of(first).size(), 2000U);
  EXPECT_EQ(lines_of(first)[1999]["id"], 2000);
}

TEST_F(RoadmapBatch, WhatIsForOneQuestionIsRefused) {
  const std::string file = folder_.write("questions", csv);
  for (const char* option : {"--start", "--goal"}) {
    check({{"query", roadmap_, "--batch", file, option, "1,1"}, 2, "is for one question"});
  }
  for (const char* option : {"--json", "--svg"}) {
    check({{"query", roadmap_, "--batch", file, option, folder_.path("x")}, 2, "is for one question"});
  }
  for (const char* option : {"--csv", "--lengths-only"}) check({{"query", roadmap_, option}, 2, "needs --batch FILE"});
  check({{"query", roadmap_, "--batch", folder_.path("missing")}, 66, "missing: can't be read"});
}

}  // namespace
}  // namespace warren::test
