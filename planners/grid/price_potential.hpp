// SPDX-License-Identifier: BSD-3-Clause
// What no path of a point or disc on a map costs less than, whatever its shape: a function over the map that is linear
// on four triangles a cell (core/base/cell_potential). Where its slope is nowhere above the least price of length in
// the triangle, no path from one place to another costs less than its two values differ by: along the path it falls by
// at most the integral of its slope.
//
// Made by fast marching (Kimmel, Sethian, PNAS 95, 1998) over the triangles from the goal on. Around the goal and
// behind corners, where all ways fan out of a point, the result is too steep, by the square root of 2 at worst: there
// the price is lowered by what is too much, and marched again; at last all values are divided by the worst that is
// left. A proof does not depend on how it was made: who checks it (verify/judges/verify_bound) looks at each triangle.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/bitmap.hpp"
#include "core/base/cell_potential.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// What is bounded; lengths in cells.
struct PotentialQuestion {
  const Bitmap& blocked;  ///< cells whose closed squares are blocked; what lies outside is, too
  Vec2 start;             ///< of the middle
  Vec2 goal;              ///< of the middle
  double keeps = 0.0;     ///< the middle's distance to what is blocked is never less
  double radius = 0.0;    ///< of the disc; what is nearer than `reach` to its rim is paid for
  double price = 0.0;     ///< a unit of length in touch costs so much more, >= 0
  double reach = 0.0;     ///< > 0 where there is a price
};

/// How much is done for it.
struct PotentialEffort {
  std::uint32_t parts = 1;    ///< each cell is cut into parts x parts, >= 1: prices are known better
  std::uint32_t sweeps = 12;  ///< so many at most, >= 1
  double enough = 0.0;        ///< a bound so large ends it, cells
};

/// A bound and its proof.
struct PricePotential {
  double bound = 0.0;        ///< cells, >= 0, rounded down
  CellPotential values;      ///< cells
  std::uint32_t sweeps = 0;  ///< that were made
};

/// Start and goal are free. none: no way joins them over the triangles. Throws Stopped.
std::optional<PricePotential> price_potential(const PotentialQuestion& question, const PotentialEffort& effort,
                                              const Execution& execution);

}  // namespace warren
