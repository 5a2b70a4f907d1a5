// SPDX-License-Identifier: BSD-3-Clause
// Is a path over a lattice free? Almost all its legs are steps from the middle of a cell to that of a neighbour. Of
// such a step nothing but the wall between the two comes nearer than a half: all other walls lie on lines half a unit
// beside it, or begin half a unit beside it. So one look at one wall judges a step, and where some wall stands beside
// one, a half is the least distance. The first and the last leg may be others: these, and any path that is not free or
// not of this kind, are judged as among cells. Cost: some ns a step.
#pragma once

#include <span>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/streamed/looked_up_walls.hpp"

namespace warren {

/// As verify_among_cells.
Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution);

}  // namespace warren
