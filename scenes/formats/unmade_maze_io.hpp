// SPDX-License-Identifier: BSD-3-Clause
// Which mazes can be had tile by tile, so that their walls may be left out (is_unmade): those of a name whose algorithm
// makes each tile by itself, and those of files that are read by parts.
#pragma once

#include <optional>
#include <string>

#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// maze:ROWSxCOLS,...: the maze without its walls; nothing for algorithms that make it as a whole. Throws UsageError.
std::optional<Scene> unmade_maze(const std::string& source);

/// A file of a maze, without its walls; nothing where its format or its walls are others. Looks at its header, of an
/// array at the outline too. Throws InputError.
std::optional<Scene> unmade_maze(const InputFile& file);

}  // namespace warren
