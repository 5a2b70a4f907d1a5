// SPDX-License-Identifier: BSD-3-Clause
// Who makes and reduces the tiles of a lattice where that is not the planner's own process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiled/told_route.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"

namespace warren {

/// A chain of a path: places of its ends in the tile (row * side + col), the lower first, and its steps.
struct TileChain {
  std::uint64_t tile;
  std::uint16_t from, to;
  std::uint32_t length;
};

class OtherTiles {
 public:
  OtherTiles() = default;
  virtual ~OtherTiles() = default;
  OtherTiles(const OtherTiles&) = delete;
  OtherTiles& operator=(const OtherTiles&) = delete;
  /// All tiles' summaries without steps. Dead ends of the overlay may be gone from them, the others' keys in their
  /// order; components that are gone with them are counted as closed. Throws Stopped.
  virtual std::vector<TileSummary> reduce_all(const OverlayEnds& ends, const Execution& execution) = 0;
  /// The same with all their keys, where the walk along dead ends matters. Throws Stopped, also where this process
  /// can't hold them.
  virtual std::vector<TileSummary> reduce_whole(const OverlayEnds& ends, const Execution& execution) = 0;
  /// After reduce_all(): do the others search, since this process could not hold the overlay? Then the summaries have
  /// neither keys nor chains, and their counts are those of all tiles together.
  virtual bool searches() const = 0;
  /// What the search over all tiles finds. Throws Stopped.
  virtual ToldRoute search(const OverlayEnds& ends, const Execution& execution) = 0;
  /// The directions of each chain, from its lower end. Throws Stopped.
  virtual std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains,
                                                          const Execution& execution) = 0;
};

}  // namespace warren
