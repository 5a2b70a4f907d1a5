// SPDX-License-Identifier: BSD-3-Clause
// How far the places of a world are from the nearest obstacle, as tiles above it: a scale of round steps that fits the
// world, and one ink more where a body of a radius does not fit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "apps/serve/tiles/world_tiles.hpp"
#include "core/run/execution.hpp"
#include "solve/kept/roadmap_query.hpp"

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
  void draw_each(PixelTile& tile, const Box& box, double pixel, const Execution& execution) const;
  void draw_between(PixelTile& tile, const Box& box, double pixel, const Execution& execution) const;

  TileGrid grid_;
  double largest_pixel_;
  std::unique_ptr<PlaceDistances> distances_;
  double needed_;
  Steps steps_;
};

/// Of a milestone that the start does not reach, beside the steps' own numbers.
inline constexpr std::uint8_t unreached_ink = step_inks.size();

/// How far the milestones of a roadmap are from a start, along its free edges: what a layer of the service colours.
struct StartDistances {
  std::vector<std::uint8_t> inks;  ///< one a milestone: the step of its distance, or unreached_ink
  Steps steps;
  std::uint64_t reached = 0;
  double farthest = 0.0;  ///< 0 where none is reached
};

/// Of points and discs in a roadmap whose edges are checked, by one search from the start, which is linked as a
/// question links it. start: two numbers. Throws UsageError where the body does not fit there or the roadmap is another
/// one, InputError, Stopped.
StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start, const Execution& execution);

}  // namespace warren::serve
