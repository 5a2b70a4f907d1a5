// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/world_tiles.hpp"

#include <utility>

#include "solve/roadmaps/maze_bits.hpp"

namespace warren::serve {

std::unique_ptr<WorldTiles> tiles_of(const Scene& scene, const Execution& execution) {
  if (scene.map) return map_tiles(*scene.map, execution);
  if (scene.maze) {
    constexpr double no_reach = 0.0;
    if (auto passages = passages_of_maze(scene, no_reach, execution)) {
      MazeOutline outline = MazeOutline::of_walls(scene.walls, passages->size(), execution);
      return maze_tiles(std::move(*passages), std::move(outline), execution);
    }
  }
  return shape_tiles(scene, execution);
}

}  // namespace warren::serve
