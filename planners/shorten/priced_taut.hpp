// SPDX-License-Identifier: BSD-3-Clause
// Pulls a path of the plane taut where a way costs more than its length: vertices are left out, moved, and put in, each
// wherever the exact cost of the legs falls and the legs are free by the caller's check. Descent, so the path never
// gets dearer and stays in its homotopy class as far as short moves do; it is no proof of anything. One thread, no
// chance: the same bytes everywhere.
#pragma once

#include <functional>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// What the legs of a path cost, and which may be.
struct PricedLegs {
  std::function<double(Vec2, Vec2)> cost;   ///< of a straight leg, at least its length
  std::function<bool(Vec2, Vec2)> is_free;  ///< may the leg be?
  double step = 1.0;                        ///< the first move of a vertex, about a cell; the last is a 64th of it
};

/// The path, no dearer, its ends the same. Ends where two turns save less than a ten-thousandth. Throws Stopped.
Path<Vec2> priced_taut(Path<Vec2> path, const PricedLegs& legs, const Execution& execution);

}  // namespace warren
