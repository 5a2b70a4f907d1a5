// SPDX-License-Identifier: BSD-3-Clause
// No verb writes a file that it reads, or the same file twice. Files are compared as files (device and inode, links
// followed), what is not there yet as the name in its folder: "m.scene" is "./m.scene" and every link to it.
#pragma once

#include <optional>
#include <string>

#include "scenes/scene/scene.hpp"
#include "tools/words/arguments.hpp"

namespace warren::tools {

/// Throws UsageError where an output that the command line names is one of its inputs or another of its outputs, or
/// where standard output is to take two or standard input to give two.
void check_outputs(const Arguments& arguments);

/// The same for a file that the command line does not name such as a map's image. Empty: no file.
void check_not_written(const Arguments& arguments, const std::string& input);
/// The same for an arm's table.
void check_not_written(const Arguments& arguments, const std::optional<RobotSpec>& robot);

}  // namespace warren::tools
