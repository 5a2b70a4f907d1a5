// SPDX-License-Identifier: BSD-3-Clause
// Is this path free among walls that are not held? The tiles that the path comes near are asked for, one after the
// other, by all threads, and each leg is compared with the walls around it; nothing of a tile is kept. Cost: the tiles
// near the path, and some hundred ns a leg; 8 bytes a leg and tile beside the legs.
#pragma once

#include <span>

#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "parallel/execution.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// As verify_path among the same walls held, of a point or disc that keeps off them: InputError where contact is
/// allowed. A wall is named by its ends alone. The result is the same for any number of threads.
Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution);

}  // namespace warren
