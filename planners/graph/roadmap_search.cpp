// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_search.hpp"

#include <span>
#include <type_traits>

#include "parallel/chunks.hpp"
#include "planners/graph/queue_choice.hpp"

namespace warren {
namespace {

/// Of the way to `to`; zero where there is none.
struct EstimateTo {
  VertexDistance estimate;
  VertexId to;
  double operator()(VertexId v) const { return to != no_vertex ? estimate(v, to) : 0.0; }
};
EstimateTo estimate_to(const ImplicitSearch& asked, VertexId to) {
  return {asked.estimate, asked.informed ? to : no_vertex};
}

/// NBA* (core/search/bidirectional_search.hpp), a thread an end: 17 bytes a vertex and end, and the queues.
/// neighbours[i]: of the side that begins at roots[i]; the two are called from two threads at once. states[i] keeps
/// what side i has reached. Throws Stopped at the deadline.
template <class Neighbours>
SearchResult search_from_both_ends(const std::array<Neighbours, 2>& neighbours, const std::array<VertexId, 2>& roots,
                                   const ImplicitSearch& asked, const std::array<SearchState*, 2>& states) {
  const std::size_t n = asked.vertex_count;
  const Execution& execution = asked.execution;
  ask_room(*states[0], n, 2 * (searched_bytes + 1), execution);
  const std::array<EstimateTo, 2> to_root{estimate_to(asked, roots[0]), estimate_to(asked, roots[1])};
  const SearchResult found = with_queue(asked.queue, 0, execution, [&](const auto& empty_queue) {
    using Queue = std::remove_cvref_t<decltype(empty_queue)>;
    struct alignas(bytes_apart) Side {
      Queue queue;
      std::optional<SearchSide<Queue, Neighbours, EstimateTo, EstimateTo>> search;
    };
    std::array<Side, 2> sides{Side{empty_queue, {}}, Side{empty_queue, {}}};
    // Both at once: the first touch of their memory is half of the cost. Few vertices do not repay a thread's start.
    const std::size_t grain = n < fewest_for_both_ends ? 2 : 1;
    for_each_index(2, grain, execution, [&](std::size_t i) {
      sides[i].search.emplace(roots[i], n, neighbours[i], to_root[1 - i], to_root[i], sides[i].queue, *states[i],
                              [&] { execution.check(); });
    });
    return bidirectional(*sides[0].search, *sides[1].search, execution);
  });
  if (found.status == SearchStatus::stopped) execution.check();
  return found;
}

/// The edges of a graph, as a search asks for them.
struct GraphEdges {
  const Graph& graph;
  const VertexDistance& length;
  template <class Visit>
  void operator()(VertexId v, const Visit& visit) const {
    const std::span<const VertexId> row = graph.neighbours(v);
    if (!graph.has_lengths()) {
      for (const VertexId w : row) visit(w, length(v, w));
      return;
    }
    const std::span<const double> lengths = graph.lengths(v);
    for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
  }
  void fetch(VertexId v) const { __builtin_prefetch(graph.neighbours(v).data()); }
  template <class Visit>
  void for_each_target(VertexId v, const Visit& visit) const {
    for (const VertexId w : graph.neighbours(v)) visit(w);
  }
};

/// A* or Dijkstra. `estimate`: between vertices of this graph, whatever `asked` says of another one.
SearchResult search_best(const Graph& graph, VertexId start, VertexId goal, const VertexDistance& estimate,
                         const RoadmapSearch& asked) {
  const GraphEdges neighbours{graph, asked.length};
  const ImplicitSearch best{estimate, asked.search == SearchKind::astar, asked.queue, graph.vertex_count(),
                            asked.execution};
  std::array<SearchState, 2> states;
  SearchResult found;
  if (best.vertex_count >= fewest_for_both_ends && asked.estimate_fits) {
    found = search_from_both_ends<GraphEdges>({neighbours, neighbours}, {start, goal}, best, {&states[0], &states[1]});
  } else {
    found = search_best_first(best.queue, best.vertex_count, start, goal, neighbours, estimate_to(best, goal),
                              states[0], best.execution);
  }
  if (found.status == SearchStatus::stopped) asked.execution.check();
  if (asked.tree != nullptr) *asked.tree = search_trees(states[0], states[1]);
  return found;
}

/// A search tree over keys as the tree over the vertices on their chains.
std::vector<Edge> expanded_tree(const TwiceReducedGraphView& reduced, const std::vector<Edge>& keys,
                                const Execution& execution) {
  std::vector<Edge> tree;
  for (const Edge& e : keys) {
    const RawVector<VertexId> chain = reduced.expand(std::array{e.from, e.to}, execution);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) tree.push_back({chain[i], chain[i + 1]});
  }
  return tree;
}

/// Breadth or depth first.
SearchResult search_blindly(const Graph& graph, const RoadmapSearch& asked) {
  SearchState state;
  SearchResult found = search_blindly(asked.search, graph, asked.start, asked.goal, state, asked.execution);
  if (found.status == SearchStatus::stopped) asked.execution.check();
  if (asked.tree != nullptr) *asked.tree = search_tree(state);
  return found;
}

}  // namespace

std::vector<Edge> search_tree(const SearchState& state) {
  std::vector<Edge> tree;
  for (const VertexId v : state.touched()) {
    if (state.parent(v) != no_vertex) tree.push_back({v, state.parent(v)});
  }
  return tree;
}

std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward) {
  std::vector<Edge> tree = search_tree(forward);
  for (const Edge& e : search_tree(backward)) {
    if (!forward.reached(e.from)) tree.push_back(e);
  }
  return tree;
}

bool is_stringy(const Graph& graph, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 16;
  const std::size_t n = graph.vertex_count();
  const std::size_t few = sum_of_chunks(n, grain, execution, [&](Range r) {
    std::size_t count = 0;
    for (std::size_t v = r.first; v < r.last; ++v) {
      count += static_cast<std::size_t>(graph.neighbours(static_cast<VertexId>(v)).size() <= 2);
    }
    return count;
  });
  return 2 * few >= n;
}

std::optional<TwiceReducedGraphView> reduced_for_search(const Graph& graph, const RoadmapSearch& asked) {
  if (!has_queue(asked.search) || !asked.estimate_fits) return std::nullopt;
  if (graph.vertex_count() < fewest_for_both_ends || !is_stringy(graph, asked.execution)) return std::nullopt;
  return TwiceReducedGraphView(graph, std::array{asked.start, asked.goal}, asked.length, asked.execution);
}

SearchResult search_roadmap(const Graph& graph, const RoadmapSearch& asked) {
  if (!has_queue(asked.search)) return search_blindly(graph, asked);
  return search_best(graph, asked.start, asked.goal, asked.estimate, asked);
}

SearchResult search_roadmap(const TwiceReducedGraphView& reduced, const RoadmapSearch& asked) {
  const auto estimate = [&](VertexId key, VertexId to) {
    return asked.estimate(reduced.vertex_of(key), reduced.vertex_of(to));
  };
  SearchResult found = search_best(reduced.graph(), reduced.key_of(asked.start), reduced.key_of(asked.goal),
                                   VertexDistance(estimate), asked);
  found.path = reduced.expand(found.path, asked.execution);
  if (asked.tree != nullptr) *asked.tree = expanded_tree(reduced, *asked.tree, asked.execution);
  return found;
}

SearchResult search_implicit(const AnyNeighbours& neighbours, VertexId from, VertexId to, const ImplicitSearch& asked,
                             SearchState& state) {
  return search_best_first(asked.queue, asked.vertex_count, from, to, neighbours, estimate_to(asked, to), state,
                           asked.execution);
}

SearchResult search_implicit_from_both_ends(const std::array<AnyNeighbours, 2>& neighbours,
                                            const std::array<VertexId, 2>& ends, const ImplicitSearch& asked,
                                            const std::array<SearchState*, 2>& states) {
  return search_from_both_ends(neighbours, ends, asked, states);
}

}  // namespace warren
