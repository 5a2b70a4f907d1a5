// SPDX-License-Identifier: BSD-3-Clause
// What a unit of a scene's coordinates is called, where its file says so.
#pragma once

#include <string_view>

#include "scenes/scene/scene.hpp"

namespace warren {

/// "cells" of mazes, of Moving AI's maps and of images, "m" of maps of map_server; "": nobody says.
inline std::string_view unit_of(const Scene& scene) {
  if (scene.maze) return "cells";
  if (!scene.map) return {};
  return scene.map->format == MapFormat::ros ? "m" : "cells";
}

/// " m" behind lengths that are metres; nothing behind others, whose unit is that of all coordinates.
inline std::string_view metres_behind(std::string_view unit) { return unit == "m" ? " m" : ""; }

}  // namespace warren
