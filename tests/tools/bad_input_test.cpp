// SPDX-License-Identifier: BSD-3-Clause
// Files that contradict their format, worlds that can't be solved, outputs that can't be written, and too little
// memory: the exit code says which, the message names file and line and what was expected.
#include <cmath>
#include <cstdint>
#include <cstring>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using namespace std::string_literals;

/// Format version 1.0: magic, length of the header, header, data.
std::string npy(const std::string& header, const std::string& data) {
  std::string padded = header;
  while ((10 + padded.size() + 1) % 64 != 0) padded += ' ';
  padded += '\n';
  return "\x93NUMPY\x01\x00"s + static_cast<char>(padded.size() & 0xff) + static_cast<char>(padded.size() >> 8) +
         padded + data;
}

std::string header(const std::string& type, bool fortran, const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

const std::string two_walls = bytes_of<float>({0, 0, 4, 0, 0, 4, 4, 4});

struct BadFile {
  std::string_view what;
  std::string bytes;
  std::string_view said;
};

void expect_bad_data(const std::string& name, const std::vector<BadFile>& files) {
  const Folder folder;
  for (const BadFile& file : files) {
    SCOPED_TRACE(file.what);
    const std::string path = folder.write(name, file.bytes);
    check({{"solve", path, "--start", "1,1", "--goal", "3,3"}, 65, file.said});
    const Outcome info = run({"info", path});
    EXPECT_EQ(info.code, 65) << info.err;
    EXPECT_NE(info.err.find(name), std::string::npos) << "names the file: " << info.err;
  }
}

TEST(BadInput, SceneTextThatContradictsItsFormatIsRefusedWithItsLine) {
  expect_bad_data("bad.scene",
                  {
                      {"empty", "", "empty"},
                      {"blanks only", " \n\n# nothing\n", "bad.scene"},
                      {"three numbers", "0 0 1 1\n1 2 3\n", ":2:"},
                      {"five numbers", "0 0 1 1 2\n", ":1:"},
                      {"a word", "0 0 1 1\nmazed 3 3\n", ":2:"},
                      {"NaN", "0 0 1 nan\n", ":1:"},
                      {"infinity", "0 0 1 1\n0 0 inf 1\n", ":2:"},
                      {"1e308", "0 0 1e308 1\n", ":1:"},
                      {"two signs", "0 0 1 +-1\n", ":1:"},
                      {"1e999", "0 0 1e999 1\n", ":1:"},
                      {"hexadecimal letters", "0 0 0xzz 1\n", ":1:"},
                      {"binary garbage", "\x01\x02\xff\xfe\x00garbage\x7f"s, "bad.scene"},
                      {"negative clearance", "0 0 1 1\nclearance -1\n", ":2:"},
                      {"clearance NaN", "0 0 1 1\nclearance nan\n", ":2:"},
                      {"bounds inside out", "0 0 1 1\nbounds 5 5 1 1\n", ":2:"},
                      {"polygon of two corners", "polygon 0 0 1 1\n", ":1:"},
                      {"polygon of odd numbers", "polygon 0 0 1 1 2\n", ":1:"},
                      {"unknown robot", "0 0 1 1\nrobot spider\n", ":2:"},
                      {"negative maze", "0.5 0.5 1.5 0.5\nmaze -1 5\n", ":2:"},
                      {"maze of nothing", "0.5 0.5 1.5 0.5\nmaze 0 5\n", ":2:"},
                      {"start of one number", "0 0 1 1\nstart 5\n", ":2:"},
                      {"walls off the maze's grid", "0.5 0.5 3.5 0.5\n0.7 0.5 0.7 1.5\nmaze 3 3\n", "maze"},
                  });
}

TEST(BadInput, MazeFilesThatAreDamagedAreRefused) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "maze", "9x9", "-o", folder.path("good.maze")}).code, 0);
  const std::string good = folder.read("good.maze");
  std::string header = good;
  header[17] = 1;
  std::string cell = good;
  cell[70] = static_cast<char>(cell[70] ^ 4);
  expect_bad_data("bad.maze", {
                                  {"empty", "", "begins with"},
                                  {"not a maze", "hello", "begins with"},
                                  {"magic alone", good.substr(0, 8), "ends within its header"},
                                  {"cut in the cells", good.substr(0, 75), "bytes for 9 x 9 cells"},
                                  {"cut in the checksums", good.substr(0, good.size() - 1), "bytes for 9 x 9 cells"},
                                  {"more than cells", good + "x", "bytes for 9 x 9 cells"},
                                  {"a bit of the header", header, "the header is damaged"},
                                  {"a bit of a cell", cell, "rows 0 to 8"},
                              });
  check({{"solve", folder.write("bad.maze", cell), "--pipeline", "streamed"}, 65, "rows 0 to 8"});
}

TEST(BadInput, ArraysThatAreNoWallsAreRefused) {
  const std::string good = header("<f4", false, "(2, 4)");
  expect_bad_data("bad.npy",
                  {
                      {"empty", "", "bad.npy"},
                      {"not an array", "hello", "bad.npy"},
                      {"magic alone", "\x93NUMPY", "bad.npy"},
                      {"cut in the header", npy(good, two_walls).substr(0, 30), "bad.npy"},
                      {"cut in the data", npy(good, two_walls.substr(0, 20)), "bad.npy"},
                      {"more data than walls", npy(good, two_walls + "xxxx"), "bad.npy"},
                      {"integers", npy(header("<i4", false, "(2, 4)"), two_walls), "<f4"},
                      {"big-endian", npy(header(">f4", false, "(2, 4)"), two_walls), "<f4"},
                      {"Fortran order", npy(header("<f4", true, "(2, 4)"), two_walls), "C order"},
                      {"three columns", npy(header("<f4", false, "(2, 3)"), two_walls.substr(0, 24)), "(n, 4)"},
                      {"one axis", npy(header("<f4", false, "(8,)"), two_walls), "(n, 4)"},
                      {"three axes", npy(header("<f4", false, "(1, 2, 4)"), two_walls), "(n, 4)"},
                      {"a huge count", npy(header("<f4", false, "(4611686018427387904, 4)"), two_walls), "bad.npy"},
                      {"a negative count", npy(header("<f4", false, "(-2, 4)"), two_walls), "bad.npy"},
                      {"NaN", npy(good, bytes_of<float>({0, 0, 4, 0, 0, std::nanf(""), 4, 4})), "bad.npy"},
                      {"infinity", npy(good, bytes_of<float>({0, 0, 4, 0, 0, HUGE_VALF, 4, 4})), "bad.npy"},
                      {"no dictionary", npy("not a dictionary", two_walls), "bad.npy"},
                  });
}

TEST(BadInput, WhatOtherToolsWriteIsReadAlike) {
  const Folder folder;
  const std::string plain = "0 0 4 0\n0 4 4 4\n0 0 0 4\n4 0 4 4\nstart 1 1\ngoal 3 3\n";
  const std::string lines = run({"solve", folder.write("lf.walls", plain), "--json", "-"}).out;
  ASSERT_NE(lines.find("\"solved\""), std::string::npos);
  const std::string path = lines.substr(lines.find("\"path\""));
  std::string crlf = plain;
  for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) crlf.replace(at, 1, "\r\n");
  for (const std::string& text :
       {crlf, "\xef\xbb\xbf" + plain, plain.substr(0, plain.size() - 1), "# first\n" + plain}) {
    const Outcome outcome = run({"solve", folder.write("other.walls", text), "--json", "-"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(path), std::string::npos) << "the same path for: " << text;
  }
}

TEST(BadInput, WhatCannotBeReadIs66) {
  const Folder folder;
  check({{"solve", folder.path("missing.walls")}, 66, "missing.walls"});
  check({{"solve", folder.path("")}, 66, "can't be read"});
  check({{"info", ""}, 66, "can't be read"});
  check({{"verify", "maze:5x7", folder.path("missing.json")}, 66, "missing.json"});
}

TEST(BadInput, PlacesWhereTheBodyCannotStandAreAnAnswer) {
  const Folder folder;
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const std::size_t at = outcome.out.find("\"status\": \"");
    return at == std::string::npos ? outcome.out
                                   : outcome.out.substr(at + 11, outcome.out.find('"', at + 11) - at - 11);
  };
  EXPECT_EQ(status({"solve", "maze:5x7", "--start", "1.5,0.5"}), "start_blocked");    // in a wall
  EXPECT_EQ(status({"solve", "maze:5x7", "--start", "-3,1"}), "start_blocked");       // outside
  EXPECT_EQ(status({"solve", "maze:5x7", "--goal", "100,100"}), "goal_blocked");      // outside
  EXPECT_EQ(status({"solve", "maze:5x7", "--clearance", "0.6"}), "start_blocked");    // too wide
  EXPECT_EQ(status({"solve", "maze:5x7", "--robot", "disc 0.45"}), "start_blocked");  // 0.45 + 0.1
  EXPECT_EQ(status({"solve", "maze:5x7", "--planner", "lazy-prm", "--clearance", "1e50"}), "start_blocked");
  const std::string cut = folder.write("cut.walls",
                                       "0.5 0.5 3.5 0.5\n0.5 1.5 3.5 1.5\n0.5 0.5 0.5 1.5\n3.5 0.5 3.5 1.5\n"
                                       "1.5 0.5 1.5 1.5\nmaze 1 3\nstart 1 1\ngoal 3 1\n");
  EXPECT_EQ(status({"solve", cut}), "infeasible");
  EXPECT_EQ(status({"solve", cut, "--sampler", "uniform"}), "infeasible");
  EXPECT_EQ(status({"solve", "maze:21x21", "--sampler", "uniform", "--samples", "20"}), "not_connected");
}

TEST(BadInput, OddButPossibleQuestionsAreSolved) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"solve", "maze:1x1"},
           {"solve", "maze:5x7", "--start", "3,3", "--goal", "3,3"},
           {"solve", "maze:5x7", "--clearance", "0"},
           {"solve", "maze:5x7", "--clearance", "0", "--sampler", "uniform", "--optimise"},
           {"solve", "maze:5x7", "--robot", "disc 0.3", "--sampler", "uniform"},
           {"solve", "maze:5x7", "--start=0.5,1.0", "--goal=7.5 5"}}) {
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  }
}

TEST(BadInput, OutputsThatCannotBeWrittenAre73) {
  const Folder folder;
  const std::vector<std::string> places{folder.path("no/such/folder/a.json"), folder.path(""), "", "/dev/full",
                                        folder.write("file", "x") + "/a.json"};
  for (const std::string& place : places) {
    check({{"solve", "maze:5x7", "--quiet", "--json", place}, 73, "can't be written"});
    check({{"info", "maze:5x7", "--quiet", "--json", place}, 73, "can't be written"});
  }
  check({{"solve", "maze:5x7", "--quiet", "--svg", folder.path("no/a.svg")}, 73, "can't be written"});
  check({{"solve", "maze:5x7", "--quiet", "--trace", folder.path("no/a.json")}, 73, "can't be written"});
  check({{"generate", "maze", "5x7", "-o", folder.path("no/a.npy")}, 73, "can't be written"});
}

TEST(BadInput, AFullStandardOutputIs73) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"solve", "maze:5x7"},
                                             {"solve", "maze:5x7", "--json", "-"},
                                             {"--help"},
                                             {"man"},
                                             {"info", "maze:5x7"},
                                             {"generate", "maze", "50x70", "-o", "-"}}) {
    SCOPED_TRACE(shown(arguments));
    EXPECT_EQ(Process(arguments, "/dev/null", "/dev/full").wait().code, 73);
  }
}

TEST(BadInput, ABatchWhoseOutputFailsStopsAtOnce) {
  const Folder folder;
  const std::string roadmap = folder.path("a.roadmap");
  ASSERT_EQ(run({"build", "maze:30x30", "-o", roadmap, "--quiet"}).code, 0);
  std::string lines;
  for (int i = 0; i < 50'000; ++i) lines += "{\"start\":[1,1],\"goal\":[30,30]}\n";
  const std::string batch = folder.write("batch.ndjson", lines);
  for (const char* how : {"--batch", "--matrix"}) {
    std::vector<std::string> words{"query", roadmap, how, batch};
    if (std::string(how) == "--matrix") words.push_back(folder.write("one.ndjson", "{\"start\":[1,1]}\n"));
    const auto outcome = Process(words, "/dev/null", "/dev/full").wait();
    EXPECT_EQ(outcome.code, 73);
    EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("solved"), std::string::npos) << "nothing was told: " << outcome.err;
  }
}

TEST(BadInput, AnUnwritableOutputIsFoundBeforeTheWork) {
  const Folder folder;  // a maze that takes far longer than the test may
  check({{"solve", "maze:20000x20000", "--json", folder.path("no/a.json")}, 73, "can't be written"});
}

TEST(BadInput, TooLittleMemoryIs124AndLeavesNothingBehind) {
  const Folder folder;
  check({{"solve", "maze:50x50", "--memory", "1MiB", "--quiet"}, 124, ""});
  check({{"solve", "maze:20000x20000", "--memory", "200MiB", "--quiet"}, 124, ""});
  check({{"generate", "maze", "20000x20000", "--memory", "200MiB", "-o", folder.path("a.npy")}, 124, "memory"});
  EXPECT_TRUE(folder.is_empty());
}

TEST(BadInput, AnEndedBudgetIs124WithPartialFigures) {
  const Outcome outcome = run({"solve", "maze:3000x3000", "--budget", "30ms", "--json", "-"});
  EXPECT_EQ(outcome.code, 124);
  EXPECT_NE(outcome.out.find("\"status\": \"stopped\""), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\"stopped_by\": \"budget\""), std::string::npos) << outcome.out;
}

TEST(BadInput, AnswersThatAreNoneAreRefused) {
  const Folder folder;
  const auto refused = [&](const std::string& text, std::string_view said) {
    check({{"verify", "maze:5x7", folder.write("a.json", text)}, 65, said});
  };
  refused("", "not JSON");
  refused("{\"path\": [[0.5, 1], [1, 1]", "not JSON");
  refused("{\"path\": [[0.5, 1.0], [NaN, 1]]}", "not JSON");
  refused("[[0.5, 1], [1, 1]]", "one JSON object");
  refused("42", "one JSON object");
  refused("{\"schema\": \"warren.answer/1\"}", "no key \"path\"");
  refused("{\"path\": []}", "no points");
  refused("{\"path\": 5}", "\"path\"");
  refused("{\"path\": [1, 2]}", "\"path\"");
  refused("{\"path\": [[1, 2, 3]]}", "3 numbers in point 0");
  refused("{\"path\": [[1, \"2\"]]}", "\"path\"");
  refused("{\"path\": [[1, 1e200]]}", "finite");
  refused("{\"path\": [[[1, 2]]]}", "deeper");
  refused("{\"path\": [[1, 1]], \"path\": [[1, 1]]}", "twice");
  refused("{\"path\": [[1, 1]], \"clearance\": -1}", "\"clearance\"");
  refused("{\"path\": [[1, 1]], \"contact\": \"perhaps\"}", "\"contact\"");
  refused("{\"path\": [[1, 1]], \"start\": [1]}", "\"start\"");
  refused("{\"path\": [[1, 1]], \"world\": {\"hash\": \"0123\"}}", "another world");
}

}  // namespace
}  // namespace warren::test
