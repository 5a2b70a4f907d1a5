// SPDX-License-Identifier: BSD-3-Clause
// Where the walls of a maze come from that are left out of its scene (is_unmade): for the planner, and for the judge,
// who reads files by code of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "core/base/packed_values.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren {

/// Immutable; any number of threads may ask.
class StreamedWalls {
 public:
  StreamedWalls() = default;
  virtual ~StreamedWalls() = default;
  StreamedWalls(const StreamedWalls&) = delete;
  StreamedWalls& operator=(const StreamedWalls&) = delete;
  virtual const CellWallSource& planned() const = 0;
  virtual const CellWallSource& judged() const = 0;
  /// What is known of the walls by reading them: how many they are, and scene_hash() of the scene with them.
  virtual std::optional<std::size_t> wall_count() const { return std::nullopt; }
  virtual std::optional<std::string> hash() const { return std::nullopt; }
};

/// Makes what the tiles need to be made each by itself; opens, checks or reads the file. Throws InputError, ReadError,
/// Stopped.
/// kept, where given, was begun, and has parts of a maze that an earlier run made.
std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, const Execution& execution,
                                              KeptParts* kept = nullptr);

/// The walls that a file (Scene::packed) has of some rows of tiles, at least one, and of the row of cells below them;
/// no others are asked for. Of a .maze the row of tiles below is read as well, for its checksum, and no more; an array
/// has no order that could be relied on, so all of it is, and these walls stay.
std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, TileRows own, const Execution& execution);

/// Several processes that share the work of a streamed solve, as the one that asks for the answer sees them
/// (apps/distributed/leader_follower.hpp).
class StreamedTeam {
 public:
  StreamedTeam() = default;
  virtual ~StreamedTeam() = default;
  StreamedTeam(const StreamedTeam&) = delete;
  StreamedTeam& operator=(const StreamedTeam&) = delete;
  /// Makes or reads what the tiles need to be had each by itself; once, before all else. Refers to the team. Throws
  /// InputError, ReadError, Stopped.
  virtual std::unique_ptr<StreamedWalls> make(const Execution& execution) = 0;
  virtual OtherTiles& tiles() = 0;
  virtual JudgesElsewhere& judges() = 0;
};

}  // namespace warren
