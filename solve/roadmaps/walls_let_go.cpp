// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/walls_let_go.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "solve/roadmaps/kept_cells.hpp"
#include "solve/roadmaps/maze_bits.hpp"

namespace warren {

void let_walls_go(Roadmap& roadmap, const Execution& execution) {
  if (roadmap.lattice == nullptr || !is_nothing_but_maze(roadmap.world.outline())) return;
  const LatticePassages& lattice = roadmap.lattice->passages();
  const Scene outline = without_arrays(roadmap.world.outline());
  auto make = [&lattice, outline](const Execution& on) {
    Scene scene = outline;
    scene.walls = walls_of_lattice(lattice, on);
    return scene;
  };
  auto look_up = [&lattice, maze = *outline.maze, hash = roadmap.world_hash](const Execution& on) {
    return cells_of_words("the lattice", maze, lattice.right_words(), lattice.up_words(), hash, on);
  };
  KeptWorld bits(outline, std::move(make), std::move(look_up));
  try {
    bits.looked_up(execution);
    roadmap.world = std::move(bits);
  } catch (const InputError&) {  // the walls are others, or in another order
  }
}

}  // namespace warren
