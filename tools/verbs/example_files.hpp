// SPDX-License-Identifier: BSD-3-Clause
// Files whose bytes the build puts into the program: those of examples/worlds, and the scripts of tools/completion.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/embedded_file.hpp"

namespace warren::tools {

/// By name; README.md, whose table says what to see, is one of them.
std::span<const EmbeddedFile> example_files();
/// By the shell's name.
std::span<const EmbeddedFile> completion_scripts();

/// A row of that table.
struct Example {
  std::string_view name;                ///< "flat"
  std::vector<std::string_view> files;  ///< the world's own first
  std::string_view sight;               ///< what to see
  std::string_view command;             ///< that shows it
};

/// The table, and what its names were before. Throws UsageError that lists the names.
std::vector<Example> examples();
Example example_named(std::string_view name);

/// Writes its files into the folder (empty: where one stands), those that are not there; gives the world's own. Throws
/// UsageError where another file stands in its place, WriteError.
std::string write_example_files(const Example& example, const std::string& folder);

}  // namespace warren::tools
