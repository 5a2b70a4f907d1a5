// SPDX-License-Identifier: BSD-3-Clause
// Random points in the middles of a map's corridors, in world coordinates: spatial/maps/free_cells drawn from by a
// Kronecker sequence, so that any first n points are spread evenly over the corridors; each up to half the way towards
// one of the ridge cells beside it, so that the points fill the corridor's whole length, and a little to the side where
// there is room for it.
#pragma once

#include <cstdint>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

/// Immutable; any number of threads may draw. Does not refer to the map.
class CorridorPoints {
 public:
  /// field: of the map's blocked cells as squares, the outside too. reach: room that points must have, in cells.
  CorridorPoints(const OccupancyMap& map, const DistanceField& field, double reach, const Execution& execution);

  bool empty() const { return cells_.empty(); }
  /// The index-th point of a seed: a pure function. Not empty().
  Vec2 at(std::uint64_t seed, std::uint64_t index) const;

 private:
  CorridorCells cells_;
  OccupancyMap place_;  // where the map lies; without its cells
  double reach_;
};

}  // namespace warren
