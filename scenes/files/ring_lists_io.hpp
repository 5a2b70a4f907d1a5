// SPDX-License-Identifier: BSD-3-Clause
// Lists of rings, as three kinds of files have them. Rings may be open or closed, of either orientation.
//  - VisiLibity's .environment: lines `X Y`, each ring introduced by a line that begins with `//`. The first ring is
//    the outer boundary: what lies outside of it is blocked. The others are holes in the free space: obstacles.
//  - A polymap: `poly`, `1`, the number of rings, then for each the number of its corners and the corners. Free is what
//    lies inside an odd number of rings, blocked all else, in the box of all rings too.
// An outer ring alone is made of walls where it runs along its box, and of obstacles that fill the box where it does
// not; of several the outside is one obstacle with holes (scenes/scene/plane_obstacles.hpp), a little larger than their
// box, as obstacles are with free islands inside.
//  - .poly: lines `X Y`; any other line (blank, `//`, `#`, END) ends a ring. Each ring is an obstacle.
#pragma once

#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Does it begin as an environment or a polymap does?
bool is_ring_list(std::string_view bytes);

/// Throws InputError naming file and line, Stopped.
Scene read_ring_list(const InputFile& file, const Execution& execution);

}  // namespace warren
