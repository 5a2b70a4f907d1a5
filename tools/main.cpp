// SPDX-License-Identifier: BSD-3-Clause
// The program `warren`: a table of verbs (command_table.cpp). Each verb parses its words, calls the library and prints;
// what goes wrong becomes one line on standard error and an exit code here.
#include <fmt/format.h>

#include <new>
#include <string>
#include <vector>

#include "tools/screen/exit_code.hpp"
#include "tools/screen/first_pages.hpp"
#include "tools/screen/last_words.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/signals.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/told_errors.hpp"
#include "tools/verbs/completions.hpp"
#include "tools/words/build_facts.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {

namespace {

int run_command(const Command& command, std::span<const std::string> words) {
  const Arguments arguments(command, words);
  if (arguments.wants_help()) {
    print_text(command_help(command, terminal_width(), arguments.wants_all_help()));
    return exit_code::success;
  }
  check_outputs(arguments);
  return command.run(arguments);
}

int dispatch(std::span<const std::string> words) {
  if (words.empty()) {
    say_on_standard_error(program_help());
    return exit_code::usage;
  }
  if (words[0] == "--help" || words[0] == "-h") {
    print_text(program_help());
    return exit_code::success;
  }
  if (words[0] == "--version" || words[0] == "-V" || words[0] == "-v") {
    print_text(version_text(build_commit()));
    return exit_code::success;
  }
  if (words[0] == "complete") {  // asked by the scripts of `warren completion`, so no verb
    print_text(completion_lines(words.subspan(1)));
    return exit_code::success;
  }
  return run_command(command_named(words[0]), words.subspan(1));
}

std::string usage_hint(std::span<const std::string> words) {
  for (const Command& command : command_table()) {
    if (!words.empty() && words[0] == command.name) return fmt::format(" (see 'warren {} --help')", command.name);
  }
  return " (see 'warren --help')";
}

int run_program(std::span<const std::string> words) {
  return run_with_errors_told("warren", usage_hint(words), [&] { return dispatch(words); });
}

}  // namespace
}  // namespace warren::tools

int main(int argc, char** argv) {
  warren::tools::take_first_pages();
  warren::tools::hold_standard_descriptors();
  warren::tools::install_last_words();
  warren::tools::install_signal_handlers();
  try {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    return warren::tools::run_program(words);
  } catch (const std::bad_alloc&) {  // also of those who told of another error
    return warren::tools::say_memory_is_out();
  }
}
