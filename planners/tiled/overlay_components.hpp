// SPDX-License-Identifier: BSD-3-Clause
// Components of the overlay's core (the vertices that are not peeled), and a path's vertices with all that its chains
// stand for. The search is planners/tiled/overlay_dijkstra.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/path.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"

namespace warren {

struct CoreComponents {
  std::uint64_t count = 0;
  bool joined = false;  ///< start and goal are in one
};
/// Union-find over the core. O(vertices).
CoreComponents core_components(const Overlay& overlay, const Execution& execution);

/// All vertices of a path from start to goal, in order. O(vertices), in parallel.
Path<Vec2> expand_path(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                       const OverlayEnds& ends, std::span<const VertexId> path, const Execution& execution);

}  // namespace warren
