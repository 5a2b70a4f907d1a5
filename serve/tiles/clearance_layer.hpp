// SPDX-License-Identifier: BSD-3-Clause
// How far the places of a world are from the nearest obstacle, as tiles above it: a scale of round steps that fits the
// world, and one ink more where a body of a radius does not fit.
#pragma once

#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "serve/tiles/step_tile.hpp"
#include "serve/tiles/world_tiles.hpp"

namespace warren::serve {

/// Where the body does not fit.
inline constexpr Rgb too_near_ink{200, 16, 46};

/// Immutable; any number of threads may draw.
class ClearanceLayer {
 public:
  /// Refers to the tiles. box: of the world, by some thousand places of which the scale is made. needed: distance that
  /// a body's middle must have, 0 for none. Throws Stopped.
  ClearanceLayer(const WorldTiles& tiles, const Box& box, double needed, const Execution& execution);

  /// A PNG. Throws Stopped.
  std::string draw(const TilePlace& place, const Execution& execution) const;
  const Steps& steps() const { return steps_; }
  double needed() const { return needed_; }

 private:
  std::uint8_t ink_of(double distance) const;
  void draw_each(StepTile& tile, const Box& box, double pixel, const Execution& execution) const;
  void draw_between(StepTile& tile, const Box& box, double pixel, const Execution& execution) const;

  TileGrid grid_;
  double largest_pixel_;
  std::unique_ptr<PlaceDistances> distances_;
  double needed_;
  Steps steps_;
};

}  // namespace warren::serve
