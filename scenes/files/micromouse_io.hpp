// SPDX-License-Identifier: BSD-3-Clause
// Micromouse mazes as text: posts `o`, walls `---` and `|`, S and G in the middle of cells, the top line is the north.
// 2 H + 1 lines of 4 W + 1 characters; blanks at the ends of lines may be missing. Read as a maze of unit walls. Or as
// numbers (.num): a line X Y N E S W a cell, counted from 0 in the lower left corner, 1 where a wall is; such mazes
// begin in that corner and end in one of the middle cells.
#pragma once

#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Is the first line a row of posts or a cell in numbers, as far as its first 64 KiB tell?
bool is_micromouse(std::string_view bytes);

/// Walls on the unit grid, cell centres at 1..W x 1..H, the maze hint; walls in a row are joined. Of several G the goal
/// is the one that takes the fewest cells from S, then the first in reading order. Throws InputError naming file, line
/// and what was expected; Stopped.
Scene read_micromouse(const InputFile& file, const Execution& execution);

}  // namespace warren
