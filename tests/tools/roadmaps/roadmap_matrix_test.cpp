// SPDX-License-Identifier: BSD-3-Clause
// `warren query --matrix`: a table of lengths, each that of a single question.
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

class RoadmapMatrix : public ::testing::Test {
 protected:
  void build(const std::string& world, const Words& more) const {
    Words words{"build", world, "-o", roadmap_, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Outcome table(const std::string& starts, const std::string& goals, const Words& more = {}) const {
    Words words{"query", roadmap_, "--matrix", folder_.write("starts", starts), folder_.write("goals", goals)};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  /// The lengths of all pairs by --batch, as CSV fields.
  std::vector<std::string> single(const std::vector<std::string>& starts, const std::vector<std::string>& goals,
                                  const std::string& header) const {
    std::string text = header + "\n";
    for (const std::string& start : starts) {
      for (const std::string& goal : goals) text.append(start).append(",").append(goal).append("\n");
    }
    const Outcome outcome =
        run({"query", roadmap_, "--batch", folder_.write("pairs", text), "--lengths-only", "--csv", "--quiet"});
    EXPECT_EQ(outcome.code, 0);
    std::vector<std::string> lengths;
    std::istringstream lines(outcome.out.substr(outcome.out.find('\n') + 1));
    for (std::string line; std::getline(lines, line);) lengths.push_back(line.substr(line.rfind(',') + 1));
    return lengths;
  }
  /// The table of these places has the lengths of single questions, for 1 thread and 3.
  void expect_single_lengths(const std::string& header, const std::string& axes, const std::vector<std::string>& starts,
                             const std::vector<std::string>& goals) const {
    const std::vector<std::string> lengths = single(starts, goals, header);
    ASSERT_EQ(lengths.size(), starts.size() * goals.size());
    std::string expected = "id";
    for (std::size_t i = 0; i < goals.size(); ++i) expected += "," + std::to_string(i + 1);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (i % goals.size() == 0) expected += "\n" + std::to_string(i / goals.size() + 1);
      expected += "," + lengths[i];
    }
    const auto text = [&](const std::vector<std::string>& places) {
      std::string lines = axes + "\n";
      for (const std::string& place : places) lines += place + "\n";
      return lines;
    };
    for (const char* threads : {"1", "3"}) {
      const Outcome outcome = table(text(starts), text(goals), {"--csv", "--threads", threads});
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_EQ(outcome.out, expected + "\n");
    }
  }

  Folder folder_;
  std::string roadmap_ = folder_.path("r.roadmap");
};

TEST_F(RoadmapMatrix, LengthsAreThoseOfSingleQuestions) {
  const std::vector<std::string> places{"1,1", "7,3", "0.5,0.5", "8.75,2.2", "4,4.1"};
  const std::vector<std::string> goals{"9,9", "2.25,7", "1,1", "3,3", "6,1", "5,5.5"};
  for (const char* planner : {"prm", "lazy-prm"}) {
    for (const char* sampler : {"lattice", "uniform"}) {
      SCOPED_TRACE(std::string(planner) + " " + sampler);
      build("maze:9x9,loops=0.2", {"--planner", planner, "--sampler", sampler});
      expect_single_lengths("start_x,start_y,goal_x,goal_y", "x,y", places, goals);
    }
  }
}

TEST_F(RoadmapMatrix, LengthsOfAnIndexAreThoseOfSingleQuestions) {
  build("maze:257x256,loops=0.05", {});
  expect_single_lengths("start_x,start_y,goal_x,goal_y", "x,y", {"1,1", "100,200.25", "3.5,3.5", "0.5,0.5"},
                        {"256,257", "99.75,200", "3.25,3.5", "17,18", "0.5,0.5"});
}

TEST_F(RoadmapMatrix, BodiesThatTurnAndArmsAreAskedByAllTheirNumbers) {
  build(source_dir() + "/examples/worlds/car-20.scene", {"--planner", "lazy-prm", "--samples", "300"});
  const Json own = Json::parse(run({"query", roadmap_, "--json", "-"}).out);
  const auto joined = [](const Json& numbers) {
    std::string text;
    for (const Json& number : numbers) text += (text.empty() ? "" : ",") + number.dump();
    return text;
  };
  const std::string header = "start_x,start_y,start_theta,goal_x,goal_y,goal_theta";
  const std::string goal = joined(own["goal"]);
  expect_single_lengths(header, "x,y,theta", {joined(own["start"]), goal}, {goal, joined(own["start"])});
  const Outcome any = table("x,y,theta\n" + joined(own["start"]) + "\n", "x,y\n5,5\n");
  EXPECT_EQ(any.code, 0) << any.err;
  build(source_dir() + "/examples/worlds/puma.scene", {"--planner", "prm", "--samples", "200"});
  const Outcome arm = table("1,2,3,4,5,6\n0,0,0,0,0,0\n", "{\"state\": [0, 0, 0, 0, 0, 0]}\n", {"--csv"});
  EXPECT_EQ(arm.out, "id,1\n1,0.0\n");
}

TEST_F(RoadmapMatrix, ALineThatIsWrongIsWrongInItsRowOrColumn) {
  build("maze:9x9", {});
  const std::string starts = "x,y\n1,1\nx,1\n0.5,0.5\n";
  const std::string goals =
      "{\"id\": \"a,b\", \"state\": [1, 1]}\n{\"state\": [1]}\n{\"id\": 7, \"state\": [1, 1e99]}\n";
  const Outcome csv = table(starts, goals, {"--csv"});
  EXPECT_EQ(csv.code, 65);
  EXPECT_EQ(csv.out, "id,\"a,b\",2,7\n1,0.0,error,error\n2,error,error,error\n3,,error,error\n");
  EXPECT_EQ(csv.err, "3 starts, 3 goals, 1 solved, 4 wrong\n");
  EXPECT_EQ(table(starts, goals).out,
            "{\"id\":1,\"status\":[\"solved\",\"error\",\"error\"],\"length\":[0.0,null,null],"
            "\"error\":\"goal 2: state: expected 2 numbers (found: 1)\"}\n"
            "{\"id\":2,\"error\":\"expected a number (found: x)\"}\n"
            "{\"id\":3,\"status\":[\"start_blocked\",\"error\",\"error\"],\"length\":[null,null,null],"
            "\"error\":\"goal 2: state: expected 2 numbers (found: 1)\"}\n");
}

TEST_F(RoadmapMatrix, OneFileMayComeFromStandardInput) {
  build("maze:9x9", {});
  const std::string places = folder_.write("places", "x,y\n1,1\n2,2\n");
  const std::string plain = table("x,y\n1,1\n2,2\n", "x,y\n1,1\n2,2\n", {"--csv"}).out;
  EXPECT_EQ(plain.substr(0, 12), "id,1,2\n1,0.0");
  EXPECT_EQ(Process({"query", roadmap_, "--matrix", places, "-", "--csv"}, places).wait().out, plain);
  EXPECT_EQ(Process({"query", roadmap_, "--matrix=" + places, places, "--csv"}, "/dev/null").wait().out, plain);
  EXPECT_EQ(table("", "").out, "");
  EXPECT_EQ(table("x,y\n", "x,y\n1,1\n", {"--csv"}).out, "id,1\n");
}

TEST_F(RoadmapMatrix, WhatMakesNoTableIsRefused) {
  build("maze:9x9", {});
  const std::string places = folder_.write("places", "x,y\n1,1\n");
  const Words words{"query", roadmap_, "--matrix", places, places};
  const auto with = [&](const Words& more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  check({with({"--batch", places}), 2, "--matrix: makes a table of its own"});
  check({with({"--lengths-only"}), 2, "--matrix tells lengths alone"});
  check({with({"--start", "1,1"}), 2, "--start: is for one question; --matrix has many"});
  check({with({"--keep", places}), 2, "would overwrite"});
  check({{"query", roadmap_, "--matrix", places}, 2, "--matrix: GOALS is missing"});
  check({{"query", roadmap_, "--matrix", "-", "-"}, 2, "can't both come from standard input"});
  check({{"query", roadmap_, "--matrix", places, folder_.path("missing")}, 66, "missing: can't be read"});
  check({{"query", roadmap_, "--matrix", places, folder_.write("bad", "x,z\n1,1\n")}, 65, "(found: z)"});
  check({{"query", roadmap_, "--matrix", places, folder_.write("bad", "x\n1\n")}, 65, "bad:1: lacks the column y"});
}

}  // namespace
}  // namespace warren::test
