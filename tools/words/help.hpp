// SPDX-License-Identifier: BSD-3-Clause
// --help and --version, and texts of all commands: all made from the table of commands.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "tools/words/command.hpp"

namespace warren {

std::string program_help();
std::string command_help(const Command& command);
std::string version_text();

/// The table, command by command: `head`, a line an option (without --help), `foot`.
std::string text_of_commands(const std::function<std::string(const Command&)>& head,
                             const std::function<std::string(const Command&, const OptionSpec&)>& line = nullptr,
                             std::string_view foot = "");

}  // namespace warren
