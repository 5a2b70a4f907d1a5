// SPDX-License-Identifier: BSD-3-Clause
// What help and manual pages say, of all verbs: the same wherever one asks, in groups, in lines that fit.
#include <set>

#include "tests/tools/process.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"
#include "tools/words/option_groups.hpp"

namespace warren::test {
namespace {

TEST(Help, OfAVerbIsTheSameByBothWays) {
  for (const tools::Command& command : tools::command_table()) {
    const std::string name{command.name};
    const Outcome by_verb = run({"help", name});
    EXPECT_EQ(by_verb.code, 0) << name;
    EXPECT_EQ(by_verb.out, run({name, "--help"}).out) << name;
    EXPECT_NE(by_verb.out.find("Usage: warren " + name), std::string::npos);
  }
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  check({{"help", "slove"}, 2, "did you mean solve?"});
}

TEST(Help, NamesEveryOptionOnceInAGroupAndEveryVerbOnce) {
  for (const tools::Command& command : tools::command_table()) {
    std::multiset<std::string_view> names;
    for (const auto& [title, options] : tools::grouped_options(command)) {
      EXPECT_FALSE(options.empty()) << title;
      for (const tools::OptionSpec* option : options) names.insert(option->name);
    }
    for (const tools::OptionSpec& option : command.options) EXPECT_EQ(names.count(option.name), 1U) << option.name;
    EXPECT_EQ(names.size(), command.options.size()) << command.name;
  }
  std::size_t verbs = 0;
  for (const auto& [title, commands] : tools::grouped_commands()) verbs += commands.size();
  EXPECT_EQ(verbs, tools::command_table().size());
}

TEST(Help, LinesFitTheScreen) {
  for (const tools::Command& command : tools::command_table()) {
    std::istringstream text(tools::command_help(command, 80));
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80U) << line;
  }
}

TEST(Help, BuildListsOnlyWhatItTakes) {
  const std::string text = run({"build", "--help"}).out;
  for (const char* option : {"--via", "--goal-bias", "--cell", "--search", "--optimise", "rrt"}) {
    EXPECT_EQ(text.find(std::string{option} + " "), std::string::npos) << option;
  }
  check({{"build", "maze:5x5", "-o", "x.roadmap", "--nodes", "9"}, 2, "can't be kept; 'warren solve' takes it"});
  check({{"build", "maze:5x5", "-o", "x.roadmap", "--search", "bfs"}, 2, "'warren query' takes it"});
}

TEST(Help, ManualHasAPageAVerb) {
  const Folder folder;
  EXPECT_EQ(run({"man", "--folder", folder.path("")}).code, 0);
  for (const tools::Command& command : tools::command_table()) {
    const std::string page = folder.read("warren-" + std::string{command.name} + ".1");
    EXPECT_NE(page.find(".SH SYNOPSIS\n.B warren"), std::string::npos) << command.name;
    for (const tools::OptionSpec& option : command.options) {
      std::string name;
      for (const char c : option.name) name += c == '-' ? "\\-" : std::string(1, c);
      EXPECT_NE(page.find("\\fB" + name + "\\fR"), std::string::npos) << command.name << ' ' << option.name;
    }
  }
  EXPECT_EQ(folder.read("warren-solve.1"), run({"man", "solve"}).out);
  EXPECT_NE(folder.read("warren.1").find("warren\\-solve (1)"), std::string::npos);
  check({{"man", "solve", "--folder", "x"}, 2, "leave out solve"});
}

TEST(Help, VersionNamesCommitCompilerAndProcessor) {
  const std::string text = run({"--version"}).out;
  EXPECT_EQ(text, run({"-v"}).out);
  for (const char* line : {"\ncommit ", "\nbuilt by ", "\nfor "}) EXPECT_NE(text.find(line), std::string::npos) << line;
}

}  // namespace
}  // namespace warren::test
