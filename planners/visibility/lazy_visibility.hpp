// SPDX-License-Identifier: BSD-3-Clause
// The shortest path among polygons and walls without building the visibility graph: A* over the reduced graph, whose
// rows are found when a vertex is settled, and of which only those edges are looked for that a taut way can take: at
// each vertex the range of directions between straight on and the obstacle round which the way bends. Any optimal way
// through a vertex is taut at it whichever optimal way led there, so the path is as short as the graph's.
// One look a vertex settled, each over what can be seen in that range; memory 150 bytes a corner.
#pragma once

#include <vector>

#include "core/base/counters.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/execution.hpp"
#include "planners/visibility/visible_corners.hpp"

namespace warren {

/// Start and goal are not blocked, and different; start is vertex corners.size(), goal the next. Looks
/// (neighbour_queries) and what they found (edges_checked) are added to the counters; `found`, where given, receives
/// the edges. Throws Stopped.
SearchResult lazy_visibility_search(const VisibleCorners& corners, Vec2 start, Vec2 goal, const Execution& execution,
                                    Counters& counters, std::vector<Edge>* found = nullptr);

}  // namespace warren
