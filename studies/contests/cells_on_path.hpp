// SPDX-License-Identifier: BSD-3-Clause
// How many cells of a raster a path passes, as course reports count a path's length.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::studies {

/// Where a raster's cell (0, 0) has its middle, and how far apart middles are.
struct Raster {
  Vec2 origin;
  double cell = 1.0;
};

/// Ends of legs are rounded to cells; a leg takes as many steps as its longer side has cells, diagonal ones count as
/// one; and the first cell. A path of one cell passes one, an empty path none.
std::uint64_t cells_passed(std::span<const Vec2> path, const Raster& raster);

/// The same on a map's own cells.
std::uint64_t cells_passed(std::span<const Vec2> path, const OccupancyMap& map);

}  // namespace warren::studies
