// SPDX-License-Identifier: BSD-3-Clause
// Are paths on a map of different homotopy classes? By cuts of the judge's own: from the rightmost cell of each hole a
// ray leads to the right, through whatever is there; the rays that a path crosses, in order, inverse neighbours
// cancelled, tell its class. Holes as planners understand them (planners/grid/path_classes), found here by other code.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// What makes classes, in world units.
struct ClassRule {
  double keeps = 0.0;  ///< a body's middle is never so near to what is blocked
  double hole = 0.0;   ///< the longer side of a hole's box, at least
};

/// By the judge's own cuts the class of each path, and what an answer would say of it.
struct JudgedClasses {
  std::vector<std::vector<std::int32_t>> classes;  ///< by rays to the right
  std::vector<std::vector<std::int32_t>> told;     ///< by cuts that lead down, as answers tell it
  std::vector<Box> holes;                          ///< the first is number 1; in cells of the map
};

/// Holes are numbered by the lowest cell of each, row by row from below. `map`: as the question closes and opens
/// it. Throws Stopped.
JudgedClasses judged_classes(const OccupancyMap& map, const ClassRule& rule, std::span<const Path<Vec2>> paths,
                             const Execution& execution);

/// Two paths that are of one class; none: all differ.
std::optional<std::pair<std::size_t, std::size_t>> same_class(const std::vector<std::vector<std::int32_t>>& classes);

}  // namespace warren
