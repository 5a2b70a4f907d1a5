// SPDX-License-Identifier: BSD-3-Clause
// Route graphs with fewer nodes: where a chain of nodes leads on without a choice and nobody has written anything on
// them, straight edges replace it that it stays near to (Douglas and Peucker, 1973). What people have written stays:
// nodes with a heading, metadata or operations, edges with more than ends and a cost, edges that lead one way.
#pragma once

#include <functional>

#include "apps/serve/graphs/route_graph.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"

namespace warren::serve {

/// May a new edge lead straight from one place to the other?
using MayLead = std::function<bool(Vec2, Vec2)>;

/// No place of a chain is farther than `within` (metres, >= 0) from the edge that replaces it, which costs what the
/// chain costs in that direction; an edge whose cost is its length gets its own. Two edges never join the same two
/// nodes that were joined by a chain. may_lead: empty, everywhere. Throws HttpError as ends_of() does, Stopped.
RouteGraph simplified(const RouteGraph& graph, double within, const MayLead& may_lead, const Execution& execution);

/// The same, but that new edges lead only where the verification finds the body of the question free in the scene, with
/// all that closes places of it. Throws UsageError for bodies that drive no straight edges, too.
RouteGraph simplified_in(const Scene& scene, const Question& body, const RouteGraph& graph, double within,
                         const Execution& execution);

}  // namespace warren::serve
