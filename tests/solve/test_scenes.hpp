// SPDX-License-Identifier: BSD-3-Clause
// Scenes that tests of solve/ ask: a map of these cells, a scene file of this text.
#pragma once

#include <string>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/scene.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren::test {

inline Scene scene_of(const Bitmap& blocked, double cell = 1.0, Vec2 origin = {}) {
  Scene scene;
  scene.source = "map";
  OccupancyMap& map = scene.map.emplace();
  map.blocked = blocked;
  map.cell = cell;
  map.origin = origin;
  map.occupied = blocked.count();
  map.free = blocked.size() - map.occupied;
  return scene;
}

inline Scene scene_of(const std::string& text) {
  const TemporaryDirectory folder;
  return read_world(folder.write("w.scene", text));
}

}  // namespace warren::test
