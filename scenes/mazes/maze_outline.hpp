// SPDX-License-Identifier: BSD-3-Clause
// Tells a maze by its walls alone, in whatever order and direction they come, whole or in pieces: for files that have
// no place to say what they hold.
#pragma once

#include <optional>

#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// The size of the maze of the course: all walls on its grid, and its outline closed but for the entrance in the first
/// row of the left side and the exit in the last row of the right one. Nothing for other walls. Two passes over the
/// walls, and a sort of those on the outline. Throws Stopped.
std::optional<MazeHint> maze_of_walls(const WallSet& walls, const Execution& execution);

}  // namespace warren
