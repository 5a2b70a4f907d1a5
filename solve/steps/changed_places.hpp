// SPDX-License-Identifier: BSD-3-Clause
// Where two worlds differ: the boxes of the obstacles that only one of them has. What keeps clear of all these boxes
// meets the same obstacles in both.
#pragma once

#include <optional>
#include <vector>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// More differences than so many are no change but another world.
inline constexpr std::size_t most_changed_places = 4096;

/// Nothing where the worlds differ in more than obstacles of the plane: in bounds, maze, map, solids or, of maps, in
/// size and place; or in more obstacles than most_changed_places. O(n log n) for n obstacles.
std::optional<std::vector<Box>> changed_places(const Scene& before, const Scene& now, const Execution& execution);

/// Does a box come closer than `reach` to one of these? Boxes that touch do.
bool comes_near(const std::vector<Box>& places, const Box& box, double reach);

}  // namespace warren
