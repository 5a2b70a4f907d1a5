// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of a roadmap are joined by edges that are known to be free, whatever their direction. O(E α(V)), on
// all threads by a lock-free union; the same labels whatever the order of the unions.
#pragma once

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"

namespace warren {

/// For each vertex the smallest one of its component. `parts` needs no components of its own. Throws Stopped.
RawVector<VertexId> free_components(const RoadmapParts& parts, const Execution& execution);

}  // namespace warren
