// SPDX-License-Identifier: BSD-3-Clause
// Searches an explicit roadmap; how follows from the options and from counts. Compiled once for the roadmaps of all
// worlds: what a search asks of the world is a distance between two vertices.
//
// A* and Dijkstra, from 50,000 vertices on: where most vertices are dead ends or links of chains (lattices) the roadmap
// is reduced first (TwiceReducedGraphView) and its keys are searched; the expanded path is as long as the plain one.
// Else (uniform sampling, where every doorway is crossed by several edges and next to nothing could be peeled) the
// search runs from both ends. Smaller roadmaps, and breadth- and depth-first search: plainly, on one thread.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/function_ref.hpp"
#include "core/run/execution.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

// The exact reduction that shortest paths allow: dead ends are peeled (vertices of degree 1, again and again) and
// chains of degree-2 vertices become one edge, so that a search runs on the junctions alone. On a perfect maze only the
// path is left.
//
// Peeling: each block of vertices first peels what has all its neighbours in the block, in cache and without atomics;
// then all threads together follow the dead ends that are left across the blocks. What is left is the same in any
// order: the largest set in which all but the kept vertices have degree 2 or more. Its vertices of another degree than
// 2, and the kept ones, are the *keys*; each key follows its chains by itself, so a chain is walked once from either
// end (within a block, once for both). Loops and all but the shortest chain between two keys are dropped (ties: the
// smaller first vertex).
//
// Large graphs are reduced twice (TwiceReducedGraphView): first each block of vertices for itself, whose chains end
// where they leave the block, so that all of it happens in cache; then what that left, a tenth to a twentieth of the
// vertices, as a whole. The keys are the same or fewer: where the first step drops a longer one of two chains, the
// second can peel more. On the way the components are counted, by the keys that the first step leaves, the trees that
// it peels wholly and the cycles that have no key, so that the whole graph is not asked.
//
// For graphs that are there: a maze's tiles are reduced before there is one (planners/mazes/tile_plane.hpp). O(V + E).
// Memory: 1.2 bytes a vertex, and 20 bytes an edge end of the reduced graph. Measured in bench/search_bench.cpp.

/// Dead ends are followed through the whole graph, or as far as their block of vertices.
enum class Peeling : std::uint8_t { everywhere, within_blocks };

/// Which vertices of a graph are left, and which of them are keys. Refers to the graph.
class KeyCoverView {
 public:
  /// keep: vertices that must stay (start and goal); any number, in any order.
  /// Peeling within blocks: keys are also the vertices with a neighbour in another block.
  KeyCoverView(const Graph& graph, std::span<const VertexId> keep, Peeling peeling, const Execution& execution);

  std::size_t key_count() const { return rank_.back(); }
  bool is_key(VertexId v) const { return (keys_[v / 64] >> v % 64 & 1U) != 0; }
  bool is_left(VertexId v) const { return left_[v] != 0; }
  /// Number of a key among the keys, ascending.
  VertexId rank(VertexId key) const {
    return rank_[key / 64] +
           static_cast<VertexId>(std::popcount(keys_[key / 64] & ((std::uint64_t{1} << key % 64) - 1)));
  }
  /// The vertex after `at` on a chain that was entered from `before`; `at` is no key.
  VertexId next_on_chain(VertexId before, VertexId at) const {
    for (const VertexId w : graph_->neighbours(at)) {
      if (w != before && is_left(w)) return w;
    }
    return no_vertex;
  }
  const Graph& graph() const { return *graph_; }
  /// Trees of the graph of which nothing is left. Only where peeling stays within blocks.
  std::size_t peeled_trees() const { return peeled_trees_; }

 private:
  struct Peeled {
    std::vector<VertexId> seeds;  // vertices whose last neighbour lies outside the block
    std::size_t trees = 0;        // that lay in the block as a whole
  };
  Peeled peel_block(Range block);
  void peel_across(VertexId seed, const Execution& execution);
  void mark_keys(Range block, Peeling peeling);

  const Graph* graph_;
  std::size_t peeled_trees_ = 0;
  RawVector<std::uint8_t> left_;   // 0 peeled, 1 left, 2 left and never to be peeled
  RawVector<std::uint64_t> keys_;  // one bit a vertex
  RawVector<VertexId> rank_;       // keys before each word of keys_, and all
};

/// The keys as a graph with lengths. Refers to the graph that it was made from. Any number of threads may read.
class ReducedGraphView {
 public:
  /// One edge end of a key: number of the key at the other end, length of the chain, and its first vertex.
  struct Chain {
    VertexId target;
    VertexId via;
    double length;
  };
  /// What a block of vertices gives: the chains of its keys, row by row, and how many cycles in it have no key.
  struct Part {
    std::vector<Chain> chains;
    std::size_t cycles = 0;
  };
  ReducedGraphView(KeyCoverView cover, const std::vector<Part>& parts, RawVector<EdgeEnd> degrees,
                   const Execution& execution);

  const Graph& graph() const { return reduced_; }  ///< vertices are numbers of keys
  VertexId vertex_of(VertexId key) const { return vertices_[key]; }
  /// The key with this vertex, which must be a key: start and goal always are.
  VertexId key_of(VertexId vertex) const { return cover_.rank(vertex); }
  /// Components of the graph that no key stands for. Only where peeling stays within blocks.
  std::size_t keyless_components() const { return cover_.peeled_trees() + cycles_; }
  /// A path over keys as the path over vertices that it stands for. O(path).
  RawVector<VertexId> expand(std::span<const VertexId> keys, const Execution& execution) const;

 private:
  KeyCoverView cover_;
  std::size_t cycles_ = 0;
  Graph reduced_;
  RawVector<VertexId> via_;       // of each edge end: first vertex of its chain
  RawVector<VertexId> vertices_;  // of each key
};

namespace detail {
inline constexpr std::size_t reduce_grain = std::size_t{1} << 14;  // a multiple of 64: key words are not shared

/// A chain from one key to another: the keys' neighbours on it, and its length.
struct ChainEnds {
  VertexId from, via, last, to;
  double length;
};

/// Follows the chain that leaves `key` towards `via`; next(before, at) is the vertex after `at`.
template <class Next, class Length>
ChainEnds follow_chain(const KeyCoverView& cover, VertexId key, VertexId via, const Next& next_on_chain,
                       const Length& length, const Execution& execution) {
  double sum = length(key, via);
  VertexId before = key;
  VertexId at = via;
  for (std::size_t steps = 1; !cover.is_key(at); ++steps) {
    execution.poll(steps);
    const VertexId next = next_on_chain(before, at);
    sum += length(at, next);
    before = std::exchange(at, next);
  }
  return {key, via, before, at, sum};
}

/// Sorts the row of a key and leaves one chain to each other key, the shortest; no loops.
inline void finish_row(VertexId self, std::vector<ReducedGraphView::Chain>& row) {
  using Chain = ReducedGraphView::Chain;
  std::erase_if(row, [self](const Chain& chain) { return chain.target == self; });
  std::ranges::sort(row, {}, [](const Chain& chain) { return std::tuple(chain.target, chain.length, chain.via); });
  const auto same_target = [](const Chain& a, const Chain& b) { return a.target == b.target; };
  row.erase(std::unique(row.begin(), row.end(), same_target), row.end());
}

/// Calls row(chains) for each key of the block in turn: its chains, each followed from this end, in any order.
template <class Length, class Row>
void for_each_key(const KeyCoverView& cover, Range block, const Length& length, const Execution& execution,
                  const Row& row) {
  const auto next = [&cover](VertexId before, VertexId at) { return cover.next_on_chain(before, at); };
  std::vector<ReducedGraphView::Chain> chains;
  for (auto key = static_cast<VertexId>(block.first); key < block.last; ++key) {
    if (!cover.is_key(key)) continue;
    chains.clear();
    for (const VertexId via : cover.graph().neighbours(key)) {
      if (!cover.is_left(via)) continue;
      const ChainEnds chain = follow_chain(cover, key, via, next, length, execution);
      chains.push_back({cover.rank(chain.to), via, chain.length});
    }
    row(key, chains);
  }
}

/// What the vertices on a block's chains are linked to: the exclusive or of their two neighbours that are left, so that
/// one neighbour gives the other without a look at the graph. Of other vertices, nothing.
class ChainLinks {
 public:
  ChainLinks(const KeyCoverView& cover, Range block) : first_(static_cast<VertexId>(block.first)), link_(block.size()) {
    for (VertexId i = 0; i < link_.size(); ++i) {
      const VertexId v = first_ + i;
      if (!cover.is_left(v) || cover.is_key(v)) continue;
      VertexId link = 0;
      for (const VertexId w : cover.graph().neighbours(v)) link ^= cover.is_left(w) ? w : 0;
      link_[i] = link;
      ++count_;
    }
  }
  std::size_t count() const { return count_; }  ///< vertices that are linked
  VertexId next(VertexId before, VertexId at) const { return link_[at - first_] ^ before; }

 private:
  VertexId first_;
  std::size_t count_ = 0;
  RawVector<VertexId> link_;
};

/// Cycles of a block that have no key: the block's chains, which are marked, are all its linked vertices but theirs.
inline std::size_t keyless_cycles(const KeyCoverView& cover, Range block, const ChainLinks& links,
                                  const std::vector<ChainEnds>& chains) {
  const auto first = static_cast<VertexId>(block.first);
  std::vector<std::uint8_t> marked(block.size(), 0);
  const auto mark = [&](VertexId before, VertexId at) {
    while (!cover.is_key(at) && marked[at - first] == 0) {
      marked[at - first] = 1;
      before = std::exchange(at, links.next(before, at));
    }
  };
  for (const ChainEnds& chain : chains) mark(chain.from, chain.via);
  std::size_t cycles = 0;
  for (VertexId v = first; v < block.last; ++v) {
    if (!cover.is_left(v) || cover.is_key(v) || marked[v - first] != 0) continue;
    ++cycles;
    const std::span<const VertexId> row = cover.graph().neighbours(v);
    mark(*std::find_if(row.begin(), row.end(), [&](VertexId w) { return cover.is_left(w); }), v);
  }
  return cycles;
}

/// The same where no chain leaves its block: each is followed once, for both of its ends. Returns the number of cycles
/// that have no key.
template <class Length, class Row>
std::size_t for_each_key_of_block(const KeyCoverView& cover, Range block, const Length& length,
                                  const Execution& execution, const Row& row) {
  const auto first = static_cast<VertexId>(block.first);
  const ChainLinks links(cover, block);
  std::size_t steps = 0;
  const auto next = [&](VertexId before, VertexId at) {
    ++steps;
    return links.next(before, at);
  };
  std::vector<std::uint8_t> followed(block.size(), 0);  // by the neighbour of the key at its other end
  std::vector<ChainEnds> found;
  std::vector<std::uint32_t> begins(block.size() + 1, 0);
  for (VertexId key = first; key < block.last; ++key) {
    if (!cover.is_key(key)) continue;
    for (const VertexId via : cover.graph().neighbours(key)) {
      if (!cover.is_left(via)) continue;
      if (cover.is_key(via)) {  // in this block or another: each end speaks for itself
        found.push_back({key, via, no_vertex, via, length(key, via)});
        ++begins[key - first];
      } else if (followed[via - first] == 0) {
        const ChainEnds chain = follow_chain(cover, key, via, next, length, execution);
        followed[chain.last - first] = 1;
        found.push_back(chain);
        ++begins[key - first];
        ++begins[chain.to - first];
      }
    }
  }
  std::exclusive_scan(begins.begin(), begins.end(), begins.begin(), std::uint32_t{0});
  std::vector<ReducedGraphView::Chain> placed(begins.back());
  for (const ChainEnds& chain : found) {
    placed[begins[chain.from - first]++] = {cover.rank(chain.to), chain.via, chain.length};
    if (chain.last != no_vertex)
      placed[begins[chain.to - first]++] = {cover.rank(chain.from), chain.last, chain.length};
  }
  std::vector<ReducedGraphView::Chain> chains;  // begins[i] has become the end of row i
  for (VertexId key = first; key < block.last; ++key) {
    if (!cover.is_key(key)) continue;
    const std::size_t i = key - first;
    const auto at = [&](std::size_t place) { return placed.begin() + static_cast<std::ptrdiff_t>(place); };
    chains.assign(at(i == 0 ? 0 : begins[i - 1]), at(begins[i]));
    row(key, chains);
  }
  return steps == links.count() ? 0 : keyless_cycles(cover, block, links, found);
}
}  // namespace detail

/// Peels and contracts; start, goal and whatever else stands in `keep` become keys. length(v, w) > 0 is called for
/// neighbours by several threads at once; a path's length is the sum of its chains', exact up to rounding. `graph` has
/// no duplicate edges and must outlive the result.
template <class Length>
ReducedGraphView reduce_graph(const Graph& graph, std::span<const VertexId> keep, const Length& length,
                              const Execution& execution, Peeling peeling = Peeling::everywhere) {
  KeyCoverView cover(graph, keep, peeling, execution);
  const std::size_t n = graph.vertex_count();
  std::vector<ReducedGraphView::Part> parts(chunk_count(n, detail::reduce_grain));
  RawVector<EdgeEnd> degrees(cover.key_count() + 1, 0);
  for_chunks(n, detail::reduce_grain, execution, [&](Range r) {
    ReducedGraphView::Part& part = parts[r.first / detail::reduce_grain];
    const auto add_row = [&](VertexId key, std::vector<ReducedGraphView::Chain>& row) {
      detail::finish_row(cover.rank(key), row);
      part.chains.insert(part.chains.end(), row.begin(), row.end());
      degrees[cover.rank(key)] = static_cast<EdgeEnd>(row.size());
    };
    if (peeling == Peeling::within_blocks) {
      part.cycles = detail::for_each_key_of_block(cover, r, length, execution, add_row);
    } else {
      detail::for_each_key(cover, r, length, execution, add_row);
    }
  });
  return ReducedGraphView(std::move(cover), parts, std::move(degrees), execution);
}

/// A graph reduced block by block, and what that leaves reduced again: the same questions as ReducedGraphView.
class TwiceReducedGraphView {
 public:
  template <class Length>
  TwiceReducedGraphView(const Graph& graph, std::span<const VertexId> keep, const Length& length,
                        const Execution& execution)
      : blocks_(
            std::make_unique<ReducedGraphView>(reduce_graph(graph, keep, length, execution, Peeling::within_blocks))),
        components_(components(blocks_->graph(), execution)),
        whole_(reduce_graph(
            blocks_->graph(), keys_of(keep),
            [&left = blocks_->graph()](VertexId v, VertexId w) {
              const std::span<const VertexId> row = left.neighbours(v);
              return left.lengths(v)[static_cast<std::size_t>(std::find(row.begin(), row.end(), w) - row.begin())];
            },
            execution)) {}

  const Graph& graph() const { return whole_.graph(); }  ///< vertices are numbers of keys
  VertexId vertex_of(VertexId key) const { return blocks_->vertex_of(whole_.vertex_of(key)); }
  VertexId key_of(VertexId vertex) const { return whole_.key_of(blocks_->key_of(vertex)); }
  /// Of the graph as it was.
  std::size_t component_count() const { return components_.count + blocks_->keyless_components(); }
  /// Are two vertices in one component? Both must be kept ones.
  bool connected(VertexId v, VertexId w) const { return components_.connected(blocks_->key_of(v), blocks_->key_of(w)); }
  RawVector<VertexId> expand(std::span<const VertexId> keys, const Execution& execution) const {
    return blocks_->expand(whole_.expand(keys, execution), execution);
  }

 private:
  std::vector<VertexId> keys_of(std::span<const VertexId> vertices) const {
    std::vector<VertexId> keys;
    for (const VertexId v : vertices) keys.push_back(blocks_->key_of(v));
    return keys;
  }

  std::unique_ptr<ReducedGraphView> blocks_;  // whole_ refers to its graph, wherever this is moved to
  Components components_;                     // of that graph
  ReducedGraphView whole_;
};

/// Vertices from which on a search runs from both ends. The number of vertices alone decides, so that path and counters
/// are the same for any number of threads: two threads do not repay their start on small roadmaps.
inline constexpr std::size_t fewest_for_both_ends = 50'000;

/// A function of two vertices, such as the world's distance between their states. Called by several threads at once.
using VertexDistance = FunctionRef<double(VertexId, VertexId)>;

/// What a search of a roadmap needs besides the graph. Where the graph has lengths, `length` is not called.
struct RoadmapSearch {
  VertexId start;
  VertexId goal;
  VertexDistance length;    ///< of an edge
  VertexDistance estimate;  ///< of the way between any two: at most its length; asked by A* alone
  SearchKind search;
  QueueKind queue;
  const Execution& execution;
  std::vector<Edge>* tree = nullptr;  ///< receives (vertex, parent) of what the search reached
  bool estimate_fits = true;          ///< false: it may be too long; the graph itself is searched, from the start alone
};

/// (vertex, parent) of every vertex that a search reached.
std::vector<Edge> search_tree(const SearchState& state);
/// The same of a search from both ends; what both have reached has the first one's parent.
std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward);

/// Are at least half of the vertices of degree 2 or less? On lattices of mazes 80 % are, in uniform roadmaps 1 %.
bool is_stringy(const Graph& graph, const Execution& execution);

/// What is to be searched instead of the roadmap, start and goal kept; nothing where the roadmap itself is. Refers to
/// the graph.
std::optional<TwiceReducedGraphView> reduced_for_search(const Graph& graph, const RoadmapSearch& asked);

/// Searches the graph, or the keys of a reduced one: then the path is of the vertices that they stand for. Throws
/// Stopped at the deadline.
SearchResult search_roadmap(const Graph& graph, const RoadmapSearch& asked);
SearchResult search_roadmap(const TwiceReducedGraphView& reduced, const RoadmapSearch& asked);

/// What a search of a graph needs that expands its vertices itself, as lazily checked roadmaps do.
struct ImplicitSearch {
  VertexDistance estimate;  ///< of the way between any two: consistent; asked where informed alone
  bool informed;            ///< false: Dijkstra
  QueueKind queue;
  std::size_t vertex_count;
  const Execution& execution;
};

/// From `from` to `to`, or (no_vertex) to all that can be reached. Whether it was stopped is in the result.
SearchResult search_implicit(const AnyNeighbours& neighbours, VertexId from, VertexId to, const ImplicitSearch& asked,
                             SearchState& state);
/// From both ends; an end's neighbours and state are its own. Throws Stopped.
SearchResult search_implicit_from_both_ends(const std::array<AnyNeighbours, 2>& neighbours,
                                            const std::array<VertexId, 2>& ends, const ImplicitSearch& asked,
                                            const std::array<SearchState*, 2>& states);

// The one place where a search of a graph and its queue are chosen, once a search.
// And the rounds of core/search/bidirectional_search.hpp with a thread for each side: the same path, length and counts
// as on one thread. The first rounds are too short to pay for a thread.

/// An array kept in order: one insertion costs as much as thousands into a heap, so each looks at the deadline.
template <class Queue>
class PolledArray : public Queue {
 public:
  explicit PolledArray(const Execution& execution) : execution_(&execution) {}
  void push(VertexId v, double key) {
    execution_->check();
    Queue::push(v, key);
  }

 private:
  const Execution* execution_;
};

/// Calls f with an empty queue of the kind, ready for vertex_count vertices. Throws Stopped.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const Execution& execution, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count, [&] { execution.check(); });
    return f(queue);
  };
  if (kind == QueueKind::heap) return call(IndexedHeap<4>());
  if (kind == QueueKind::lazy_heap) return call(LazyHeap());
  if (kind == QueueKind::sorted_array) return call(PolledArray<SortedArray>(execution));
  return call(PolledArray<ResortedArray>(execution));
}

/// A vertex of a search that has all of them in its heap: its way and parent, its place in the heap and its entry.
inline constexpr std::size_t searched_bytes = sizeof(double) + 2 * sizeof(VertexId) + sizeof(QueueEntry);

/// Asks for what a search of so many vertices takes, its queue included, where the state has to grow. Throws Stopped.
inline void ask_room(const SearchState& state, std::size_t vertex_count, std::size_t bytes_a_vertex,
                     const Execution& execution) {
  if (state.vertex_count() < vertex_count) execution.reserve(vertex_count * bytes_a_vertex);
}

/// A* or Dijkstra, by the estimate, over vertex_count vertices, which the state is sized for. Whether it was stopped is
/// in the result; sizing throws Stopped.
template <class Neighbours, class Estimate>
SearchResult search_best_first(QueueKind kind, std::size_t vertex_count, VertexId start, VertexId goal,
                               const Neighbours& neighbours, const Estimate& estimate, SearchState& state,
                               const Execution& execution) {
  ask_room(state, vertex_count, searched_bytes, execution);
  state.resize(vertex_count, [&] { execution.check(); });
  return with_queue(kind, vertex_count, execution, [&](auto& queue) {
    return best_first(start, goal, neighbours, estimate, queue, state, [&] { return execution.should_stop(); });
  });
}

/// The blind search of this kind, as search_best_first.
inline SearchResult search_blindly(SearchKind search, const Graph& graph, VertexId start, VertexId goal,
                                   SearchState& state, const Execution& execution) {
  constexpr std::size_t bytes_a_vertex = 24;  // the state's 12, and 8 of the deepest path, more while its list moves
  ask_room(state, graph.vertex_count(), bytes_a_vertex, execution);
  state.resize(graph.vertex_count(), [&] { execution.check(); });
  const auto should_stop = [&] { return execution.should_stop(); };
  return search == SearchKind::bfs ? breadth_first(graph, start, goal, state, should_stop)
                                   : depth_first(graph, start, goal, state, should_stop);
}

/// Both sides, on two threads where execution.threads allows it. Throws what a side's callables throw.
template <class Forward, class Backward>
SearchResult bidirectional(Forward& forward, Backward& backward, const Execution& execution) {
  constexpr std::uint64_t rounds_alone = 5;
  const auto together = [&](std::uint64_t round, const auto& first, const auto& second) {
    round < rounds_alone ? InTurn()(round, first, second) : run_both(execution, first, second);
  };
  return bidirectional(
      forward, backward, [&] { return execution.should_stop(); }, together);
}

}  // namespace warren
