// SPDX-License-Identifier: BSD-3-Clause
// The visibility graph (Lozano-Pérez, Wesley 1979) among polygons and walls, contact allowed: the shortest path for a
// point is the shortest path in it. Vertices and neighbours are those of planners/visibility/visible_corners, each
// corner's by a rotational sweep over what can be seen from it; corners are spread over the cores.
//   reduced   tangent edges at convex corners only (Rohnert 1986; Liu, Arimoto 1992): enough for shortest paths
//   full      all visible edges, sides of polygons included
// Time O(n (s + k log k)) where a look meets k of the n pieces in s cells, so at worst O(n^2 log n), where everything
// sees everything; with crossing obstacles O(k * pieces crossed) a look. Memory: 4 bytes an edge end, lengths
// are computed as they are needed, and 150 bytes a corner. Start and goal are linked by a sweep each and
// never become part of the graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/execution.hpp"
#include "planners/visibility/visible_corners.hpp"

namespace warren {

enum class VisibilityEdges : std::uint8_t { reduced, full };

/// What start and goal see: vertices of the graph, ascending.
struct VisibilityLinks {
  Vec2 start;
  Vec2 goal;
  std::vector<VertexId> from_start;
  std::vector<VertexId> from_goal;
  std::vector<std::uint8_t> sees_goal;  ///< one a vertex
  bool direct = false;                  ///< start sees goal
  std::size_t count() const { return from_start.size() + from_goal.size() + (direct ? 1 : 0); }
};

/// Immutable after construction; any number of threads may link and search.
class VisibilityGraph {
 public:
  /// Throws Stopped at the deadline or the memory limit, InputError for more than 2^32 - 1 edge ends.
  VisibilityGraph(const VisibleCorners& corners, VisibilityEdges edges, const Execution& execution);
  /// The same where its edges are known: `graph` has a vertex a corner.
  VisibilityGraph(const VisibleCorners& corners, Graph graph, VisibilityEdges edges);

  /// Over the vertices of the corners, without start and goal.
  const Graph& graph() const { return graph_; }
  std::size_t size() const { return positions_.size(); }
  std::span<const Vec2> positions() const { return positions_; }
  VertexId start_vertex() const { return static_cast<VertexId>(size()); }
  VertexId goal_vertex() const { return static_cast<VertexId>(size() + 1); }

  /// Two sweeps, O(vertices). Start and goal are not blocked, and different. Throws Stopped.
  VisibilityLinks link(Vec2 start, Vec2 goal, const Execution& execution) const;
  /// The graph with start and goal as the last two vertices; O(vertices + edges). Throws Stopped.
  Graph joined(const VisibilityLinks& links, const Execution& execution) const;

  /// A* (informed) or Dijkstra between start and goal without joining them to the graph. Queue and state are cleared
  /// and sized for size() + 2 vertices.
  template <class Queue, class ShouldStop = NeverStop>
  SearchResult search(const VisibilityLinks& links, bool informed, Queue& queue, SearchState& state,
                      const ShouldStop& should_stop = {}) const {
    const auto n = start_vertex();
    const auto neighbours = [&](VertexId v, const auto& visit) {
      const Vec2 at = v == n ? links.start : positions_[v];
      for (const VertexId w : v == n ? std::span<const VertexId>(links.from_start) : graph_.neighbours(v)) {
        visit(w, distance(at, positions_[w]));
      }
      if (v == n ? links.direct : links.sees_goal[v] != 0) visit(n + 1, distance(at, links.goal));
    };
    const auto estimate = [&](VertexId v) {
      return !informed || v > n ? 0.0 : distance(v == n ? links.start : positions_[v], links.goal);
    };
    return best_first(n, n + 1, neighbours, estimate, queue, state, should_stop);
  }

 private:
  const VisibleCorners& corners_;
  SightLines which_;
  RawVector<Vec2> positions_;
  Graph graph_;
};

}  // namespace warren
