// SPDX-License-Identifier: BSD-3-Clause
// warren help: the verbs; one verb's options, as its --help; all options of all; or what an option or a word of the
// field is here.
#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

std::string help_of_all() {
  std::string text = program_help();
  for (const Command& command : command_table()) text += "\n\n" + command_help(command, terminal_width(), true);
  return text;
}

std::string help_text(const Arguments& arguments) {
  if (arguments.operand_count() == 0) return program_help();
  const std::string& word = arguments.operand(0);
  const bool is_more = arguments.operand_count() > 1;
  if (!is_more && (word == "all" || word == "--all")) return help_of_all();
  const bool is_all = is_more && (arguments.operand(1) == "all" || arguments.operand(1) == "--all");
  if (is_more && !is_all && find_command(word) == nullptr) {  // a word of two, such as potential field
    return word_help(word + ' ' + arguments.operand(1), command_table(), terminal_width());
  }
  if (is_more && !is_all) return word_help(arguments.operand(1), {&command_named(word), 1}, terminal_width());
  if (const Command* command = find_command(word)) return command_help(*command, terminal_width(), is_all);
  return word_help(word, command_table(), terminal_width());
}

int help(const Arguments& arguments) {
  print_text(help_text(arguments));
  return exit_code::success;
}

}  // namespace

Command help_command() {
  Command command{"help", "[COMMAND|WORD] [all|OPTION]", "explain a command, an option or a word", {}, help};
  command.takes_any_word = true;
  return command;
}

}  // namespace warren::tools
