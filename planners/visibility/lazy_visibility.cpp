// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/lazy_visibility.hpp"

namespace warren {

SearchResult lazy_visibility_search(const VisibleCorners& corners, Vec2 start, Vec2 goal, const Execution& execution,
                                    Counters& counters, std::vector<Edge>* found) {
  constexpr std::uint64_t looks_per_poll = 64;
  const auto n = static_cast<VertexId>(corners.size());
  CornerSight sight(corners, execution);
  SearchState state;
  const auto poll = [&] { execution.check(); };
  state.resize(n + 2, poll);
  IndexedHeap<4> queue;
  queue.resize(n + 2, poll);
  std::vector<VertexId> seen;
  const auto at = [&](VertexId v) { return v < n ? corners.position(v) : v == n ? start : goal; };
  const auto neighbours = [&](VertexId v, const auto& visit) {
    if (++counters.neighbour_queries % looks_per_poll == 0) execution.check();
    if (v == n) {
      sight.from_point(start, SightLines::tangent, goal, seen);
    } else {
      sight.taut_from_vertex(v, at(state.parent(v)), goal, seen);
    }
    counters.edges_checked += seen.size();
    counters.edges_free += seen.size();
    for (const VertexId w : seen) {
      const VertexId to = w == CornerSight::target ? n + 1 : w;
      visit(to, distance(at(v), at(to)));
      if (found != nullptr) found->push_back({v, to});
    }
  };
  const auto estimate = [&](VertexId v) { return distance(at(v), goal); };
  return best_first(n, n + 1, neighbours, estimate, queue, state, NeverStop());
}

}  // namespace warren
