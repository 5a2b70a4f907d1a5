// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/help.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace warren {
namespace {

std::string left_column(const OptionSpec& option) {
  std::string text = option.short_name.empty() ? "" : fmt::format("{}, ", option.short_name);
  text += option.name;
  if (!option.value.empty()) text.append(" ").append(option.value);
  return text;
}

}  // namespace

void add_options(std::vector<OptionSpec>& to, std::span<const OptionSpec> more,
                 std::initializer_list<std::string_view> without) {
  for (const OptionSpec& option : more) {
    if (std::find(without.begin(), without.end(), option.name) == without.end()) to.push_back(option);
  }
}

std::string program_help() {
  return "warren: motion planning by roadmaps; every path that it prints was verified\n\nUsage:\n" +
         text_of_commands([](const Command& c) {
           return fmt::format("  {:<44} {}\n", fmt::format("warren {} {}", c.name, c.operands), c.summary);
         }) +
         "\nWORLD is a file, - for standard input, or maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F].\n"
         "'warren COMMAND --help' lists a command's options. Example:\n\n"
         "  warren solve maze:41x41 --svg maze.svg --json maze.json\n\n"
         "Exit codes: 0 success, 1 no path or refuted, 2 usage, 65 bad data, 66 unreadable input, 70 bug,\n"
         "73 unwritable output, 124 budget of time or memory reached, 129, 130 and 143 interrupted.\n";
}

std::string command_help(const Command& command) {
  std::string text =
      fmt::format("{}\n\nUsage: warren {} {} [options]\n\nOptions:\n", command.summary, command.name, command.operands);
  std::size_t width = 0;
  for (const OptionSpec& option : command.options) width = std::max(width, left_column(option).size());
  for (const OptionSpec& option : command.options) {
    text += fmt::format("  {:<{}}  {}\n", left_column(option), width, option.help);
    if (!option.choices.empty()) text += fmt::format("  {:<{}}  one of: {}\n", "", width, option.choices);
  }
  return text + fmt::format("  {:<{}}  {}\n", "--help", width, "this text");
}

std::string text_of_commands(const std::function<std::string(const Command&)>& head,
                             const std::function<std::string(const Command&, const OptionSpec&)>& line,
                             std::string_view foot) {
  std::string text;
  for (const Command& command : command_table()) {
    text += head(command);
    for (const OptionSpec& option : command.options) text += line ? line(command, option) : "";
    text += foot;
  }
  return text;
}

std::string version_text() {
  return "warren " WARREN_VERSION "\nLicense BSD-3-Clause. There is no warranty, to the extent permitted by law.\n";
}

}  // namespace warren
