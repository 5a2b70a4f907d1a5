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

void add_options(std::vector<OptionSpec>& to, std::span<const OptionSpec> more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::string program_help() {
  std::string text = "warren: motion planning by roadmaps; every path that it prints was verified\n\nUsage:\n";
  for (const Command& command : command_table()) {
    text += fmt::format("  {:<44} {}\n", fmt::format("warren {} {}", command.name, command.operands), command.summary);
  }
  return text +
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

std::string version_text() {
  return "warren " WARREN_VERSION "\nLicense BSD-3-Clause. There is no warranty, to the extent permitted by law.\n";
}

}  // namespace warren
