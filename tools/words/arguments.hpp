// SPDX-License-Identifier: BSD-3-Clause
// The words of a command line, sorted into options and operands by GNU's conventions: --name value, --name=value, -o
// value, flags, "--" ends the options, "-" is an operand. Values stay text here; option_values.hpp reads them. A parser
// of forty lines instead of a library, since help, completions, manual page and suggestions need the table anyway.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warren::tools {

struct Command;

class Arguments {
 public:
  /// Throws UsageError for an unknown option (with the closest match), an option given twice, a missing value or a
  /// wrong number of operands. Words after the verb.
  Arguments(const Command& command, std::span<const std::string> words);

  /// One option alone; its name must outlive the words.
  static Arguments of(std::string_view option, std::string value);

  bool has(std::string_view option) const;
  /// What was given with the option: empty for a flag, and where a value that may be missing is.
  std::optional<std::string> value(std::string_view option) const;
  /// All that was given with it, where it takes several words.
  std::vector<std::string> values(std::string_view option) const;
  /// These words, but for some options.
  Arguments without(std::span<const std::string_view> options) const;
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

  std::vector<std::pair<std::string_view, std::string>> options_;  // name in the table, value
  std::vector<std::string> operands_;
  std::string command_line_;
  bool wants_help_ = false;
  bool wants_all_help_ = false;
};

/// Those between the blanks.
std::vector<std::string> words_of(std::string_view text);

}  // namespace warren::tools
