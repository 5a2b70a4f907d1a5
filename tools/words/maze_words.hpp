// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about the making of mazes.
#pragma once

#include <span>

#include "scenes/mazes/maze_generator.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --algorithm --loops, where many mazes are made.
std::span<const OptionSpec> maze_option_specs();

/// Algorithm and loops as the command line says, all else as it is in `usual`. Throws UsageError.
MazeOptions maze_words(const Arguments& arguments, MazeOptions usual = {});

}  // namespace warren::tools
