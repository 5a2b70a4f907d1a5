// SPDX-License-Identifier: BSD-3-Clause
// `warren example`: the worlds of examples/worlds, out of the program as they stand there.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

const std::filesystem::path worlds = std::filesystem::path(source_dir()) / "examples" / "worlds";

TEST(Example, WithoutANameEveryWorldHasItsLine) {
  const Outcome outcome = run({"example"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string readme = bytes_of(worlds / "README.md");
  std::istringstream lines(outcome.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line) && line.find('\'') == line.npos; ++count) {
    const std::string name = line.substr(0, line.find(' '));
    const std::string sight = line.substr(line.find_first_not_of(' ', name.size()));
    EXPECT_NE(readme.find("| `" + name + "."), readme.npos) << name;
    EXPECT_NE(readme.find("| " + sight + ": `"), readme.npos) << sight;
  }
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = readme.find("\n| `", at)) != readme.npos; ++at) ++rows;
  EXPECT_EQ(count, rows);
}

TEST(Example, WritesTheFilesAsTheyStandAndSaysACommandThatSolvesThem) {
  const Folder folder;
  std::size_t written = 0;
  for (const char* name :
       {"walls", "poly-easy", "town", "flat", "car-20", "parking-lot", "parking", "square-place", "garage", "puma"}) {
    SCOPED_TRACE(name);
    const Outcome outcome = run({"example", name, "-o", folder.path("")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(": warren solve " + std::string{name} + "."), outcome.out.npos) << outcome.out;
  }
  for (const auto& file : std::filesystem::directory_iterator(worlds)) {
    if (file.path().filename() == "README.md") continue;
    EXPECT_EQ(folder.read(file.path().filename()), bytes_of(file.path())) << file.path();
    ++written;
  }
  EXPECT_EQ(written, static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path("")), {})));
  EXPECT_EQ(run({"solve", folder.path("walls.scene"), "--quiet"}).code, 0);
  EXPECT_EQ(run({"info", folder.path("flat.yaml")}).code, 0) << "its image is beside it";
}

TEST(Example, ANameOfBeforeWritesTheSameWorldUnderThatName) {
  const Folder folder;
  const Outcome outcome = run({"example", "puma-seed", "-o", folder.path("")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("warren solve puma-seed.scene"), outcome.out.npos) << outcome.out;
  EXPECT_EQ(folder.read("puma-seed.scene"), bytes_of(worlds / "puma.scene"));
  EXPECT_EQ(run({"example"}).out.find("puma-seed"), std::string::npos) << "it is not listed";
}

TEST(Example, WhatIsThereStays) {
  const Folder folder;
  const std::vector<std::string> words{"example", "flat", "--output", folder.path("")};
  folder.write("flat.pgm", "mine");
  check({words, 2, "is another file"});
  EXPECT_EQ(folder.read("flat.pgm"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder.path("flat.yaml"))) << "all or nothing";
  std::filesystem::remove(folder.path("flat.pgm"));
  EXPECT_EQ(run(words).code, 0);
  EXPECT_EQ(run(words).code, 0) << "the same bytes are there already";
}

TEST(Example, WrongWordsAndPlacesAreRefused) {
  check({{"example", "wals"}, 2, "did you mean walls?"});
  check({{"example", "README"}, 2, "is none of"});
  check({{"example", "walls", "town"}, 2, "unexpected argument"});
  check({{"example", "walls", "-o", "/nowhere/at/all"}, 73, "can't be written"});
}

}  // namespace
}  // namespace warren::test
