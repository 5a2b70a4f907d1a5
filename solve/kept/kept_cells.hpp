// SPDX-License-Identifier: BSD-3-Clause
// The walls of a kept maze as its judge looks them up: by bits of the file, read by code of verify/ and held against
// the world's hash, or by bits of its own. Some milliseconds or a second once, at 10^8 cells; then each look is free.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "verify/streamed/looked_up_walls.hpp"

namespace warren {

/// Immutable; any number of threads may look.
struct KeptCells {
  /// Looks for a wall on each side of the rim.
  KeptCells(std::unique_ptr<const LookedUpWalls> cells, std::size_t count);
  /// The walls around the cells that meet a box, unit by unit, and some of the rim: what a scene of them all says of
  /// motions in the box, this one does.
  Scene walls_in(const Box& box) const;

  std::unique_ptr<const LookedUpWalls> walls;  ///< as the judge sees them
  std::size_t wall_count;                      ///< of the world: not of units
 private:
  std::vector<Segment> rim_;  // a unit of each side: the reference point stays in the box of all walls
};

/// Is the world inside a maze whose walls stand wherever its lattice has no passage, and nothing else?
bool walls_are_passages(const RoadmapFile& file, const Scene& outline);
/// Is it a maze, and nothing else?
bool is_nothing_but_maze(const Scene& scene);
/// Of such a file, which must outlive it. Throws InputError for a world of another hash, Stopped.
std::unique_ptr<KeptCells> cells_of_file(const RoadmapFile& file, MazeHint maze, const std::string& hash,
                                         const Execution& execution);
/// Of the words of a lattice, which must outlive it; `where` names them. Throws as above.
std::unique_ptr<KeptCells> cells_of_words(const std::string& where, MazeHint maze, std::span<const std::uint64_t> right,
                                          std::span<const std::uint64_t> up, const std::string& hash,
                                          const Execution& execution);
/// Of walls that are held. Nothing for worlds that hold more than a maze of units on its grid. Throws Stopped.
std::unique_ptr<KeptCells> cells_of_scene(const Scene& scene, const Execution& execution);

}  // namespace warren
