// SPDX-License-Identifier: BSD-3-Clause
// Components of the overlay's core, the shortest path in it, and that path's vertices with all that its chains stand
// for.
//
// The search is NBA* from both ends (core/bidirectional_search.hpp), on two threads where there are two: what mazes
// leave is little more than the path, and each side walks half of it; with loops each thread settles half of what is
// settled (2000 x 2000, 10 % loops: 469,256 of 770,000 keys in all).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/search.hpp"
#include "parallel/execution.hpp"
#include "planners/overlay.hpp"

namespace warren {

struct CoreComponents {
  std::uint64_t count = 0;
  bool joined = false;  ///< start and goal are in one
};
/// Union-find over the core. O(core).
CoreComponents core_components(const Overlay& overlay, const Execution& execution);

/// The shortest path from start to goal over vertices of the core. Throws Stopped at the deadline.
SearchResult search_overlay(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                            const OverlayEnds& ends, const Execution& execution);

/// All vertices of a path from start to goal, in order. O(vertices), in parallel.
std::vector<Vec2> expand_path(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                              const OverlayEnds& ends, std::span<const VertexId> path, const Execution& execution);

}  // namespace warren
