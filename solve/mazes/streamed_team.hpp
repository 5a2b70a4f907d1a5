// SPDX-License-Identifier: BSD-3-Clause
// Several processes that share the work of a streamed solve, as the one that asks for the answer sees them
// (apps/distributed/leader_follower.hpp).
#pragma once

#include <memory>

#include "parallel/execution.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "solve/mazes/streamed_walls.hpp"
#include "verify/cells/verify_cells.hpp"

namespace warren {

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
