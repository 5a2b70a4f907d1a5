// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze in two bits a cell instead of 16 bytes a wall, where they are those that a maze has: unit walls
// in the course's order (scenes/mazes/maze_generator.hpp). Cells column by column, from the lowest row up; of cell i,
// bits 2 (i mod 32) and the next of word i / 32: its right wall stands, its upper one does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/lattice_passages.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Nothing where the scene's walls are others, or in another order. Throws Stopped.
std::optional<RawVector<std::uint64_t>> maze_bits(const Scene& scene, const Execution& execution);

/// What wall_passages() gives, three times as fast, where the scene is nothing but walls on its maze's grid inside
/// their outline and the reach leaves the middles of cells alone: a motion is free unless a wall stands across it, for
/// no other comes nearer than a half. Nothing elsewhere. Throws Stopped.
std::optional<LatticePassages> passages_of_maze(const Scene& scene, double reach, const Execution& execution);

/// Are the scene's walls, to the bit, those of a maze where a wall stands wherever the lattice has no passage? Throws
/// Stopped.
bool has_walls_of(const LatticePassages& lattice, const Scene& scene, const Execution& execution);

/// The walls of that maze. Throws Stopped.
WallSet walls_of_lattice(const LatticePassages& lattice, const Execution& execution);

/// The walls again, to the bit. Throws InputError naming `where` for another number of words, Stopped.
WallSet walls_of_maze_bits(const std::string& where, MazeHint maze, std::span<const std::uint64_t> bits,
                           const Execution& execution);

}  // namespace warren
