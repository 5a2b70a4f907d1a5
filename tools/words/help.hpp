// SPDX-License-Identifier: BSD-3-Clause
// --help and --version, made from the table of commands.
#pragma once

#include <string>

#include "tools/words/command.hpp"

namespace warren {

std::string program_help();
std::string command_help(const Command& command);
std::string version_text();

}  // namespace warren
