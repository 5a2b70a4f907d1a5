// SPDX-License-Identifier: BSD-3-Clause
// Why start and goal are apart, for the tiled pipeline: the keys of both components are found on the overlay, then each
// tile's roadmap is made once more and flooded from its keys. Only asked where there is no path. Cost: as much again as
// the tiles, one nearest-neighbour query a milestone of the smaller component, and 16 to 40 bytes a milestone of the
// two.
#pragma once

#include <functional>
#include <span>

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiles/tile_plane.hpp"

namespace warren {

/// remake(tile, plane) makes the tile's roadmap in the plane as before its reduction; called from several threads, each
/// with a plane of its own of that margin.
struct TileMaker {
  int margin;
  std::function<void(std::size_t tile, TilePlane& plane)> remake;
};

Separation tile_separation(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                           const OverlayEnds& ends, const TileMaker& maker, const Execution& execution);

}  // namespace warren
