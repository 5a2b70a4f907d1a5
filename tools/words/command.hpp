// SPDX-License-Identifier: BSD-3-Clause
// One verb of the program, as data: --help, the parser, the suggestions for misspelt words, the shell completions and
// the manual page are all made from the same table.
#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/words/arguments.hpp"

namespace warren::tools {

/// One long option. `value` names what follows it, a word each; empty for a flag. `choices` lists the words it takes,
/// blank-separated. What a value is completed with follows from its name: FILE, FOLDER and WORLD are files, folders and
/// worlds, and lower-case words between bars are words that it takes.
struct OptionSpec {
  std::string_view name;
  std::string_view value;
  std::string_view help;
  std::string_view choices = {};
  std::string_view short_name = {};  ///< e.g. "-o"
  bool value_optional = false;       ///< the next word is its value only if it is one of the choices
  bool is_list = false;              ///< it takes several, apart by commas
  bool may_repeat = false;           ///< it may be given several times
  std::string_view group = {};       ///< of help; empty: that of its name in option_groups.hpp
};

struct Command {
  std::string_view name;
  std::string_view
      operands;              ///< e.g. "WORLD ANSWER.json": one word an operand; those in brackets, last, may be missing
  std::string_view summary;  ///< one line
  std::vector<OptionSpec> options;
  std::function<int(const Arguments&)> run;  ///< returns the exit code
  /// Options of other verbs that people will look for here, and why there are none.
  std::vector<std::pair<std::string_view, std::string_view>> foreign = {};
  bool takes_any_word = false;  ///< what begins with a dash is an operand, but for --help
};

/// The option of that name or short name, by either spelling; nullptr: it has none.
const OptionSpec* option_named(const Command& command, std::string_view name);

/// Appends options that several verbs share, but for those named.
void add_options(std::vector<OptionSpec>& to, std::span<const OptionSpec> more,
                 std::initializer_list<std::string_view> without = {});

// The verbs, one a file cmd_NAME.cpp.
Command bench_scen_command();
Command build_command();
Command compare_command();
Command completion_command();
Command convert_command();
Command example_command();
Command export_command();
Command generate_command();
Command help_command();
Command info_command();
Command largest_command();
Command profile_command();
Command man_command();
Command query_command();
Command render_command();
Command scale_command();
Command serve_command();
Command solve_command();
Command update_command();
Command verify_command();

/// All verbs, in the order of --help.
const std::vector<Command>& command_table();
/// nullptr: there is none.
const Command* find_command(std::string_view name);
/// Throws UsageError, with the closest match.
const Command& command_named(std::string_view name);

}  // namespace warren::tools
