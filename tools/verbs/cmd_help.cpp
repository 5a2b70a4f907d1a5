// SPDX-License-Identifier: BSD-3-Clause
// warren help: the verbs, or one verb's options, as its --help.
#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

int help(const Arguments& arguments) {
  const bool one = arguments.operand_count() > 0;
  print_text(one ? command_help(command_named(arguments.operand(0)), terminal_width()) : program_help());
  return exit_code::success;
}

}  // namespace

Command help_command() { return {"help", "[COMMAND]", "the commands, or the options of one", {}, help}; }

}  // namespace warren::tools
