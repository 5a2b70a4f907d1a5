// SPDX-License-Identifier: BSD-3-Clause
// What the verbs of roadmaps refuse: one line, the exit code that it deserves, and every file as it was.
#include <sys/stat.h>

#include <filesystem>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

class RoadmapRefusals : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run({"build", "maze:9x9", "-o", roadmap_}).code, 0); }
  std::string path(const std::string& name) const { return folder_.path(name); }
  /// Words that begin with @ are files of the folder.
  void refused(std::vector<std::string> words, int code, std::string_view said, const std::string& input) const {
    for (std::string& word : words) {
      if (word.starts_with('@')) word = path(word.substr(1));
    }
    const std::string before = folder_.read("r.roadmap");
    SCOPED_TRACE(shown(words));
    const Outcome outcome = run(words, input);
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(folder_.read("r.roadmap") == before);
    EXPECT_FALSE(std::filesystem::exists(path("new")));
  }
  void refused(const std::vector<std::string>& words, int code, std::string_view said) const {
    refused(words, code, said, "/dev/null");
  }

  Folder folder_;
  std::string roadmap_ = folder_.path("r.roadmap");
};

TEST_F(RoadmapRefusals, DamagedFiles) {
  const std::string whole = folder_.read("r.roadmap");
  folder_.write("cut.roadmap", whole.substr(0, whole.size() / 2));
  folder_.write("head.roadmap", whole.substr(0, 40));
  folder_.write("long.roadmap", whole + "x");
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
  folder_.write("flipped.roadmap", flipped);
  folder_.write("text.roadmap", "hello\n");
  folder_.write("empty.roadmap", "");
  const std::vector<std::pair<std::string, std::string_view>> files{
      {"@cut.roadmap", "is cut off"},   {"@head.roadmap", "cut off"},  {"@long.roadmap", "bytes"},
      {"@flipped.roadmap", "section "}, {"@text.roadmap", "expected"}, {"@empty.roadmap", "roadmap"}};
  for (const auto& [file, said] : files) {
    refused({"query", file}, 65, said);
    refused({"update", file, "maze:9x9", "-o", "@new"}, 65, said);
    refused({"export", file, "-o", "@new.csv"}, 65, said);
    EXPECT_FALSE(std::filesystem::exists(path("new.csv")));
  }
  for (const char* file : {"@cut.roadmap", "@flipped.roadmap"}) refused({"info", file, "--check", "all"}, 65, "");
  refused({"query", "@missing.roadmap"}, 66, "can't be read");
}

TEST_F(RoadmapRefusals, AWorldIsNoRoadmapAndARoadmapNoWorld) {
  folder_.write("w.scene", "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\n");
  refused({"query", "maze:9x9"}, 65, "maze:9x9: is a world where a roadmap is expected; make one by `warren build`");
  refused({"query", "@w.scene"}, 65, "expected a roadmap file");
  refused({"export", "maze:9x9", "-o", "@new.csv"}, 65, "is a world where a roadmap is expected");
  refused({"update", "maze:9x9", "@r.roadmap", "-o", "@new"}, 65, "is a world where a roadmap is expected");
  const std::string_view said = "is a roadmap where a world is expected; ask it by `warren query`";
  refused({"solve", "@r.roadmap"}, 65, said);
  refused({"build", "@r.roadmap", "-o", "@new"}, 65, said);
  refused({"update", "@r.roadmap", "@r.roadmap", "-o", "@new"}, 65, said);
  refused({"query", "@r.roadmap", "--world", "@r.roadmap"}, 65, said);
  refused({"convert", "@r.roadmap", "-o", "@new.scene"}, 65, said);
}

TEST_F(RoadmapRefusals, NothingThatIsReadIsWritten) {
  const std::string_view said = "would overwrite";
  folder_.write("w.scene", "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\n");
  folder_.write("q.csv", "start_x,start_y,goal_x,goal_y\n1,1,5,5\n");
  refused({"build", "@w.scene", "-o", "@w.scene"}, 2, said);
  refused({"query", "@r.roadmap", "--keep", "@r.roadmap"}, 2, said);
  refused({"query", "@r.roadmap", "--json", "@./r.roadmap"}, 2, said);
  refused({"query", "@r.roadmap", "--batch", "@q.csv", "--keep", "@q.csv"}, 2, said);
  refused({"query", "@r.roadmap", "--batch", "-", "--keep", "@q.csv"}, 2, said, path("q.csv"));
  refused({"query", "@r.roadmap", "--world", "@w.scene", "--json", "@w.scene"}, 2, said);
  refused({"update", "@r.roadmap", "@w.scene", "-o", "@r.roadmap"}, 2, said);
  refused({"update", "@r.roadmap", "@w.scene", "-o", "@w.scene"}, 2, said);
  refused({"update", "@r.roadmap", "@w.scene", "-o", "@new", "--report", "@w.scene"}, 2, said);
  refused({"export", "@r.roadmap", "-o", "@r.roadmap"}, 2, said);
  std::filesystem::copy(path("r.roadmap"), path("x.co"));
  refused({"export", "@x.co", "-o", "@x.gr"}, 2, said);
  std::filesystem::copy(path("r.roadmap"), path("x.edges.csv"));
  refused({"export", "@x.edges.csv", "-o", "@x.csv"}, 2, said);
  EXPECT_EQ(folder_.read("w.scene"), "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\n");
}

TEST_F(RoadmapRefusals, TheTableOfAnArmIsNotOverwritten) {
  folder_.write("arm.txt", "joint 0 1 0 -3 3\njoint 0 1 0 -3 3\n");
  folder_.write("arm.scene",
                "sphere 9 9 9 1\nrobot arm " + path("arm.txt") + " radius 0.1\nstart 0 0 0 0 0 0\ngoal 1 1 0 0 0 0\n");
  refused({"build", "@arm.scene", "-o", "@arm.txt"}, 2, "would overwrite");
  ASSERT_EQ(run({"build", path("arm.scene"), "--samples", "50", "-o", path("arm.roadmap")}).code, 0);
  refused({"query", "@arm.roadmap", "--keep", "@arm.txt"}, 2, "would overwrite");
  refused({"query", "@arm.roadmap", "--json", "@arm.txt", "--quiet"}, 2, "would overwrite");
  refused({"update", "@arm.roadmap", "@arm.scene", "-o", "@arm.txt"}, 2, "would overwrite");
  folder_.write("arm.txt", "joint 0 1 0 -3 3\njoint 0 2 0 -3 3\n");
  refused({"query", "@arm.roadmap"}, 65, "was made for another arm");
  std::filesystem::remove(path("arm.txt"));
  ASSERT_EQ(::mkfifo(path("arm.txt").c_str(), 0600), 0);  // that nobody writes to: a budget ends the wait
  refused({"query", "@arm.roadmap", "--budget", "300ms", "--quiet"}, 124, "the time budget ended");
}

TEST_F(RoadmapRefusals, NoOutputByAnother) {
  const std::string_view said = "would both write";
  refused({"query", "@r.roadmap", "--keep", "@new", "--json", "@new"}, 2, said);
  refused({"update", "@r.roadmap", "maze:9x9", "-o", "@new", "--report", "@new"}, 2, said);
  refused({"export", "@r.roadmap", "-o", "@new.gr", "--trace", "@new.co"}, 2, said);
  refused({"export", "@r.roadmap", "-o", "@new.csv", "--trace", "@new.edges.csv"}, 2, said);
}

TEST_F(RoadmapRefusals, StandardInputAndOutputHaveOneUseEach) {
  const std::string questions = folder_.write("q.csv", "start_x,start_y,goal_x,goal_y\n1,1,5,5\n");
  refused({"query", "-", "--batch", "-"}, 2, "can't both come from standard input", questions);
  refused({"update", "-", "-", "-o", "@new"}, 2, "can't both come from standard input", roadmap_);
  const std::string_view said = "standard output takes one of them";
  refused({"query", "@r.roadmap", "--batch", "@q.csv", "--keep", "-"}, 2, said);
  refused({"query", "@r.roadmap", "--batch", "@q.csv", "--trace", "-"}, 2, said);
  refused({"update", "@r.roadmap", "maze:9x9", "-o", "-", "--report", "-"}, 2, said);
}

TEST_F(RoadmapRefusals, WordsThatMeanNothing) {
  refused({"build", "maze:9x9"}, 2, "-o FILE is missing");
  refused({"update", "@r.roadmap", "maze:9x9"}, 2, "-o FILE is missing");
  refused({"export", "@r.roadmap"}, 2, "-o FILE is missing");
  refused({"build", "maze:9x9", "-o", "@new", "--planner", "grid"}, 2, "it searches the world's cells themselves");
  refused({"build", "maze:9x9", "-o", "@new", "--planner", "cells"}, 2, "cells plans for a point");
  refused({"build", "maze:9x9", "-o", "@new", "--search", "bfs"}, 2, "--search");
  refused({"build", "maze:9x9", "-o", "@new", "--start", "1,1"}, 2, "--start");
  refused({"build", "maze:9x9", "-o", "@no/folder"}, 73, "no/folder");
  refused({"query", "@r.roadmap", "--seed", "3"}, 2, "--seed");
  refused({"query", "@r.roadmap", "--clearance", "0.3"}, 2, "--clearance: the roadmap was built with its own");
  refused({"query", "@r.roadmap", "--start", "1,1,0"}, 2, "X,Y");
  refused({"query", "@r.roadmap", "--attach", "3"}, 2, "--attach");
  refused({"query", "@r.roadmap", "--map-rules", "ros1"}, 2, "--map-rules: is for the world that --world names");
  refused({"export", "@r.roadmap", "-o", "@new.csv", "--map-rules", "ros1"}, 2, "--map-rules");
  refused({"export", "@r.roadmap", "-o", "@new.csv", "--frame", "odom"}, 2, "--frame: is for .geojson");
  refused({"query", "@r.roadmap", "--goal", "1,1", "--goal", "2,2"}, 2, "--goal: a kept roadmap is asked for one goal");
  refused({"render", "@r.roadmap", "--keep-out", "@none.yaml", "-o", "@new.svg"}, 2, "--keep-out: is for a world");
  refused({"info", "@r.roadmap", "--group", "arm"}, 2, "--group: is for a URDF");
  refused({"info", "maze:9x9", "--check", "all"}, 2, "--check: is for roadmap files");
}

}  // namespace
}  // namespace warren::test
