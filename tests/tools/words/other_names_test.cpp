// SPDX-License-Identifier: BSD-3-Clause
// Words of the field: each is answered wherever one types it, by what there is; and what is no word of it and no
// misspelling gets no suggestion.
#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "solve/question/solve_options.hpp"
#include "tests/refusals.hpp"
#include "tests/tools/process.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"
#include "tools/words/option_values.hpp"

namespace warren::test {
namespace {

using tools::OtherName;

std::vector<std::string> names_of(const OtherName& row) {
  std::vector<std::string> names;
  std::istringstream list{std::string(row.names)};
  for (std::string name; std::getline(list >> std::ws, name, ',');) {
    std::erase(name, '\\');
    names.push_back(name);
  }
  return names;
}

bool contains(const std::string& text, const std::string& part) {
  std::string flat;
  for (const char c : text) {
    if (c != ' ' && c != '\n') flat += c;
  }
  std::string wanted;
  for (const char c : part) {
    if (c != ' ') wanted += c;
  }
  return flat.find(wanted) != std::string::npos;
}

TEST(OtherNames, EachIsAnsweredByHelpAsAnOptionAsAVerbAndAsAPlanner) {
  std::set<std::string> seen;
  for (const OtherName& row : tools::other_names()) {
    for (const std::string& name : names_of(row)) {
      SCOPED_TRACE(name);
      EXPECT_TRUE(seen.insert(name).second) << "is there twice";
      const std::string here = tools::other_name(name);
      ASSERT_FALSE(here.empty());
      EXPECT_TRUE(contains(tools::word_help(name, tools::command_table(), 80), here));
      std::string option = "--" + name;
      std::replace(option.begin(), option.end(), ' ', '-');
      EXPECT_EQ(tools::other_name(option), here);
      const std::vector<std::string> words{"maze:5x5", option};
      EXPECT_TRUE(
          contains(test::refusal<UsageError>([&] { tools::Arguments(tools::command_named("solve"), words); }), here));
      EXPECT_TRUE(
          contains(test::refusal<UsageError>([&] { tools::choice_value<PlannerKind>("--planner", name); }), here));
      EXPECT_TRUE(contains(test::refusal<UsageError>([&] { tools::command_named(name); }), here));
    }
  }
  EXPECT_GT(seen.size(), 150U);
}

TEST(OtherNames, AnswersNameOptionsAndVerbsThatThereAre) {
  std::set<std::string> options;
  std::set<std::string> verbs;
  for (const tools::Command& command : tools::command_table()) {
    verbs.emplace(command.name);
    for (const tools::OptionSpec& option : command.options) options.emplace(option.name);
  }
  for (const OtherName& row : tools::other_names()) {
    std::istringstream parts{std::string(row.here)};
    bool is_typed = false;
    for (std::string part; std::getline(parts, part, '`'); is_typed = !is_typed) {
      if (!is_typed) continue;
      const std::vector<std::string> words = tools::words_of(part);
      for (const std::string& word : words) EXPECT_TRUE(!word.starts_with("--") || options.contains(word)) << word;
      EXPECT_TRUE(words[0] != "warren" || verbs.contains(words[1])) << part;
    }
  }
}

TEST(OtherNames, AreTypedAsPeopleTypeThem) {
  const std::vector<Case> cases{
      {{"solve", "maze:5x5", "--footprint", "1"}, 2, "unknown option --footprint; --robot \"[[X, Y], ...]\""},
      {{"solve", "maze:5x5", "-o", "x.svg"}, 2, "--picture FILE"},
      {{"solve", "maze:5x5", "--planner", "RRT*"}, 2, "--planner rrt-star is the textbook's"},
      {{"solve", "maze:5x5", "--planner", "Informed_RRTstar"}, 2, "--planner informed-rrt-star"},
      {{"solve", "maze:5x5", "--planner", "prm-star"}, 2, "--planner prm --neighbours star"},
      {{"solve", "maze:5x5", "--planner", "lazy-prm-star"}, 2, "--planner lazy-prm --neighbours star"},
      {{"solve", "maze:5x5", "--planner", "RRT#"}, 2, "--planner anytime"},
      {{"solve", "maze:5x5", "--planner", "BITstar"}, 2, "--planner anytime"},
      {{"compare", "maze:5x5", "--planners", "prm,CForest"}, 2, "--planner anytime --threads N"},
      {{"compare", "maze:5x5", "--convergence-plot", "a.svg"}, 2, "--curves FILE.svg"},
      {{"solve", "maze:5x5", "--max-iterations", "9"}, 2, "--iterations N"},
      {{"solve", "maze:5x5", "--planner", "fmt-star"}, 2, "--neighbours star"},
      {{"solve", "maze:5x5", "--planner", "RRT"}, 2, "did you mean rrt?"},
      {{"compare", "maze:5x5", "--planners", "prm,D*_Lite"}, 2, "warren update"},
      {{"solve", "maze:5x5", "--Planner", "prm"}, 2, "did you mean --planner?"},
      {{"solve", "maze:5x5", "--optim"}, 2, "did you mean --optimise?"},
      {{"plan", "maze:5x5"}, 2, "unknown command plan; warren solve WORLD"},
      {{"help", "D* Lite"}, 0, ""},
      {{"help", "dynamic", "window"}, 0, ""},
      {{"help", "obstacles"}, 0, ""},
      {{"help", "tolerence"}, 2, "nothing is called tolerence; did you mean tolerance? --goal-tolerance R"},
      {{"help", "dijsktra"}, 2, "did you mean dijkstra?"},
      {{"help", "Latice"}, 2, "did you mean lattice?"},
      {{"solve", "maze:5x5", "--infaltion", "1"}, 2, "did you mean inflation? --clearance R"},
      {{"solve", "maze:5x5", "--wheelbase", "1"}, 2, "--turning-radius R"},
      {{"help", "nonsense", "word"},
       2,
       "nothing is called nonsense word; docs/other_names.md lists words (see 'warren --help')"},
      {{"maze:41x41"}, 2, "to find a path in a world: warren solve maze:41x41"},
      {{"map.yaml"}, 2, "warren solve map.yaml"},
      {{"man", "nosuch"}, 2, "unknown command nosuch"},
      {{"largest", "--step", "5"}, 2, "--step: is called --precision"},
  };
  for (const Case& c : cases) check(c);
}

TEST(OtherNames, NothingIsSuggestedForWhatIsFarFromAllThatThereIs) {
  for (const std::string word : {"--banana", "--qx", "--zzzz", "--no", "--tolerate-it"}) {
    const std::string said = run({"solve", "maze:5x5", word}).err;
    EXPECT_NE(said.find("unknown option " + word + " (see"), std::string::npos) << said;
  }
  EXPECT_EQ(run({"solve", "maze:5x5", "--planner", "all"}).err.find("did you mean"), std::string::npos);
  EXPECT_EQ(run({"help", "nosuch"}).err.find("did you mean"), std::string::npos);
}

TEST(OtherNames, BothSpellingsOfAnOptionAreTheSame) {
  const Folder folder;
  const std::vector<std::string> ours{"solve", "maze:9x9", "--optimise", "--neighbours", "6", "--color", "never"};
  const std::vector<std::string> theirs{"solve", "maze:9x9", "--optimize", "--neighbors=6", "--colour", "never"};
  const std::vector<std::string> json{"--json", "-", "--no-path"};
  const Outcome first = run(joined(ours, json));
  ASSERT_EQ(first.code, 0) << first.err;
  const auto hash = [](const std::string& text) { return text.substr(text.find("path_hash"), 40); };
  EXPECT_EQ(hash(run(joined(theirs, json)).out), hash(first.out));
  for (const std::string option : {"--picture", "--svg"}) {
    EXPECT_EQ(run({"solve", "maze:9x9", option, folder.path(option + ".svg"), "--quiet"}).code, 0);
    EXPECT_EQ(run({"solve", "maze:9x9", option, folder.path(option + ".png"), "--quiet"}).code, 0);
  }
  EXPECT_EQ(folder.read("--picture.png"), folder.read("--svg.png"));
  check({{"solve", "maze:9x9", "--svg", "a.svg", "--picture", "b.svg"}, 2, "--picture: given twice"});
  check({{"build", "maze:9x9", "-o", "x", "--optimize"}, 2, "--optimize: is for a question"});
}

TEST(OtherNames, ThePageHasFortyRowsThatAreSentencesAndNoRowIsLost) {
  std::istringstream page(std::string(tools::other_names_page().front().bytes));
  std::size_t rows = 0;
  for (std::string line; std::getline(page, line);) rows += line.starts_with("| ") && line.ends_with(". |") ? 1 : 0;
  EXPECT_EQ(tools::other_names().size(), rows);
  EXPECT_GE(rows, 40U);
}

}  // namespace
}  // namespace warren::test
