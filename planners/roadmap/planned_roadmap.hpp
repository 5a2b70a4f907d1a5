// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as a planner leaves it behind, for pictures and second queries: milestones in tile order with start and
// goal as the last two, the graph over them, and the search's tree.
#pragma once

#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/search/graph.hpp"

namespace warren {

template <class State>
struct PlannedRoadmap {
  RawVector<State> states;         ///< milestones, then start, then goal
  Graph graph;                     ///< free edges; lazy planners: the edges that were checked and found free
  std::vector<Edge> search_tree;   ///< (vertex, parent) of every vertex that the search reached
  std::vector<Edge> motions = {};  ///< trees that grow: each motion from where it begins to where it ends
};

}  // namespace warren
