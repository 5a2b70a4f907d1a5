// SPDX-License-Identifier: BSD-3-Clause
// A shortest path over an overlay that this process does not hold: its keys, as whoever searched tells them, made into
// summaries of tiles that have these keys and their edges alone, so that a path is expanded in one way.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// A key by its tile and its place in it (row * side + col), and the steps to the next key of a route.
struct RouteKey {
  std::uint64_t tile;
  std::uint32_t place;
  std::uint32_t steps;
};

/// What a search elsewhere found.
struct ToldRoute {
  bool joined = false;           ///< start and goal are in one component
  std::uint64_t components = 0;  ///< of the overlay, start and goal among its vertices
  std::uint64_t expanded = 0;    ///< vertices settled
  std::vector<RouteKey> keys;    ///< from start's link to goal's; none: start is joined to goal
};

/// Summaries of all tiles, with the keys that start and goal join. Throws Stopped.
std::vector<TileSummary> tiles_of(const ToldRoute& route, const TileGrid& grid, const OverlayEnds& ends,
                                  const Execution& execution);

/// The route's vertices in the overlay of these summaries.
RawVector<VertexId> vertices_of(const ToldRoute& route, const Overlay& overlay, std::span<const TileSummary> tiles,
                                const Execution& execution);

}  // namespace warren
