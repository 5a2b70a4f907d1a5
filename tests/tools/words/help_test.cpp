// SPDX-License-Identifier: BSD-3-Clause
// What help and manual pages say, of all verbs: the same wherever one asks, in groups, in lines that fit.
#include <algorithm>
#include <set>
#include <span>

#include "tests/tools/process.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"

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
    for (const bool all : {false, true}) {
      std::istringstream text(tools::command_help(command, 80, all));
      for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80U) << line;
    }
  }
}

TEST(Help, OfACommandThatLacksOptionsOfItsNamesake) {
  tools::Command scale = *std::find_if(tools::command_table().begin(), tools::command_table().end(),
                                       [](const tools::Command& command) { return command.name == "scale"; });
  scale.options.erase(scale.options.begin() + 1, scale.options.end());
  EXPECT_NE(tools::command_help(scale, 80, false).find("Usage: warren scale"), std::string::npos);
}

TEST(Help, IsShortWhereThereAreManyOptionsAndAllIsThereWhenAsked) {
  for (const tools::Command& command : tools::command_table()) {
    const std::string name{command.name};
    const std::string text = run({"help", name}).out;
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 60) << name;
    EXPECT_NE(text.find("\nExamples:\n  warren "), std::string::npos) << name;
    const std::string all = run({name, "--help", "all"}).out;
    EXPECT_EQ(all, run({"help", name, "all"}).out);
    for (const tools::OptionSpec& option : command.options) {
      EXPECT_NE(all.find("  " + tools::option_usage(option)), std::string::npos) << name << ' ' << option.name;
    }
    const std::string_view used = tools::most_used_options(name);
    EXPECT_EQ(used.empty(), command.options.size() <= 15) << name << ' ' << command.options.size();
    for (const std::string& option : tools::words_of(used)) {
      EXPECT_NE(tools::option_named(command, option), nullptr) << name << ' ' << option;
    }
  }
}

TEST(Help, ExplainsOneOptionAndOneOfItsValues) {
  const std::string clearance = run({"help", "--clearance"}).out;
  EXPECT_NE(clearance.find("--clearance R"), std::string::npos) << clearance;
  EXPECT_NE(clearance.find("in: warren solve"), std::string::npos) << clearance;
  EXPECT_NE(run({"help", "clearance"}).out.find(clearance.substr(0, clearance.find("in: "))), std::string::npos);
  EXPECT_EQ(run({"help", "--optimize"}).out, run({"help", "--optimise"}).out);
  EXPECT_NE(run({"help", "lazy-prm"}).out.find("--planner NAME"), std::string::npos);
  const std::string seed = run({"help", "largest", "--seed"}).out;
  EXPECT_NE(seed.find("seed of the first maze"), std::string::npos) << seed;
  EXPECT_EQ(seed.find("in: warren solve"), std::string::npos) << seed;
  EXPECT_EQ(run({"help", "goal", "bias"}).out, run({"help", "--goal-bias"}).out);
  EXPECT_EQ(run({"help", "PRM"}).out, run({"help", "prm"}).out);
  const std::string either = run({"help", "clearance"}).out;
  EXPECT_LT(either.find("--clearance R"), either.find("--objective NAME")) << "the option before those that take it";
  check({{"help", "--clearence"}, 2, "did you mean --clearance?"});
  check({{"help", "solve", "--writable"}, 2, "nothing is called --writable"});
}

/// The words of a command line as a shell splits them, without the program.
std::vector<std::string> shell_words(std::string_view line) {
  std::vector<std::string> words(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ' ' && !is_quoted) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  EXPECT_EQ(words.front(), "warren");
  words.erase(words.begin());
  return words;
}

/// One after the other in one folder. Those that take long, that never end, or that need files of the user are read
/// alone.
TEST(Help, ItsExamplesWork) {
  const Folder folder;
  const auto before = std::filesystem::current_path();
  const std::set<std::string> only_read{"serve", "compare", "largest", "scale", "bench-scen"};
  for (const auto& [line, does] : tools::help_examples()) {
    const std::vector<std::string> words = shell_words(line);
    EXPECT_NO_THROW(tools::Arguments(tools::command_named(words[0]), std::span(words).subspan(1))) << line;
    if (only_read.contains(words[0]) || line.find(".csv") != line.npos) continue;
    std::filesystem::current_path(folder.path(""));
    const Outcome outcome = run(words);
    std::filesystem::current_path(before);
    EXPECT_EQ(outcome.code, 0) << line << '\n' << outcome.err;
  }
}

TEST(Help, AllIsTheCommandsAndThenAllOptionsOfEach) {
  const std::string all = run({"help", "all"}).out;
  EXPECT_EQ(all.find(run({"help"}).out), 0U);
  for (const tools::Command& command : tools::command_table()) {
    const std::string name{command.name};
    EXPECT_NE(all.find("\n\n" + run({"help", name, "all"}).out), std::string::npos) << name;
  }
}

/// Texts of help, sentence by sentence: one that is longer is read twice. What is in brackets is one word.
TEST(Help, SentencesAreShort) {
  constexpr std::size_t most_words = 30;
  for (const tools::Command& command : tools::command_table()) {
    for (const tools::OptionSpec& option : command.options) {
      std::size_t words = 0;
      bool is_inside = false;
      for (const std::string& word : tools::words_of(option.help)) {
        words += is_inside ? 0U : 1U;
        is_inside = (is_inside || word.front() == '(') && word.find(')') == std::string::npos;
        EXPECT_LE(words, most_words) << command.name << ' ' << option.name << ": " << option.help;
        if (!is_inside && (word.back() == '.' || word.back() == ';' || word.back() == ':')) words = 0;
      }
    }
  }
}

TEST(Help, BuildListsOnlyWhatItTakes) {
  const std::string text = run({"build", "--help", "all"}).out;
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
