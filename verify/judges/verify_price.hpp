// SPDX-License-Identifier: BSD-3-Clause
// What a question forbids and opens, as the verification sees it: its own code, which shares nothing with
// worlds/prices. On a map a cell is blocked whose open square meets an open keep-out polygon, or the open square of a
// mask's blocked cell; unknown cells at a price are free. Elsewhere keep-out polygons, and the blocked cells of masks
// in rows, are obstacles like others.
//
// What a path costs beside its length, recomputed: nothing of worlds/prices is used. A leg is cut where it passes from
// cell to cell, along segments where the nearest place of one becomes an end; in each piece the integral is a closed
// form. Factors are looked up in the middle of what lies between two borders; within a billionth of a cell of a border
// the lesser one counts. O(legs * cells crossed * things near them).
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// The scene that a path of these prices must be free in; none: the scene as it is. Masks have been read (InputError
/// otherwise). Throws Stopped.
std::optional<Scene> effective_scene(const Scene& scene, const Prices& prices, const Execution& execution);

/// Of a point's or disc's path among the cells of a map, or among walls, polygons and bounds. scene: as the prices
/// close and open it (effective_scene()), in which the path is free. radius: of the disc. Throws InputError where a
/// price of nearness reaches nowhere, Stopped.
PriceParts verify_price(const Scene& scene, std::span<const Vec2> path, const Prices& prices, double radius,
                        const Execution& execution);

/// Clearance and areas of a turning polygon or a car, and `error`: the sum is off by no more. scene: as the prices
/// close and open it (effective_scene()), in which the path is free. Of turns on the spot nothing is paid: the
/// integrals are over the way of the reference point. Throws InputError where a price of nearness reaches nowhere,
/// Stopped.
PriceParts verify_body_price(const Scene& scene, std::span<const Se2> path, const RobotSpec& robot,
                             const Prices& prices, const Execution& execution);

// The factors of length that areas, masks and unknown cells give to places, as the verification has them, and their
// integral over a leg: cut at every border that the leg crosses, the factor looked up in the middle of what lies
// between two. A straight leg meets a border's line in one point, an arc in up to two: both are closed forms.

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

/// The sum of what piece(from, to) says of all between two cuts, and the ends.
template <class Piece>
double sum_of_pieces(std::vector<double>& cuts, double length, const Execution& execution, const Piece& piece) {
  cuts.push_back(0.0);
  cuts.push_back(length);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    execution.check();
    if (cuts[i] > cuts[i - 1]) sum += piece(cuts[i - 1], cuts[i]);
  }
  return sum;
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
