// SPDX-License-Identifier: BSD-3-Clause
// The verbs of the program; main.cpp dispatches to them.
#include <string>

#include "core/base/error.hpp"
#include "tools/words/closest_match.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

const std::vector<Command>& command_table() {
  static const std::vector<Command> table{
      solve_command(),    verify_command(),     render_command(),  compare_command(), build_command(),
      query_command(),    update_command(),     export_command(),  serve_command(),   example_command(),
      generate_command(), info_command(),       convert_command(), largest_command(), scale_command(),
      profile_command(),  bench_scen_command(), help_command(),    man_command(),     completion_command()};
  return table;
}

const Command* find_command(std::string_view name) {
  for (const Command& command : command_table()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

const Command& command_named(std::string_view name) {
  if (const Command* command = find_command(name)) return *command;
  std::vector<std::string_view> names{"--help", "--version"};
  for (const Command& command : command_table()) names.push_back(command.name);
  const std::string_view what = name.starts_with('-') ? "unknown option " : "unknown command ";
  throw UsageError(std::string{what} + std::string{name} + suggestion(name, names));
}

}  // namespace warren::tools
