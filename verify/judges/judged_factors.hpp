// SPDX-License-Identifier: BSD-3-Clause
// The factors of length that areas, masks and unknown cells give to places, as the verification has them, and their
// integral over a leg: cut at every border that the leg crosses, the factor looked up in the middle of what lies
// between two. A straight leg meets a border's line in one point, an arc in up to two: both are closed forms.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// A straight leg by arc length.
struct JudgedRay {
  Vec2 from;
  Vec2 u;
  double length;

  explicit JudgedRay(const Segment& leg) : from(leg.a), length(distance(leg.a, leg.b)) {
    u = (1.0 / length) * (leg.b - leg.a);
  }
  Vec2 at(double t) const { return from + t * u; }
};

/// The way of a body that turns evenly on it, by shares from 0 to 1.
struct JudgedArc {
  Vec2 from;
  double heading_rad;  ///< at its begin
  double turn_rad;     ///< on the way
  double length;       ///< below 0: backwards

  Vec2 at(double share) const;
};

/// Adds where a leg passes the lines 0, 1, 2, … of a grid, along both of its axes. by: of the leg a unit of its length.
void add_grid_lines(Vec2 from, Vec2 by, double length, std::vector<double>& cuts);

/// Calls piece(from, to) for all between two cuts, and the ends.
template <class Piece>
void for_pieces(std::vector<double>& cuts, double length, const Execution& execution, const Piece& piece) {
  cuts.push_back(0.0);
  cuts.push_back(length);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    execution.check();
    if (cuts[i] > cuts[i - 1]) piece(cuts[i - 1], cuts[i]);
  }
}

/// Of one scene and its prices, to which it refers. One thread.
class JudgedFactors {
 public:
  JudgedFactors(const Scene& scene, const Prices& prices, const Execution& execution);
  bool any() const { return unknown_ > 1.0 || !areas_.empty() || !masks_.empty(); }

  /// The integral of factor - 1 over a leg of the world, in the world's unit. The leg has a length.
  double over(const Segment& leg);
  /// The same of an arc.
  double over(const JudgedArc& arc);

 private:
  struct Area {
    double factor;
    std::vector<Vec2> corners;
    bool holds(Vec2 p) const;
  };
  double factor(Vec2 p, Vec2 in_world) const;

  const OccupancyMap* map_;  // in whose cells the areas are; nullptr: they are in the world
  const Execution& execution_;
  double unknown_ = 1.0;
  std::vector<Area> areas_;
  std::vector<const PriceMask*> masks_;
  std::vector<double> cuts_;
};

}  // namespace warren
