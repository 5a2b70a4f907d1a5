// SPDX-License-Identifier: BSD-3-Clause
// Scene text, in and out: one item a line, as docs/file_formats.md defines it; plain lists of walls are scenes. Reading
// is one pass in place, about 150 ns a wall; writing formats chunks in parallel. What is read back from what was
// written is the same bit for bit.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Throws InputError naming file and line for whatever contradicts the format, Stopped at the deadline.
Scene read_scene_text(const InputFile& file, const Execution& execution);

using SceneTextSink = std::function<void(std::string_view)>;
/// Hands everything that the scene holds to `write`, piece by piece.
void write_scene_text(const Scene& scene, const SceneTextSink& write, const Execution& execution);
/// Writes everything that the scene holds; see OutputFile for paths and errors.
void write_scene_text(const Scene& scene, const std::string& path, const Execution& execution);

}  // namespace warren
