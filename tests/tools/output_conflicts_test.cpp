// SPDX-License-Identifier: BSD-3-Clause
// No verb overwrites what it reads, or one of its outputs by another: exit code 2, and every file as it was.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

constexpr std::string_view cells = "P2\n3 3\n255\n0 0 0\n255 255 255\n0 0 0\n";
constexpr std::string_view ros_keys =
    "\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
constexpr std::string_view arm_table = "joint 0 1 0 -3 3\njoint 0 1 0 -3 3\n";

/// A folder with a world, its answer, links to the world, a map and an arm; the tests run in it.
class OutputConflicts : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run({"generate", "maze", "3x3", "-o", path("w.scene")}).code, 0);
    ASSERT_EQ(run({"solve", path("w.scene"), "--json", path("a.json")}).code, 0);
    std::filesystem::create_symlink("w.scene", path("link.scene"));
    std::filesystem::create_hard_link(path("w.scene"), path("hard.scene"));
    std::filesystem::create_symlink("missing.json", path("nowhere.json"));
    std::filesystem::create_directory(path("pictures"));
    folder_.write("m.pgm", cells);
    folder_.write("m.yaml", "image: m.pgm" + std::string{ros_keys});
    folder_.write("z.pgm", cells);
    folder_.write("z.yaml", "image: z.pgm" + std::string{ros_keys});
    folder_.write("arm.urdf", "<robot name=\"r\"/>");
    folder_.write("arm.txt", arm_table);
    folder_.write("s.map", "type octile\nheight 1\nwidth 2\nmap\n..\n");
    folder_.write("s.scen", "version 1\n0\ts.map\t2\t1\t0\t0\t1\t0\t1\n");
    folder_.write("arm.scene", "sphere 9 9 9 1\nrobot arm " + path("arm.txt") +
                                   " radius 0.1\nstart 0 0 0 0 0 0\ngoal 1 1 0 0 0 0\n");
    before_ = contents();
  }
  std::string path(const std::string& name) const { return folder_.path(name); }
  /// Words that begin with @ are files of the folder.
  std::vector<std::string> words(const std::string& line) const {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      const std::string word = line.substr(at, end - at);
      words.push_back(word.starts_with('@') ? path(word.substr(1)) : word);
      at = end + 1;
    }
    return words;
  }
  std::string contents() const {
    std::string all;
    for (const char* name : {"w.scene", "a.json", "m.pgm", "m.yaml", "z.pgm", "z.yaml", "arm.txt", "arm.urdf", "s.map",
                             "s.scen", "arm.scene"}) {
      all += folder_.read(name);
    }
    return all;
  }
  void refused(const std::string& line, std::string_view said) {
    check({words(line), 2, said});
    EXPECT_EQ(contents(), before_) << line;
  }

  Folder folder_;
  std::string before_;
};

TEST_F(OutputConflicts, NoVerbOverwritesItsInput) {
  const std::string_view said = "would overwrite";
  refused("solve @w.scene --json @w.scene", said);
  refused("solve @w.scene --svg @w.scene --quiet", said);
  refused("solve @w.scene --trace @w.scene", said);
  refused("verify @w.scene @a.json --json @a.json", said);
  refused("verify @w.scene @a.json --json @w.scene", said);
  refused("verify @w.scene @a.json --certificate @m.pgm --json @m.pgm", said);
  refused("info @w.scene --json @w.scene", said);
  refused("convert @w.scene -o @w.scene", said);
  refused("render @w.scene --answer @a.json -o @a.json", said);
  refused("compare @w.scene --csv @w.scene", said);
  refused("compare @w.scene --planners prm --log @w.scene", said);
  refused("bench-scen @s.scen --json @s.scen", said);
  refused("bench-scen @s.scen --map @s.map --json @s.map", said);
  refused("bench-scen @s.scen --json @s.map", said);
}

TEST_F(OutputConflicts, FilesAreComparedAndNotTheirNames) {
  const std::string_view said = "would overwrite";
  refused("convert @w.scene -o @./w.scene", said);
  refused("convert @w.scene -o @pictures/../w.scene", said);
  refused("convert @w.scene -o @link.scene", said);
  refused("convert @link.scene -o @w.scene", said);
  refused("convert @w.scene -o @hard.scene", said);
  Process from_input({"convert", "-", "-o", path("hard.scene")}, path("w.scene"));
  EXPECT_EQ(from_input.wait().code, 2);
  EXPECT_EQ(contents(), before_);
}

TEST_F(OutputConflicts, NorFilesThatItsInputNames) {
  const std::string_view said = "would overwrite";
  refused("convert @m.yaml -o @m.pgm", said);
  refused("convert @m.pgm -o @m.yaml", said);  // whose image would be m.pgm
  refused("solve @m.yaml --start 0.5,1.5 --goal 2.5,1.5 --json @m.pgm", said);
  refused("solve @m.yaml --start 0.5,1.5 --goal 2.5,1.5 --keep-out @z.yaml --json @z.pgm", said);
  refused("solve @arm.scene --json @arm.txt", said);
  refused("compare @arm.scene --planners prm --json @arm.txt", said);
  const std::vector<std::string> by_option{
      "solve", path("w.scene"), "--robot", "arm " + path("arm.txt") + " radius 0.1", "--json", path("./arm.txt")};
  check({by_option, 2, said});
  check({{"solve", path("arm.scene"), "--robot", "urdf " + path("arm.urdf"), "--json", path("arm.urdf")}, 2, said});
  EXPECT_EQ(contents(), before_);
}

TEST_F(OutputConflicts, NorOneOutputByAnother) {
  const std::string_view said = "would both write";
  refused("solve @w.scene --json @new.svg --svg @new.svg", said);
  refused("solve @w.scene --json @new.json --trace @./new.json", said);
  refused("solve @w.scene --json @nowhere.json --trace @missing.json", said);
  refused("convert @w.scene --cell 0.5 -o @new.yaml --trace @new.pgm", said);
  refused("generate maze 3x3 -o @new.scene --trace @new.scene", said);
  refused("compare @w.scene --json @new --csv @new", said);
  refused("scale --sizes 3 --json @new --html @new", said);
  refused("largest --json @new --svg @new", said);
  refused("verify @w.scene @a.json --json @new --trace @new", said);
  refused("render @w.scene -o @new.svg --trace @new.svg", said);
  refused("compare @w.scene --planners prm --pictures @pictures --svg @pictures/prm.svg", "--pictures");
  EXPECT_FALSE(std::filesystem::exists(path("new")));
}

TEST_F(OutputConflicts, StandardOutputTakesOne) {
  const std::string_view said = "standard output takes one";
  refused("verify @w.scene @a.json --json - --trace -", said);
  refused("generate maze 3x3 -o - --trace -", said);
  refused("solve @w.scene --json - --svg /dev/stdout", said);
  refused("verify @w.scene - --certificate -", "can't both come from standard input");
}

TEST_F(OutputConflicts, ATraceOnStandardOutputStandsAlone) {
  const Outcome verified = run(words("verify @w.scene @a.json --trace -"));
  EXPECT_EQ(verified.code, 0);
  EXPECT_TRUE(verified.out.starts_with('{') && verified.out.ends_with("]}\n")) << verified.out;
}

TEST_F(OutputConflicts, WhatIsNoConflictIsWritten) {
  for (const char* const line :
       {"solve @w.scene --json /dev/null --svg /dev/null",
        "solve @w.scene --json @1.json --svg @1.svg --trace @1.trace", "convert @m.yaml -o @n.yaml",
        "generate maze 3x3 -o @w.svg",
        "compare @w.scene --planners prm --seeds 1 --pictures @pictures --svg @pictures/plot.svg"}) {
    const Outcome outcome = run(words(line));
    EXPECT_EQ(outcome.code, 0) << line << outcome.err;
  }
  EXPECT_EQ(contents(), before_);
}

TEST_F(OutputConflicts, APictureOfAnotherKindIsRefused) {
  refused("solve @w.scene --svg @x.gif", ".svg .png .pdf .html");
  refused("compare @w.scene --svg @x.html", ".svg .png .pdf");
  refused("largest --svg @x.gif", ".svg .png .pdf");
  EXPECT_FALSE(std::filesystem::exists(path("x.html")));
}

TEST_F(OutputConflicts, AMapIsWrittenUnderAnyNameAndReadBack) {
  for (const char* name :
       {"a #b.yaml", "- x.yaml", "it's \"1\".yaml", "back\\slash: y.yaml", "tab\t.yaml", "ä.yaml", "\xff.yaml"}) {
    ASSERT_EQ(run({"convert", path("m.yaml"), "-o", path(name)}).code, 0) << name;
    EXPECT_EQ(run({"info", path(name)}).code, 0) << name << folder_.read(name);
  }
}

TEST_F(OutputConflicts, AClosedStandardOutputIs73) {
  const std::string line = program() + " info " + path("w.scene") + " >&- 2>" + path("said");
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 73);  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
  EXPECT_NE(folder_.read("said").find("standard output: can't be written"), std::string::npos);
  EXPECT_EQ(contents(), before_);
}

}  // namespace
}  // namespace warren::test
