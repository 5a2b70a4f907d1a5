// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as plain arrays that it owns, and what building it took: whoever builds one gives these, and knows nothing
// of the roadmap as a value that is asked, updated and kept in a file (solve/roadmaps/roadmap.hpp).
#pragma once

#include <cstdint>

#include "core/base/counters.hpp"
#include "core/base/raw_vector.hpp"
#include "core/search/graph.hpp"
#include "planners/contraction/hierarchy.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"

namespace warren {

/// States and edges, owned. An edge that leads both ways stands in both its rows.
struct RoadmapArrays {
  unsigned dimension = 2;                ///< numbers a state
  bool directed = false;                 ///< do edges lead one way?
  RawVector<double> states;              ///< `dimension` numbers each
  Graph candidates;                      ///< edges that are free, blocked or unchecked
  RawVector<std::uint64_t> edge_states;  ///< two bits an edge end (core/search/edge_states.hpp)
  RawVector<VertexId> component;         ///< a number each state: the same where free edges join them
  Hierarchy hierarchy;                   ///< of the free edges; empty: there is none

  /// Views of all of it.
  RoadmapParts parts() const {
    return {dimension, directed, states, candidates.offsets(), candidates.targets(), edge_states, component};
  }
};

/// What building took.
struct BuildAccount {
  Counters counters;   ///< exact, the same for any number of threads
  StageTimes seconds;  ///< wall-clock
};

}  // namespace warren
