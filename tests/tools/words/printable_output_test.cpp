// SPDX-License-Identifier: BSD-3-Clause
// Names of files and words of files may hold anything; what the program says of them moves no cursor, changes no
// colour, turns no direction, and errors stay one line. And: an input that shrinks while it is mapped can't be read,
// which is no crash.
#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "scenes/text/input_file_io.hpp"
#include "tests/tools/process.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::test {
namespace {

const std::string nasty = "a\x1b]0;b\x07\x1b[2J\xc2\x9b\x31m\xe2\x80\xae\xe2\x80\xa8\xc0\x9b\xff\x7f";

void expect_harmless(const std::string& text) {
  for (const unsigned char c : text) {
    ASSERT_TRUE(c == '\n' || c >= 0x20) << text;
    ASSERT_NE(c, 0x7f) << text;
  }
  for (const std::string_view bad : {"\xc2\x9b", "\xe2\x80\xae", "\xe2\x80\xa8", "\xc0", "\xff"})
    ASSERT_EQ(text.find(bad), text.npos) << text;
}

void expect_harmless_run(const std::vector<std::string>& arguments, int code) {
  SCOPED_TRACE(shown(arguments));
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err;
  expect_harmless(outcome.out);
  expect_harmless(outcome.err);
  if (code == 0 || code == 1) return;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

constexpr std::string_view small_world = "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\nwall 4 0 4 5\n";

TEST(PrintableOutput, NamesOfFilesDoNotReachTheTerminalAsTheyAre) {
  const Folder folder;
  const std::string world = folder.write(nasty + ".scene", small_world);
  const std::string map = folder.write(nasty + ".map", "type octile\nheight 1\nwidth 2\nmap\n..\n");
  const std::string queries = folder.write(nasty + ".scen", "version 0\n0 " + nasty + ".map 0 0 1 0 1\n");
  expect_harmless_run({"info", world}, 0);
  expect_harmless_run({"solve", world, "--planner", "visibility", "--json", folder.path(nasty + ".json")}, 0);
  expect_harmless_run({"verify", world, folder.path(nasty + ".json")}, 0);
  expect_harmless_run({"convert", world, "-o", folder.path(nasty + ".wall.scene")}, 0);
  expect_harmless_run({"render", world, "-o", folder.path(nasty + ".svg")}, 0);
  expect_harmless_run({"bench-scen", queries, "--map", map}, 0);
  expect_harmless_run(
      {"compare", world, "--planners", "visibility", "--trials", "1", "--csv", folder.path("c.csv"), "--quiet"}, 0);
  expect_harmless(folder.read("c.csv"));
  expect_harmless_run({"info", folder.path(nasty)}, 66);
  expect_harmless_run({"convert", world, "-o", folder.path(nasty + "/a.scene")}, 73);
  expect_harmless_run({"info", "maze:" + nasty}, 2);
  expect_harmless_run({"solve", world, "--" + nasty}, 2);
}

TEST(PrintableOutput, WordsOfFilesDoNotReachTheTerminalAsTheyAre) {
  const Folder folder;
  const std::string yaml =
      "resolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.1\nimage: "
      "\"a\\e[2J\\x9b.pgm\"\n";
  struct NastyFile {
    std::string name;
    std::string bytes;
    int code;
  };
  for (const NastyFile& file : {
           NastyFile{"word.scene", nasty + "\n", 65},
           NastyFile{"number.scene", "0 0 1 " + nasty + "\n", 65},
           NastyFile{"arm.scene", "box 0 0 0 1 1 1\nrobot arm x" + nasty + " radius 1\n", 0},
           NastyFile{"a.geojson", R"({"type": "Polygon", "coordinates": ")" + nasty + "\"}", 65},
           NastyFile{"b.geojson", R"({"type": "Polygon", "coordinates": )" + nasty + "}", 65},
           NastyFile{"a.wkt", "POLYGON (" + nasty + ")", 65},
           NastyFile{"a.poly", "0 0 " + nasty + "\n", 65},
           NastyFile{"a.map", "type octile\nheight " + nasty + "\n", 65},
           NastyFile{"b.map", "type octile\nheight 1\nwidth 2\nmap\n.\x1b\n", 65},
           NastyFile{"a.pgm", "P2 " + nasty, 65},
           NastyFile{"a.yaml", yaml, 66},
           NastyFile{"b.yaml", "image: " + nasty + ": [\n", 65},
           NastyFile{"mouse.txt", "o---o\n|" + nasty + "|\no---o\n", 65},
           NastyFile{"a.npy",
                     "\x93NUMPY\x01" + std::string(1, '\0') + std::string("\x20\0", 2) + "{'" + nasty +
                         "': 1, 'x': 'y'}                          ",
                     65},
       }) {
    expect_harmless_run({"info", folder.write(file.name, file.bytes)}, file.code);
  }
  const std::string world = folder.write("w.scene", small_world);
  const std::vector<std::string> answers{R"({"path": [[1, 1], [8, 8]], "contact": "\u001b[2J\u009b"})",
                                         R"({"path": [[1, 1], [8, 8]], "robot": "\u001b[2J\u009b"})",
                                         R"({"path": [[1, 1], [8, 8]], "world": {"hash": "\u001b[2J\u202e"}})",
                                         R"({"path": [)" + nasty + "]}"};
  for (const std::string& answer : answers) {
    expect_harmless_run({"verify", world, folder.write("answer.json", answer)}, 65);
  }
  expect_harmless_run({"bench-scen", folder.write("q.scen", "version 0\n0 " + nasty + ".map 0 0 1 0 1\n")}, 66);
  const std::string arm = folder.write("arm.scene", "box 5 5 5 6 6 6\nrobot arm x" + nasty + " radius 1\n");
  expect_harmless_run({"solve", arm, "--start", "0,0,0,0,0,0", "--goal", "1,0,0,0,0,0"}, 66);
}

TEST(PrintableOutput, AnInputThatShrinksWhileItIsMappedCannotBeRead) {
  const Folder folder;
  const std::string path = folder.write("a\x1b.npy", "0");
  std::filesystem::resize_file(path, std::size_t{16} << 20);
  const auto look_at_what_is_gone = [&] {
    tools::install_signal_handlers();
    const InputFile file(path, {});
    std::filesystem::resize_file(path, 0);
    ::_exit(file.bytes()[0] == '0' ? 0 : 1);
  };
  EXPECT_EXIT(look_at_what_is_gone(), ::testing::ExitedWithCode(tools::exit_code::unreadable),
              "warren: .*a\\\\x1b.npy: can't be read: it became shorter meanwhile");
}

}  // namespace
}  // namespace warren::test
