// SPDX-License-Identifier: BSD-3-Clause
// Makes the hierarchy (hierarchy.hpp) of an undirected graph. Vertices are taken out in rounds: in each all those whose
// key, from their degree and how much was taken out around them, is below their neighbours', so that no two of them are
// neighbours and all can go at once; shortcuts keep the lengths between what is left (contraction_rounds.cpp).
// Everything is a function of the graph: the same bytes for any number of threads.
//
// Where ways through a place are few, as in corridors, what is left grows no denser, and a question climbs through a
// few hundred vertices. In open space it does: then nobody gains, and counting says so, first in samples of the graph,
// later while it is made, at last by asking it.
// Cost: 800,000 milestones in a maze of 300 x 300 cells with 10 % loops, 5 million edges: 6 s on two busy cores, 1.3
// arcs an edge. The searches for witnesses are nearly all of it: fewer looks make it slower, for the shortcuts that are
// too many cost more later (60 instead of 120 settled vertices: 1.7 times the arcs that a question looks at).
#pragma once

#include <optional>

#include "core/search/graph.hpp"
#include "parallel/execution.hpp"
#include "planners/contraction/hierarchy.hpp"

namespace warren {

/// The graph has lengths >= 0. Nothing where it doesn't pay. Throws Stopped.
std::optional<Hierarchy> contract(const Graph& graph, const Execution& execution);

}  // namespace warren
