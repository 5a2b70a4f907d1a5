// SPDX-License-Identifier: BSD-3-Clause
// The words of how a path is written as a file of its own, and how fast it is driven.
#pragma once

#include <span>

#include "solve/paths/path_file_io.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --path and what goes with it.
std::span<const OptionSpec> path_option_specs();
/// Throws UsageError, also for what goes with --path where that is not given.
PathFileOptions path_words(const Arguments& arguments);

}  // namespace warren::tools
