// SPDX-License-Identifier: BSD-3-Clause
// The route of a question by a hierarchy: start and goal are two vertices more, which no way passes between its ends.
#pragma once

#include <span>

#include "core/search/search.hpp"
#include "planners/contraction/hierarchy_query.hpp"

namespace warren {

/// Start has the number vertex_count() of the hierarchy, goal the next one. `ends`: their edges, from a vertex of the
/// roadmap to one of them, or from start to goal; `lengths`: of each. The length of what is found is left 0. Throws
/// Stopped, and InputError as HierarchyQuery::path does.
SearchResult route_by_hierarchy(const Hierarchy& hierarchy, std::span<const Edge> ends, std::span<const double> lengths,
                                HierarchyScratch& scratch, const Execution& execution);

}  // namespace warren
