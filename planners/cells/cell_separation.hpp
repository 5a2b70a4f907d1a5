// SPDX-License-Identifier: BSD-3-Clause
// Why no path leads through vertical cells from start to goal: how many cells each can reach, and the gap between them.
#pragma once

#include "core/base/solution.hpp"
#include "core/search/graph.hpp"
#include "parallel/execution.hpp"
#include "planners/cells/cell_decomposition.hpp"

namespace warren {

/// parts: of the graph of the cells, with start and goal behind them in this order. Sizes count cells; the gap is the
/// least distance between the ends and the doors' middles of either side. O(cells).
Separation cell_separation(const CellDecomposition& cells, const Components& parts, Vec2 start, Vec2 goal,
                           const Execution& execution);

}  // namespace warren
