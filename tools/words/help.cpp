// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/help.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/words/build_facts.hpp"
#include "tools/words/option_groups.hpp"

namespace warren::tools {
namespace {

constexpr std::size_t left_width = 30;  // of options and verbs

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
    return "a file (scene text, walls, polygons, a map, a maze; its content decides), - for standard input, or "
           "maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F]";
  }
  if (operand == "ROADMAP") return "a file that 'warren build' or '--save-roadmap' has written";
  if (operand == "ANSWER.json") return "what 'warren solve --json' has written";
  if (operand == "FILE.scen") return "a scenario file of Moving AI";
  if (operand == "SHELL") return "bash, zsh or fish";
  if (operand == "FILE") return "a world or a roadmap";
  if (operand == "[COMMAND]") return "one of the commands of 'warren help'";
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
         "\n'warren help COMMAND' tells a command's options, 'man warren' what WORLD may be. Try:\n\n"
         "  warren example parking-lot                  writes a world to try things on\n"
         "  warren solve maze:41x41 --svg maze.svg      solves one that it makes, and draws it\n\n"
         "Exit codes: 0 success, 1 no path or refuted, 2 usage, 65 bad data, 66 unreadable input, 70 bug,\n"
         "73 unwritable output, 124 budget of time or memory reached, 129, 130 and 143 interrupted.\n";
}

std::string command_help(const Command& command, std::size_t width) {
  constexpr std::size_t narrowest = 60;
  width = std::max(width, narrowest);
  const std::string operands = command.operands.empty() ? "" : fmt::format(" {}", command.operands);
  std::string text = fmt::format("warren {}: {}\n\nUsage: warren {}{} [options]\n", command.name, command.summary,
                                 command.name, operands);
  for (const std::string& operand : words_of(command.operands)) {
    if (const auto meaning = meaning_of(operand); !meaning.empty()) text += '\n' + entry(operand, meaning, width);
  }
  for (const auto& [title, options] : grouped_options(command)) {
    text += fmt::format("\n{}:\n", title);
    for (const OptionSpec* option : options) text += entry(option_usage(*option), option_text(*option), width);
  }
  return text + '\n' + entry("--help", "this text", width);
}

std::string version_text(std::string_view commit) {
  return fmt::format(
      "warren " WARREN_VERSION
      "\ncommit {}\nbuilt by {}\nfor {}\nLicense BSD-3-Clause. There is no warranty, to the extent permitted by law.\n",
      commit, build_compiler(), build_instruction_sets());
}

}  // namespace warren::tools
