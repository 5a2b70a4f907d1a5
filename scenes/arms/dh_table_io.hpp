// SPDX-License-Identifier: BSD-3-Clause
// Denavit-Hartenberg tables as text: one item a line, `#` starts a comment, blanks or commas separate.
//
//   convention standard|modified          default standard
//   angles radians|degrees                of all joint lines; default radians
//   joint D A ALPHA LOW HIGH [OFFSET]     from the base to the tip, 1 to 6 of them
//   tool X Y Z                            of the last frame; default 0 0 0
#pragma once

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Throws InputError naming file and line, Stopped.
DhTable read_dh_table(const InputFile& file, const Execution& execution);

}  // namespace warren
