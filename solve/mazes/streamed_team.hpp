// SPDX-License-Identifier: BSD-3-Clause
// Several processes that share the work of a streamed solve, as the one that asks for the answer sees them
// (distributed/leader.hpp).
#pragma once

#include "core/plane/cell_walls.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/other_tiles.hpp"
#include "verify/cells/verify_cells.hpp"

namespace warren {

class StreamedTeam {
 public:
  StreamedTeam() = default;
  virtual ~StreamedTeam() = default;
  StreamedTeam(const StreamedTeam&) = delete;
  StreamedTeam& operator=(const StreamedTeam&) = delete;
  /// Makes what the tiles need to be made each by itself; once, before all else. Throws Stopped.
  virtual const CellWallSource& make(const Execution& execution) = 0;
  virtual OtherTiles& tiles() = 0;
  virtual JudgesElsewhere& judges() = 0;
};

}  // namespace warren
