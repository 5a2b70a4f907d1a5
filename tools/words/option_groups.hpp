// SPDX-License-Identifier: BSD-3-Clause
// The headings under which help and manual pages list options: what is asked, how it is solved, what is written, how
// the program runs. One table by name, since verbs share options.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "tools/words/command.hpp"

namespace warren::tools {

struct OptionGroup {
  std::string_view title;  ///< "Question"
  std::vector<const OptionSpec*> options;
};

/// The verb's options in groups, none empty: its own first, the others in the order of the table.
std::vector<OptionGroup> grouped_options(const Command& command);

/// The headings of the verbs themselves, in the order of command_table().
std::vector<std::pair<std::string_view, std::vector<const Command*>>> grouped_commands();

}  // namespace warren::tools
