// SPDX-License-Identifier: BSD-3-Clause
// Connected components on all cores. Blocks of vertices are joined serially inside (union-find with path halving, the
// smaller root wins), then the edges between blocks by a lock-free union that hangs the larger root under the smaller
// one with compare-and-swap, then every vertex is pointed at its root. A root is the smallest vertex of its tree at all
// times, so the labels are the smallest vertices of the components whatever the order of the unions.
//
// O(E α(V)), reads each row once and the rows that leave their block twice; memory: the labels. core's serial
// components() is the oracle.
#pragma once

#include "core/search/graph.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// label[v] is the smallest vertex of v's component: the same as the serial components(graph).
Components components(const Graph& graph, const Execution& execution);

/// Vertices in v's component.
std::size_t component_size(const Components& components, VertexId v, const Execution& execution);

}  // namespace warren
