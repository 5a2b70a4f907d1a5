// SPDX-License-Identifier: BSD-3-Clause
// Mazes as images (PNG, PGM): dark pixels (grey below 128, transparent ones over white) are walls. The single bright
// pixel of the first row is the entrance, that of the last row the exit; where there isn't exactly one, start and goal
// are left open.
#pragma once

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// A pixel is a cell of side 1, the lower left corner of the image is (0, 0). Throws InputError, Stopped.
OccupancyMap read_maze_image(const InputFile& file, const Execution& execution);

}  // namespace warren
