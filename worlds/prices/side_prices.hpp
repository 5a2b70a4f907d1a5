// SPDX-License-Identifier: BSD-3-Clause
// What straight legs cost among walls, outlines of polygons and bounds (scenes/scene/prices.hpp): as among cells
// (worlds/prices/map_prices.hpp), with segments instead of squares. A leg is cut where the nearest place of a segment
// becomes an end of it.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/plane/nearness.hpp"
#include "scenes/scene/prices.hpp"
#include "spatial/obstacles/wall_index.hpp"
#include "worlds/prices/effective_map.hpp"

namespace warren {

/// Immutable; any number of threads may ask, each with its own Scratch.
class SidePrices {
 public:
  /// What a thread that asks holds.
  struct Scratch {
    NearnessSum sum;
    std::vector<Segment> near;
    std::vector<StretchDistance> things;
    std::vector<double> cuts;
  };

  /// Refers to the sides of what is blocked, keep-out polygons among them. radius: of the disc, >= 0.
  /// Throws UsageError as clearance_reach().
  SidePrices(const WallIndex& sides, double radius, const Prices& prices);

  /// Does any leg cost more than its length?
  bool is_priced() const { return reach_ > 0.0 || !areas_.empty(); }
  /// Of a straight leg of the middle that touches nothing blocked.
  PriceParts parts(Vec2 a, Vec2 b, Scratch& scratch) const;
  /// The leg's length and what it costs beyond.
  double cost(Vec2 a, Vec2 b, Scratch& scratch) const { return distance(a, b) + parts(a, b, scratch).sum(); }

 private:
  double nearness(Vec2 p, Vec2 u, double length, Scratch& scratch) const;

  const WallIndex& sides_;
  AreaFactors areas_;
  double price_ = 0.0;  // of an integral over the middle's distances
  double reach_ = 0.0;  // of the middle; 0: nearness costs nothing
};

}  // namespace warren
