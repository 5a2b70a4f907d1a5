// SPDX-License-Identifier: BSD-3-Clause
// --help and --version: made from the table of commands.
#pragma once

#include <string>
#include <string_view>

#include "tools/words/command.hpp"

namespace warren::tools {

/// The verbs, a line each.
std::string program_help();
/// The verb's options in groups, in lines of at most `width` columns (those of 60 at least).
std::string command_help(const Command& command, std::size_t width);
std::string version_text(std::string_view commit);

/// "--neighbours K|auto|star", "-o, --output FILE"; of a list "NAME[,...]" unless the name says so.
std::string option_usage(const OptionSpec& option);
/// What "WORLD", an operand or a value of that name, is; empty where the name says enough.
std::string_view meaning_of(std::string_view operand);

}  // namespace warren::tools
