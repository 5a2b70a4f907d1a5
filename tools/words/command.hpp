// SPDX-License-Identifier: BSD-3-Clause
// One verb of the program, as data: --help, the parser, the suggestions for misspelt words, the shell completions and
// the manual page are all made from the same table.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warren::tools {
// The words of a command line, sorted into options and operands by GNU's conventions: --name value, --name=value, -o
// value, flags, "--" ends the options, "-" is an operand. Values stay text here; option_values.hpp reads them. A parser
// of forty lines instead of a library, since help, completions, manual page and suggestions need the table anyway.

struct Command;
struct OptionSpec;

class Arguments {
 public:
  /// Throws UsageError for an unknown option (with the closest match), an option given twice, a missing value or a
  /// wrong number of operands. Words after the verb.
  Arguments(const Command& command, std::span<const std::string> words);

  /// One option alone; its name must outlive the words.
  static Arguments of(std::string_view option, std::string value);

  bool has(std::string_view option) const { return value(option).has_value(); }
  /// What was given with the option: empty for a flag, and where a value that may be missing is.
  std::optional<std::string> value(std::string_view option) const;
  /// All that was given with it, where it takes several words.
  std::vector<std::string> values(std::string_view option) const;
  /// Throws UsageError, "OPTION: WHY", where one of these is given.
  void refuse(std::initializer_list<std::string_view> options, std::string_view why) const;
  void refuse(std::span<const OptionSpec> options, std::string_view why) const;
  /// These words, but for some options.
  Arguments without(std::span<const std::string_view> options) const;
  std::string_view verb() const { return verb_; }
  const std::string& operand(std::size_t i) const { return operands_[i]; }
  std::size_t operand_count() const { return operands_.size(); }  ///< fewer than the command's where some are optional
  /// The command line as it was given, for the pictures' descriptions.
  const std::string& command_line() const { return command_line_; }
  bool wants_help() const { return wants_help_; }
  bool wants_all_help() const { return wants_all_help_; }  ///< --help all

 private:
  Arguments() = default;
  void take_option(const Command& command, std::span<const std::string> words, std::size_t& i);
  void check_operands(const Command& command) const;

  std::string_view verb_;
  std::vector<std::pair<std::string_view, std::string>> options_;  // name in the table, value
  std::vector<std::string> operands_;
  std::string command_line_;
  bool wants_help_ = false;
  bool wants_all_help_ = false;
};

/// Those between the blanks.
std::vector<std::string> words_of(std::string_view text);
bool is_among(std::string_view word, std::string_view words);

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
  bool goes_on = false;              ///< given again, its values are one, apart by semicolons
  std::string_view group = {};       ///< of help; empty: that of its name in help.hpp
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

/// All of them, one table after the other.
std::vector<OptionSpec> joined_options(std::initializer_list<std::span<const OptionSpec>> tables);
/// But for those named.
std::vector<OptionSpec> options_but(std::span<const OptionSpec> options, std::initializer_list<std::string_view> names);

// The verbs, in files cmd_NAME.cpp: update is in that of build, export of convert, largest of scale, man of help.
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

// What may follow the words of a command line that is being typed, from the table of commands: verbs, options that are
// not given yet, their values, also after "--opt=" and one by one in lists, worlds (maze: and its keys), names of
// examples, files. The shells' scripts (warren completion SHELL) ask for it and add the files themselves.

/// words: those behind the program's name, the last as far as it is typed (perhaps empty). A line a candidate, "WORD"
/// or "WORD<tab>what it is", whole words that begin with the last one; then a line of ":", of "f" for files and "d" for
/// folders that fit as well, "n" if the word goes on after the candidate, a blank, and the part of the last word that
/// stands before a file's name, such as "--json=".
std::string completion_lines(std::span<const std::string> words);

/// All verbs, in the order of --help.
const std::vector<Command>& command_table();
/// nullptr: there is none.
const Command* find_command(std::string_view name);
/// Throws UsageError, with the closest match.
const Command& command_named(std::string_view name);

}  // namespace warren::tools
