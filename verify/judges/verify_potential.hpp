// SPDX-License-Identifier: BSD-3-Clause
// Is a function over a map's cells (core/base/cell_potential) a proof that no path costs less than a bound? In each
// triangle where the body's middle may be, its slope is compared with the least price of length there: for that one
// look at each triangle is enough, and who made it needs no trust. Nothing from spatial/ or planners/.
#pragma once

#include "core/base/cell_potential.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "verify/judges/verify_bound.hpp"

namespace warren {

/// What is claimed, in world coordinates and units. What areas and masks add is not counted: a bound without is one.
struct PotentialClaim {
  Vec2 start;                ///< of the body's middle
  Vec2 goal;                 ///< of the body's middle
  double keeps = 0.0;        ///< the middle's distance to what is blocked is never less
  double radius = 0.0;       ///< of the disc; 0: a point
  double price = 0.0;        ///< a unit of length in touch costs so much more, >= 0
  double reach = 0.0;        ///< from so far from its rim on nothing is paid; > 0 where there is a price
  double lower_bound = 0.0;  ///< of the cost
};

/// `map`: its blocked cells as the question closes and opens them, water where the path may not go included. Checked or
/// refuted, the same for any number of threads; rounding counts against the claim. Throws Stopped.
JudgedBound verify_potential(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof,
                             const Execution& execution);

}  // namespace warren
