// SPDX-License-Identifier: BSD-3-Clause
// Changes of a world as JSON: {"add": {"walls": [[x, y, x, y], ...], "polygons": [[[x, y], ...], ...]}, "remove": the
// same, "erase": [[x, y, reach], ...]}.
#pragma once

#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "serve/changes/scene_change.hpp"

namespace warren::serve {

/// Throws HttpError with the place of what is none, Stopped.
SceneChange read_scene_change(std::string_view json, const Execution& execution);
/// {"walls": ..., "polygons": ...}
std::string shapes_json(const DrawnShapes& shapes);

}  // namespace warren::serve
