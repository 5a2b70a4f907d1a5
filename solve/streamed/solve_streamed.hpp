// SPDX-License-Identifier: BSD-3-Clause
// prm in mazes whose walls are left out of the scene (is_unmade), for those who have help for it. Where the walls come
// from: for the planner, and for the judge, who reads files by code of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "core/base/packed_values.hpp"
#include "core/base/solution.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren {

/// Immutable; any number of threads may ask.
class StreamedWalls : NotCopied {
 public:
  virtual ~StreamedWalls() = default;
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
std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, Range own, const Execution& execution);

/// Several processes that share the work of a streamed solve, as the one that asks for the answer sees them
/// (apps/distributed/leader_follower.hpp).
class StreamedTeam : NotCopied {
 public:
  virtual ~StreamedTeam() = default;
  /// Makes or reads what the tiles need to be had each by itself; once, before all else. Refers to the team. Throws
  /// InputError, ReadError, Stopped.
  virtual std::unique_ptr<StreamedWalls> make(const Execution& execution) = 0;
  virtual OtherTiles& tiles() = 0;
  virtual JudgesElsewhere& judges() = 0;
};

/// What a streamed solve may be given beside the question; none of it changes the answer.
struct StreamedHelp {
  PathTaker* taker = nullptr;    ///< receives the path piece by piece, before it is verified; see Answer::handed
  KeptParts* kept = nullptr;     ///< has finished parts of an earlier run, and takes those of this one
  StreamedTeam* team = nullptr;  ///< shares the work
};

/// As solve_within(): makes the walls, plans, verifies; all of it is in solve_s. Throws UsageError for what can't be
/// asked, and where the walls are held; a stop is an answer.
Answer solve_streamed_within(const Scene& scene, const Question& question, const SolveOptions& options,
                             const Execution& execution, const StreamedHelp& help);

}  // namespace warren
