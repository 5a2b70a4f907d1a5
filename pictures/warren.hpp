// SPDX-License-Identifier: BSD-3-Clause
// All that a program needs that asks for paths: worlds read and made, questions, answers, pictures of them; roadmaps
// that are kept and asked again. Installed as <warren/warren.hpp>.
#pragma once

#include "core/base/error.hpp"                 // IWYU pragma: export
#include "pictures/draw_answer.hpp"            // IWYU pragma: export
#include "scenes/files/read_world_io.hpp"      // IWYU pragma: export
#include "scenes/mazes/maze_generator.hpp"     // IWYU pragma: export
#include "scenes/scene/polygon_generator.hpp"  // IWYU pragma: export
#include "solve/answer/read_answer_io.hpp"     // IWYU pragma: export
#include "solve/answer/write_answer_io.hpp"    // IWYU pragma: export
#include "solve/kept/export_roadmap.hpp"       // IWYU pragma: export
#include "solve/kept/roadmap_file_io.hpp"      // IWYU pragma: export
#include "solve/kept/roadmap_query.hpp"        // IWYU pragma: export
#include "solve/solve.hpp"                     // IWYU pragma: export

/// All of the library. Where nothing else is said, functions may be called by any number of threads at once, values
/// belong to one thread at a time, and lengths are in the units of the world.
namespace warren {}
