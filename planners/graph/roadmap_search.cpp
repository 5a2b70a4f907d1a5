// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_search.hpp"

#include <string>
#include <type_traits>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"

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
  if (has_queue(asked.search)) return search_best(graph, asked.start, asked.goal, asked.estimate, asked);
  SearchState state;
  SearchResult found = search_blindly(asked.search, graph, asked.start, asked.goal, state, asked.execution);
  if (found.status == SearchStatus::stopped) asked.execution.check();
  if (asked.tree != nullptr) *asked.tree = search_tree(state);
  return found;
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

KeyCoverView::KeyCoverView(const Graph& graph, std::span<const VertexId> keep, Peeling peeling,
                           const Execution& execution)
    : graph_(&graph) {
  const std::size_t n = graph.vertex_count();
  execution.reserve(n + n / 5);
  left_.resize(n);
  keys_.resize(chunk_count(n, 64));
  rank_.resize(chunk_count(n, 64) + 1);
  const Execution quiet = execution.quiet();
  for_chunks(n, detail::reduce_grain, quiet,
             [&](Range r) { std::fill(left_.data() + r.first, left_.data() + r.last, std::uint8_t{1}); });
  for (const VertexId v : keep) {
    if (v >= n) throw InputError("reduce_graph", "a vertex to keep is not in the graph", std::to_string(v));
    left_[v] = 2;
  }
  const std::vector<Peeled> peeled =
      parts_of_chunks(n, detail::reduce_grain, quiet, [&](Range r) { return peel_block(r); });
  for (const Peeled& block : peeled) peeled_trees_ += block.trees;
  for_chunks(peeling == Peeling::everywhere ? peeled.size() : 0, 1, quiet, [&](Range r) {
    for (const VertexId v : peeled[r.first].seeds) peel_across(v, execution);
  });
  for_chunks(n, detail::reduce_grain, quiet, [&](Range r) { mark_keys(r, peeling); });
  rank_.back() = 0;
  exclusive_scan(rank_, quiet);
}

/// Neighbours outside the block count as left, so a vertex that is peeled here has none of them, and no other thread
/// reads or writes what decides. The seeds are where peel_across has to begin.
KeyCoverView::Peeled KeyCoverView::peel_block(Range block) {
  const auto first = static_cast<VertexId>(block.first);
  const auto size = static_cast<VertexId>(block.size());
  std::vector<std::uint32_t> degree(size);
  for (VertexId i = 0; i < size; ++i) degree[i] = static_cast<std::uint32_t>(graph_->degree(first + i));
  Peeled peeled;
  for (VertexId scan = 0; scan < size; ++scan) {
    for (VertexId i = scan; i <= scan && degree[i] <= 1 && left_[first + i] == 1;) {  // a larger one comes later
      VertexId last = no_vertex;
      for (const VertexId w : graph_->neighbours(first + i)) last = w - first >= size || left_[w] != 0 ? w : last;
      if (last != no_vertex && last - first >= size) {
        peeled.seeds.push_back(first + i);
        break;
      }
      left_[first + i] = 0;
      if (last == no_vertex) {
        ++peeled.trees;
        break;
      }
      i = last - first;
      --degree[i];
    }
  }
  return peeled;
}

/// Follows dead ends wherever they lead. Whoever peels a vertex looks at its last neighbour afterwards; sequentially
/// consistent order makes the last of several peelers see all the others' work, so no vertex is forgotten.
void KeyCoverView::peel_across(VertexId seed, const Execution& execution) {
  std::size_t steps = 0;
  for (VertexId v = seed; v != no_vertex && std::atomic_ref(left_[v]).load() == 1;) {
    unsigned left = 0;
    VertexId last = no_vertex;
    for (const VertexId w : graph_->neighbours(v)) {
      if (std::atomic_ref(left_[w]).load() == 0) continue;
      last = w;
      if (++left > 1) return;
    }
    if (std::atomic_ref(left_[v]).exchange(0) == 0) return;
    v = last;
    execution.poll(++steps);
  }
}

void KeyCoverView::mark_keys(Range block, Peeling peeling) {
  const auto first = static_cast<VertexId>(block.first);
  const auto size = static_cast<VertexId>(block.size());
  const bool within = peeling == Peeling::within_blocks;
  for (std::size_t word = block.first / 64; word * 64 < block.last; ++word) {
    std::uint64_t bits = 0;
    const auto end = static_cast<VertexId>(std::min(block.last, word * 64 + 64));
    for (auto v = static_cast<VertexId>(word * 64); v < end; ++v) {
      if (left_[v] == 0) continue;
      unsigned left = 0;
      bool is_key = left_[v] == 2;
      for (const VertexId w : graph_->neighbours(v)) {
        left += left_[w] != 0 ? 1U : 0U;
        is_key |= within && w - first >= size;
      }
      bits |= std::uint64_t{is_key || left != 2} << v % 64;
    }
    keys_[word] = bits;
    rank_[word] = static_cast<VertexId>(std::popcount(bits));
  }
}

ReducedGraphView::ReducedGraphView(KeyCoverView cover, const std::vector<Part>& parts, RawVector<EdgeEnd> degrees,
                                   const Execution& execution)
    : cover_(std::move(cover)) {
  std::vector<std::size_t> begins(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) begins[p + 1] = begins[p] + parts[p].chains.size();
  for (const Part& part : parts) cycles_ += part.cycles;
  const Execution quiet = execution.quiet();
  execution.reserve(begins.back() * (2 * sizeof(VertexId) + sizeof(double)));
  exclusive_scan(degrees, quiet);
  RawVector<VertexId> targets(begins.back());
  RawVector<double> lengths(begins.back());
  via_.resize(begins.back());
  vertices_.resize(cover_.key_count());
  for_each_index(parts.size(), 16, quiet, [&](std::size_t p) {
    std::size_t at = begins[p];
    for (const Chain& chain : parts[p].chains) {
      targets[at] = chain.target;
      lengths[at] = chain.length;
      via_[at++] = chain.via;
    }
  });
  for_each_index<VertexId>(cover_.graph().vertex_count(), detail::reduce_grain, quiet, [&](VertexId v) {
    if (cover_.is_key(v)) vertices_[cover_.rank(v)] = v;
  });
  reduced_ = Graph(std::move(degrees), std::move(targets), std::move(lengths));
}

RawVector<VertexId> ReducedGraphView::expand(std::span<const VertexId> keys, const Execution& execution) const {
  constexpr std::size_t keys_a_part = 1024;
  const Execution quiet = execution.quiet();
  const auto parts = parts_of_chunks(keys.size(), keys_a_part, quiet, [&](Range r) {
    RawVector<VertexId> part;
    if (r.first == 0) part.push_back(vertex_of(keys.front()));
    for (std::size_t i = std::max<std::size_t>(r.first, 1); i < r.last; ++i) {
      VertexId before = vertex_of(keys[i - 1]);
      VertexId v = via_[reduced_.end_to(keys[i - 1], keys[i])];
      while (!cover_.is_key(v)) {
        execution.poll(part.size());
        part.push_back(v);
        v = cover_.next_on_chain(std::exchange(before, v), v);
      }
      part.push_back(v);
    }
    return part;
  });
  return joined_parts(parts, quiet);
}

}  // namespace warren
