// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as plain arrays that it owns, and what building it took: whoever builds one gives these, and knows nothing
// of the roadmap as a value that is asked, updated and kept in a file (solve/kept/roadmap.hpp).
// And what searches in several threads learn of its edges.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "planners/graph/hierarchy.hpp"

namespace warren {

/// Of a state.
inline constexpr unsigned most_numbers = 14;

/// A roadmap as plain arrays, whoever holds them: what planners leave behind, files hold and exports write. Start and
/// goal are no part of it. Refers to arrays that live elsewhere. Any number of threads may read.
struct RoadmapParts {
  unsigned dimension =
      2;  ///< numbers a state: 2 (x, y), 3 (x, y, heading in radians), 4 to most_numbers (an arm's joints)
  bool directed = false;           ///< an edge leads from its row to its target alone; else each edge stands twice
  std::span<const double> states;  ///< `dimension` finite numbers a vertex
  std::span<const EdgeEnd> first;  ///< vertex_count + 1: the ends of vertex v are first[v] .. first[v + 1]
  std::span<const VertexId> to;    ///< where each edge end leads; the ends of a vertex ascend
  std::span<const std::uint64_t> edge_states;  ///< graph.hpp
  std::span<const VertexId> component;         ///< smallest vertex that free edges join each vertex with, any direction

  /// Milestones.
  std::size_t vertex_count() const { return first.empty() ? 0 : first.size() - 1; }
  /// Undirected edges once, directed ones each.
  std::size_t edge_count() const { return directed ? to.size() : to.size() / 2; }
  /// The numbers of a milestone.
  std::span<const double> state(VertexId v) const { return states.subspan(std::size_t{v} * dimension, dimension); }
  /// Ends of the edges of v, ascending.
  std::span<const VertexId> neighbours(VertexId v) const { return to.subspan(first[v], first[v + 1] - first[v]); }
  /// What is known of the edge with this end.
  EdgeState state_of_end(std::size_t end) const { return edge_state(edge_states, end); }
};

/// States and edges, owned. An edge that leads both ways stands in both its rows.
struct RoadmapArrays {
  unsigned dimension = 2;                ///< numbers a state
  bool directed = false;                 ///< do edges lead one way?
  RawVector<double> states;              ///< `dimension` numbers each
  Graph candidates;                      ///< edges that are free, blocked or unchecked
  RawVector<std::uint64_t> edge_states;  ///< two bits an edge end (core/search/graph.hpp)
  RawVector<VertexId> component;         ///< a number each state: the same where free edges join them
  Hierarchy hierarchy;                   ///< of the free edges; empty: there is none

  /// Views of all of it.
  RoadmapParts parts() const {
    return {dimension, directed, states, candidates.offsets(), candidates.targets(), edge_states, component};
  }
};

/// Points of the plane, at(v), and these edges, all of them free; no components yet. Throws Stopped.
template <class At>
RoadmapArrays free_arrays(const At& at, Graph graph, const Execution& execution) {
  const std::size_t n = graph.vertex_count();
  const std::size_t ends = graph.targets().size();
  execution.reserve(2 * n * sizeof(double) + ends / 4);
  RoadmapArrays arrays;
  arrays.states.reserve(2 * n);
  for (VertexId v = 0; v < n; ++v) {
    execution.poll(v);
    const Vec2 p = at(v);
    arrays.states.insert(arrays.states.end(), {p.x, p.y});
  }
  constexpr std::uint64_t all_free = 0x5555555555555555U;
  assign_polled(arrays.edge_states, edge_state_words(ends), all_free, [&] { execution.check(); });
  const std::size_t used = ends % edge_states_in_word;
  if (used != 0) arrays.edge_states.back() >>= 2 * (edge_states_in_word - used);
  arrays.candidates = std::move(graph);
  return arrays;
}

/// What searches in several threads learn of the edges of one roadmap. The world gives each of them the same answer for
/// an edge, and an answer only sets bits of an edge that has none: so the order of the threads does not matter.
class SharedEdgeStates {
 public:
  /// Copies them: two bits an edge.
  explicit SharedEdgeStates(std::span<const std::uint64_t> words) : words_(words.begin(), words.end()) {}
  /// Of these, which become its own.
  explicit SharedEdgeStates(RawVector<std::uint64_t>&& words) : words_(std::move(words)) {}

  /// What is known of the edge now. Any thread may call it.
  EdgeState operator[](std::size_t end) const {
    const std::uint64_t word = word_of(end).load(std::memory_order_relaxed);
    return static_cast<EdgeState>(word >> shift_of(end) & 3U);
  }
  /// What the world says of an edge that was unchecked: free or blocked. Any thread may call it.
  void learn(std::size_t end, EdgeState state) const {
    word_of(end).fetch_or(static_cast<std::uint64_t>(state) << shift_of(end), std::memory_order_relaxed);
  }
  /// As they are now; while nobody learns.
  std::span<const std::uint64_t> words() const { return words_; }
  /// The same for good: it is of no use then.
  RawVector<std::uint64_t> taken() && { return std::move(words_); }

 private:
  std::atomic_ref<std::uint64_t> word_of(std::size_t end) const {
    return std::atomic_ref<std::uint64_t>(words_[end / edge_states_in_word]);
  }
  static std::size_t shift_of(std::size_t end) { return 2 * (end % edge_states_in_word); }

  mutable RawVector<std::uint64_t> words_;
};

/// What building took.
struct BuildAccount {
  Counters counters;   ///< exact, the same for any number of threads
  StageTimes seconds;  ///< wall-clock
};

/// Holds the arrays of a roadmap against what RoadmapParts promises, so that nobody who reads them afterwards can look
/// beyond an array or go round for ever, whoever made them: right checksums prove nothing about meaning.
///
/// First the sizes, then every element in parallel, each rule in a pass of its own and each pass only over what the
/// ones before it have found sound. An edge's other end is found by a search in its row, from the lower vertex alone:
/// where each of these has its twin and both kinds are as many, all have one. Components are computed again from the
/// free edges by a lock-free union and compared. O(V + E log degree) time; memory: 4 bytes a vertex. Throws InputError,
/// which names the array, the first element that breaks its rule and what it is, as part of `where`; Stopped. The same
/// error for any number of threads.
void check_parts(const RoadmapParts& parts, const std::string& where, const Execution& execution);

/// Which vertices of a roadmap are joined by edges that are known to be free, whatever their direction. O(E α(V)), on
/// all threads by a lock-free union; the same labels whatever the order of the unions. For each vertex the smallest one
/// of its component. `parts` needs no components of its own. Throws Stopped.
RawVector<VertexId> free_components(const RoadmapParts& parts, const Execution& execution);

/// A roadmap as a planner leaves it behind, for pictures and second queries: milestones in tile order with start and
/// goal as the last two, the graph over them, and the search's tree.
template <class State>
struct PlannedRoadmap {
  RawVector<State> states;         ///< milestones, then start, then goal
  Graph graph;                     ///< free edges; lazy planners: the edges that were checked and found free
  std::vector<Edge> search_tree;   ///< (vertex, parent) of every vertex that the search reached
  std::vector<Edge> motions = {};  ///< trees that grow: each motion from where it begins to where it ends
};

}  // namespace warren
