// SPDX-License-Identifier: BSD-3-Clause
// Components of the overlay's core: the vertices that are not peeled. The search is
// planners/tiled/overlay_dijkstra.hpp.
#pragma once

#include <cstdint>

#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"

namespace warren {

struct CoreComponents {
  std::uint64_t count = 0;
  bool joined = false;  ///< start and goal are in one
};
/// Union-find over the core. O(vertices).
CoreComponents core_components(const Overlay& overlay, const Execution& execution);

}  // namespace warren
