// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/help.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "tools/words/build_facts.hpp"
#include "tools/words/closest_match.hpp"
#include "tools/words/option_groups.hpp"
#include "tools/words/other_names.hpp"

namespace warren::tools {
namespace {

constexpr std::size_t left_width = 30;  // of options and verbs
constexpr std::size_t narrowest = 60;

/// Broken at blanks into lines from `indent` on, but for the first, which goes on where the text stands.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  const std::size_t room = std::max(width, indent + 30) - indent;
  std::string out;
  std::size_t column = 0;
  for (const std::string& word : words_of(text)) {
    if (column > 0 && column + 1 + word.size() > room) {
      out.append("\n").append(indent, ' ');
      column = 0;
    }
    out.append(column > 0 ? " " : "").append(word);
    column += (column > 0 ? 1 : 0) + word.size();
  }
  return out + '\n';
}

/// Two columns; what is too wide for the left one has a line of its own.
std::string entry(std::string_view left, std::string_view right, std::size_t width) {
  std::string text = fmt::format("  {:<{}}", left, left_width - 2);
  if (left.size() + 4 > left_width) text.append("\n").append(left_width, ' ');
  return text + wrapped(right, left_width, width);
}

std::string option_text(const OptionSpec& option) {
  std::string text{option.help};
  if (!option.choices.empty()) text.append(option.is_list ? "; of: " : "; one of: ").append(option.choices);
  return text;
}

std::string option_entry(const OptionSpec& option, std::size_t width) {
  return entry(option_usage(option), option_text(option), width);
}

std::string most_used_text(const Command& command, std::string_view names, std::size_t width) {
  std::string text = fmt::format("\nMost used, of {} options:\n", command.options.size());
  for (const std::string& name : words_of(names)) text += option_entry(*option_named(command, name), width);
  return text;
}

std::string examples_text(const Command& command) {
  std::string text = "\nExamples:\n";
  for (const HelpExample& example : help_examples(command.name)) {
    text += fmt::format("  {}\n      {}\n", example.command, example.does);
  }
  return text;
}

/// Options of that name, a text each with the verbs that have it so; and those that take it as a value.
std::string options_about(std::string_view word, std::span<const Command> commands, std::size_t width) {
  const std::string name = word.starts_with('-') ? std::string{word} : fmt::format("--{}", word);
  std::vector<std::pair<std::string, std::string>> entries;  // text, verbs
  for (const Command& command : commands) {
    for (const OptionSpec& option : command.options) {
      const std::vector<std::string> choices = words_of(option.choices);
      const bool is_value = std::find(choices.begin(), choices.end(), word) != choices.end();
      if (!is_value && &option != option_named(command, name)) continue;
      const std::string text = option_entry(option, width);
      auto known = std::find_if(entries.begin(), entries.end(), [&](const auto& each) { return each.first == text; });
      if (known == entries.end()) known = entries.insert(known, {text, "in: warren"});
      known->second.append(" ").append(command.name);
    }
  }
  std::string text;
  for (const auto& [option, verbs] : entries) text += option + entry("", verbs, width);
  return text;
}

}  // namespace

void add_options(std::vector<OptionSpec>& to, std::span<const OptionSpec> more,
                 std::initializer_list<std::string_view> without) {
  for (const OptionSpec& option : more) {
    if (std::find(without.begin(), without.end(), option.name) == without.end()) to.push_back(option);
  }
}

std::string option_usage(const OptionSpec& option) {
  std::string text = option.short_name.empty() ? "" : fmt::format("{}, ", option.short_name);
  text += option.name;
  if (!option.value.empty()) text.append(" ").append(option.value);
  return text + (option.is_list && option.value != "LIST" ? "[,...]" : "");
}

std::string_view meaning_of(std::string_view operand) {
  if (operand == "WORLD" || operand == "[WORLD]") {
    return "a file (scene text, walls, polygons, a map, a maze; its content decides), - for standard input, "
           "empty:WIDTHxHEIGHT, or maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F]";
  }
  if (operand == "ROADMAP") return "a file that 'warren build' or '--save-roadmap' has written";
  if (operand == "ANSWER.json") return "what 'warren solve --json' has written";
  if (operand == "FILE.scen") return "a scenario file of Moving AI";
  if (operand == "SHELL") return "bash, zsh or fish";
  if (operand == "FILE") return "a world or a roadmap";
  if (operand == "[COMMAND]") return "one of the commands of 'warren help'";
  if (operand == "[COMMAND|WORD]") return "a command, an option, or a word such as prm, footprint or timeout";
  if (operand == "[all|OPTION]") return "of a command: all of its options, or one";
  return {};
}

std::string program_help() {
  std::string text =
      "warren: motion planning by roadmaps; every path that it prints was verified\n"
      "\nUsage: warren COMMAND [operands] [options]\n";
  for (const auto& [title, commands] : grouped_commands()) {
    text += fmt::format("\n{}:\n", title);
    for (const Command* command : commands) {
      text += fmt::format("  {:<12} {}\n", command->name, command->summary);
    }
  }
  return text +
         "\n'warren help COMMAND' tells a command's options, 'warren help WORD' what an option or a word of the field "
         "is\n"
         "here, 'man warren' what WORLD may be. Try:\n\n"
         "  warren example parking-lot                  writes a world to try things on\n"
         "  warren solve maze:41x41 --picture maze.svg  solves one that it makes, and draws it\n\n"
         "Exit codes: 0 success, 1 no path or refuted, 2 usage, 65 bad data, 66 unreadable input, 70 bug,\n"
         "73 unwritable output, 124 budget of time or memory reached, 129, 130 and 143 interrupted.\n";
}

std::string command_help(const Command& command, std::size_t width, bool all) {
  width = std::max(width, narrowest);
  const std::string_view used = all ? "" : most_used_options(command.name);
  const std::string operands = command.operands.empty() ? "" : fmt::format(" {}", command.operands);
  std::string text = fmt::format("warren {}: {}\n\nUsage: warren {}{} [options]\n", command.name, command.summary,
                                 command.name, operands);
  for (const std::string& operand : words_of(command.operands)) {
    if (const auto meaning = meaning_of(operand); !meaning.empty()) text += '\n' + entry(operand, meaning, width);
  }
  for (const auto& [title, options] : grouped_options(command)) {
    if (!used.empty()) break;
    text += fmt::format("\n{}:\n", title);
    for (const OptionSpec* option : options) text += option_entry(*option, width);
  }
  if (!used.empty()) text += most_used_text(command, used, width);
  text += '\n' + entry("--help [all]", used.empty() ? "this text" : "this text, or all options", width);
  return text + examples_text(command);
}

std::string word_help(std::string_view word, std::span<const Command> commands, std::size_t width) {
  std::string text = options_about(word, commands, std::max(width, narrowest));
  if (const std::string here = other_name(word); !here.empty()) {
    text += wrapped(fmt::format("{}: {}.", word, here), 2, std::max(width, narrowest));
  }
  if (!text.empty()) return text;
  std::vector<std::string_view> known;
  for (const Command& command : commands) {
    known.push_back(command.name);
    for (const OptionSpec& option : command.options) known.push_back(option.name);
  }
  throw UsageError(fmt::format("nothing is called {}{}", word, suggestion(word, known)));
}

std::string version_text(std::string_view commit) {
  return fmt::format(
      "warren " WARREN_VERSION
      "\ncommit {}\nbuilt by {}\nfor {}\nLicense BSD-3-Clause. There is no warranty, to the extent permitted by law.\n",
      commit, build_compiler(), build_instruction_sets());
}

}  // namespace warren::tools
