// SPDX-License-Identifier: BSD-3-Clause
// Why start and goal are apart, for the tiled pipeline: the keys of both components are found on the overlay, then the
// roadmap of each tile that has some of them is made once more and flooded from them. Only asked where there is no
// path. Cost: as much again as these tiles, one nearest-neighbour query a milestone of the smaller component, and 16 to
// 40 bytes a milestone of the two.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiles/tile_plane.hpp"

namespace warren {

/// Called from several threads, each with a plane of its own of that margin.
struct TileMaker {
  int margin;
  std::uint32_t bands;  ///< of tiles, which are made one after the other
  /// Returns the band's tiles; called by no thread but the first, while no tile is made.
  std::function<std::vector<std::size_t>(std::uint32_t band)> begin;
  /// The tile's keys as its reduction gave them; may use the plane up.
  std::function<std::vector<std::uint16_t>(std::size_t tile, TilePlane& plane)> keys;
  /// Makes the tile's roadmap in the plane, as before its reduction.
  std::function<void(std::size_t tile, TilePlane& plane)> remake;
};

/// Throws Stopped, also where the memory limit does not allow for the milestones of both.
Separation tile_separation(const Overlay& overlay, const TileGrid& grid, const OverlayEnds& ends,
                           const TileMaker& maker, const Execution& execution);

}  // namespace warren
