// SPDX-License-Identifier: BSD-3-Clause
// warren completion bash|zsh|fish: what a shell needs to complete our words. The scripts (tools/completion, which the
// build embeds) ask the program itself, by `warren complete WORDS` (tools/words/command.hpp), and add the names of
// files, which shells know better.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/base/printable.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/verbs/example_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr std::string_view shells[] = {"bash", "zsh", "fish"};

// Bash splits words at "=" and ":" where COMP_WORDBREAKS has them, and replaces only what stands behind the last of
// these: words are joined again as they stand in the line, and what bash keeps is cut off the answers.
int completion(const Arguments& arguments) {
  const std::string_view shell = shells[choice_value("SHELL", arguments.operand(0), shells)];
  print_text(std::ranges::find(completion_scripts(), shell, &EmbeddedFile::name)->bytes);
  return exit_code::success;
}

struct Candidates {
  std::string typed;  ///< the word so far
  std::string lines;
  bool files = false;
  bool folders = false;
  bool goes_on = false;
  std::string before_file;  ///< what of the word stands before a file's name

  void add(const std::string& word, std::string_view help = {}) {
    if (!word.starts_with(typed)) return;
    lines += help.empty() ? word + '\n' : fmt::format("{}\t{}\n", word, help);
  }
  std::string text() const {
    return fmt::format("{}:{}{}{} {}\n", lines, files ? "f" : "", folders ? "d" : "", goes_on ? "n" : "", before_file);
  }
};

/// "maze:", "maze:5x7,seed=", "maze:5x7,algorithm=wilson": what follows once the size is said. `before` is an option
/// and its sign of equality, or nothing.
void add_maze(Candidates& to, const std::string& before) {
  const std::string typed = to.typed.substr(before.size());
  constexpr std::string_view scheme = "maze:";
  if (!typed.starts_with(scheme)) {
    to.add(before + std::string{scheme}, "a maze from a seed: ROWSxCOLS follow");
    to.goes_on = scheme.starts_with(typed) && !typed.empty();
    return;
  }
  const std::size_t size_end = std::min(typed.find(','), typed.size());
  if (typed.find('x') == std::string::npos || std::isdigit(static_cast<unsigned char>(typed[size_end - 1])) == 0)
    return;
  const std::size_t comma = typed.rfind(',');
  const std::string done = before + (comma == std::string::npos ? typed : typed.substr(0, comma));
  for (const std::string& name : words_of(maze_option_specs().front().choices)) {
    to.add(fmt::format("{},algorithm={}", done, name));
  }
  if (!to.lines.empty() && to.typed.starts_with(done + ",algorithm=")) return;
  to.lines.clear();
  for (const std::string_view key : {"seed", "algorithm", "loops"}) {
    if (done.find(fmt::format(",{}=", key)) == std::string::npos) to.add(fmt::format("{},{}=", done, key));
  }
  to.goes_on = true;
}

void add_world(Candidates& to, const std::string& before = {}) {
  add_maze(to, before);
  to.files = !to.typed.substr(before.size()).starts_with("maze:");
  to.before_file = before;
}

/// One of the words, or the next of a list of them.
void add_choices(Candidates& to, const OptionSpec& option, const std::string& before) {
  const std::string typed = to.typed.substr(before.size());
  const std::size_t comma = option.is_list ? typed.rfind(',') : std::string::npos;
  const std::string done = comma == std::string::npos ? "" : typed.substr(0, comma + 1);
  for (const std::string& word : words_of(option.choices)) {
    if (("," + done).find("," + word + ",") == std::string::npos) to.add(before + done + word);
  }
}

/// What the option's k-th value may be; `before` as above.
void add_value(Candidates& to, const OptionSpec& option, std::size_t k, const std::string& before = {}) {
  if (!option.choices.empty()) return add_choices(to, option, before);
  const std::string name = words_of(option.value)[k];
  if (name == "WORLD") return add_world(to, before);
  to.files = name == "FILE" || name == "STARTS" || name == "GOALS";
  to.folders = name == "FOLDER";
  to.before_file = before;
  for (const std::string_view word : split(name, "|")) {  // of "K|auto|star" auto and star
    if (std::ranges::all_of(word, [](unsigned char c) { return std::islower(c) != 0; }))
      to.add(before + std::string(word));
  }
}

void add_operand(Candidates& to, const Command& command, std::size_t at, const std::vector<std::string>& given) {
  const std::vector<std::string> operands = words_of(command.operands);
  if (at >= operands.size()) return;
  const std::string& name = operands[at];
  if (name == "WORLD" || name == "[WORLD]") return add_world(to);
  if (name == "FILE" && (command.name == "info" || command.name == "render")) return add_world(to);
  if (name == "SHELL") {
    for (const std::string_view shell : shells) to.add(std::string(shell));
  } else if (name.starts_with("[COMMAND")) {
    for (const Command& each : command_table()) to.add(std::string{each.name}, each.summary);
  } else if (name == "[NAME]") {
    std::set<std::string> names;  // of worlds, which may have several files
    for (const EmbeddedFile& file : example_files()) names.emplace(file.name.substr(0, file.name.find('.')));
    names.erase("README");
    for (const std::string& each : names) to.add(each);
  } else if (name == "maze|polygons") {
    to.add("maze", "ROWSxCOLS");
    to.add("polygons", "COUNT");
  } else {
    to.files = given.empty() || given.front() != "generate";
  }
}

/// The words behind the verb, all but the last: which options are given, and what the last one is.
struct Parsed {
  std::set<std::string_view> given;
  std::size_t operands = 0;
  const OptionSpec* pending = nullptr;  ///< of this option
  std::size_t value = 0;                ///< the last word is that value
  bool options_ended = false;
};

Parsed parsed(const Command& command, std::span<const std::string> words) {
  Parsed p;
  for (const std::string& word : words) {
    if (p.pending != nullptr) {
      if (++p.value == words_of(p.pending->value).size()) p.pending = nullptr;
    } else if (p.options_ended || word.size() < 2 || word[0] != '-') {
      ++p.operands;
    } else if (word == "--") {
      p.options_ended = true;
    } else if (const OptionSpec* option = option_named(command, word.substr(0, word.find('=')))) {
      p.given.insert(option->name);
      if (!option->value.empty() && word.find('=') == std::string::npos) p.pending = option;
      p.value = 0;
    }
  }
  return p;
}

}  // namespace

Command completion_command() {
  return {"completion", "SHELL", "print completions for bash, zsh or fish", {}, completion};
}

std::string completion_lines(std::span<const std::string> words) {
  Candidates to;
  if (words.empty()) return to.text();
  to.typed = words.back();
  if (words.size() == 1) {
    for (const Command& command : command_table()) to.add(std::string{command.name}, command.summary);
    if (to.typed.starts_with('-')) to.add("--help"), to.add("--version");
    return to.text();
  }
  const Command* command = find_command(words[0]);
  if (command == nullptr) return to.text();
  const Parsed p = parsed(*command, words.subspan(1, words.size() - 2));
  const std::size_t equals = to.typed.starts_with("--") ? to.typed.find('=') : std::string::npos;
  if (p.pending != nullptr && !p.pending->value_optional) {
    add_value(to, *p.pending, p.value);
  } else if (equals != std::string::npos && !p.options_ended) {
    const OptionSpec* option = option_named(*command, to.typed.substr(0, equals));
    if (option != nullptr && !option->value.empty()) add_value(to, *option, 0, to.typed.substr(0, equals + 1));
  } else if (to.typed.starts_with('-') && !p.options_ended) {
    for (const OptionSpec& option : command->options) {
      if (!p.given.contains(option.name)) to.add(std::string{option.name}, option.help);
    }
    to.add("--help", "this command's options");
  } else {
    if (p.pending != nullptr) add_value(to, *p.pending, 0);
    add_operand(to, *command, p.operands, {words.begin(), words.end()});
  }
  return to.text();
}

}  // namespace warren::tools
