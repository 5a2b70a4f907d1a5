// SPDX-License-Identifier: BSD-3-Clause
// Ways in the trees that hang off the core: where a cell reaches the core, and where two cells of one tree meet. Cells
// are climbed in at most three tiles, pieces between them; a few microseconds at any size.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// The cell of the core that a cell hangs off, and the steps to it.
struct CoreEntry {
  Place core;
  std::uint32_t steps;
};

/// Where the ways of two cells to their core join, and the steps from there to the core.
struct TreeMeeting {
  Place at;
  std::uint32_t depth;
};

/// Looks at the index; any number of threads may.
class TreeRoutes {
 public:
  explicit TreeRoutes(const RouteIndex& index)
      : places_(index.places()), marks_(index.marks()), pieces_(index.pieces()) {}

  CoreEntry core_entry(Place from) const;
  /// Both hang off the same cell of the core.
  TreeMeeting meeting(Place a, Place b) const;
  /// Appends a cell and those after it on its way to the core, as many as steps.
  void append_climb(Place from, std::uint32_t steps, RawVector<Place>& cells) const;

 private:
  PieceId piece_of(Place from) const;
  TreeMeeting meeting_in_tile(Place a, Place b) const;

  const LatticePlaces& places_;
  CellMarks marks_;
  PieceForest pieces_;
};

}  // namespace warren
