// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as plain arrays, whoever holds them: what planners leave behind, files hold and exports write. Start and
// goal are no part of it.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/types.hpp"
#include "core/search/edge_states.hpp"
#include "core/search/graph.hpp"

namespace warren {

/// Refers to arrays that live elsewhere. Any number of threads may read.
struct RoadmapParts {
  unsigned dimension = 2;  ///< numbers a state: 2 (x, y), 3 (x, y, heading in radians), 6 (joint angles in radians)
  bool directed = false;   ///< an edge leads from its row to its target alone; else each edge stands twice
  std::span<const double> states;              ///< `dimension` finite numbers a vertex
  std::span<const EdgeEnd> first;              ///< vertex_count + 1: the ends of vertex v are first[v] .. first[v + 1]
  std::span<const VertexId> to;                ///< where each edge end leads; the ends of a vertex ascend
  std::span<const std::uint64_t> edge_states;  ///< edge_states.hpp
  std::span<const VertexId> component;         ///< smallest vertex that free edges join each vertex with, any direction

  std::size_t vertex_count() const { return first.empty() ? 0 : first.size() - 1; }
  std::size_t edge_count() const { return directed ? to.size() : to.size() / 2; }
  std::span<const double> state(VertexId v) const { return states.subspan(std::size_t{v} * dimension, dimension); }
  std::span<const VertexId> neighbours(VertexId v) const { return to.subspan(first[v], first[v + 1] - first[v]); }
  EdgeState state_of_end(std::size_t end) const { return edge_state(edge_states, end); }
};

}  // namespace warren
