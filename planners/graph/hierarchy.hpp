// SPDX-License-Identifier: BSD-3-Clause
// A contraction hierarchy of a roadmap's free edges (Geisberger, Sanders, Schultes, Delling 2008): vertices were taken
// out one after the other, and each keeps arcs to those alone that were left, edges or shortcuts over earlier ones. So
// between any two vertices some shortest way climbs by arcs from both ends and meets. Plain arrays, as a file may hold
// them: 4 bytes a vertex and 16 an arc. Rows stand in the order of the roadmap's vertices, which follows the plane, not
// in that of taking out: taking a way apart reads rows that lie together.
//
// Questions to a hierarchy: the shortest way between two places that are joined to some of its vertices. Both ends
// climb by Dijkstra's search, the one whose next vertex is nearer first; a vertex to which a way from above is shorter
// is not climbed from (stalling), and neither end goes on beyond the best way found. Then each arc is taken apart into
// the edges that it stands for. Exact but for rounding: a way that is longer by less than that may be taken.
//
// It is made of an undirected graph. Vertices are taken out in rounds: in each all those whose key, from their degree
// and how much was taken out around them, is below their neighbours', so that no two of them are neighbours and all can
// go at once; shortcuts keep the lengths between what is left (witnesses say which are needed).
// Everything is a function of the graph: the same bytes for any number of threads.
//
// Where ways through a place are few, as in corridors, what is left grows no denser, and a question climbs through a
// few hundred vertices. In open space it does: then nobody gains, and counting says so, first in samples of the graph,
// later while it is made, at last by asking it.
// Cost: 800,000 milestones in a maze of 300 x 300 cells with 10 % loops, 5 million edges: 6 s on two busy cores, 1.3
// arcs an edge. The searches for witnesses are nearly all of it: fewer looks make it slower, for the shortcuts that are
// too many cost more later (60 instead of 120 settled vertices: 1.7 times the arcs that a question looks at).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"

namespace warren {

struct HierarchyArc {
  VertexId to;      ///< a vertex taken out later; they ascend in each row
  VertexId middle;  ///< the vertex, taken out earlier, that it leads over; no_vertex: an edge
  double length;
  friend bool operator==(const HierarchyArc&, const HierarchyArc&) = default;
};

/// Any number of threads may read.
struct Hierarchy {
  RawVector<EdgeEnd> first;      ///< one more than vertices: where the arcs of each begin
  RawVector<HierarchyArc> arcs;  ///< whole: a row is read at once, and so costs one look into the memory

  bool empty() const { return first.empty(); }
  std::size_t vertex_count() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const HierarchyArc> row(VertexId v) const { return {arcs.data() + first[v], arcs.data() + first[v + 1]}; }
  /// The arc in the row of `low` that leads to `high`; the number of all arcs where there is none.
  std::size_t arc_to(VertexId low, VertexId high) const;
};

/// Holds every number against its range and each shortcut against the arcs that it stands for, so that nobody who asks
/// afterwards looks beyond an array, whoever made them; what is wrong nevertheless makes ways longer, or of motions
/// that are none. Throws InputError, which names the array as part of `where`, and Stopped. O(arcs log degree).
void check_hierarchy(const Hierarchy& hierarchy, std::size_t vertex_count, const std::string& where,
                     const Execution& execution);

/// The graph has lengths >= 0. Nothing where it doesn't pay. Throws Stopped.
std::optional<Hierarchy> contract(const Graph& graph, const Execution& execution);

/// What is left of a graph while its vertices are taken out: rows like those of Graph, whose arcs know their lengths
/// and, where they are shortcuts, the vertex that they lead over. A round makes the next graph of this one in a few
/// passes over its arcs, on all threads; vertices keep their order, so that neighbours in the plane stay neighbours in
/// memory. 16 bytes an arc, twice while a round is made.
struct ShrinkingGraph {
  RawVector<VertexId> vertex;  ///< of the whole graph, ascending
  RawVector<EdgeEnd> first;    ///< one more than vertices
  /// to: of this graph; middle: of the whole one. An edge stands in the rows of both ends.
  RawVector<HierarchyArc> arc;

  std::size_t size() const { return vertex.size(); }
  std::span<const HierarchyArc> row(VertexId v) const { return {arc.data() + first[v], arc.data() + first[v + 1]}; }
};

/// The rounds of a contraction, one at a time. Refers to the execution.
class ContractionRounds {
 public:
  /// The graph has lengths. Throws Stopped.
  ContractionRounds(const Graph& graph, const Execution& execution);

  const ShrinkingGraph& left() const { return left_; }
  /// Arcs a vertex of what is left.
  double density() const;
  /// Takes out at least one vertex of those left. Throws Stopped.
  void next_round();
  /// When nothing is left. Throws Stopped.
  Hierarchy hierarchy();

 private:
  RawVector<std::uint8_t> choose() const;

  const Execution& execution_;
  ShrinkingGraph left_;
  RawVector<std::uint32_t> level_;    // of a vertex: 1 more than the highest of those that went beside it
  std::vector<ShrinkingGraph> gone_;  // of each chunk those that went, with their arcs; to: of the whole graph
};

/// A vertex that start or goal is joined to, and how far it is.
struct HierarchyEnd {
  VertexId vertex;
  double length;
};

/// What one end of a question has reached of a hierarchy: a few thousand vertices of millions. They stand in a table of
/// their own, by a hash of their numbers, so that a question touches some hundred kilobytes that stay in the nearest
/// caches, and a thread needs no array as long as the roadmap. One end's distances, parents and queue. Vertices leave
/// the queue by distance, then by number.
class HierarchyClimb {
 public:
  /// Before each question: forgets all, O(vertices that were reached), and reaches the ends.
  void begin(std::span<const HierarchyEnd> ends);
  /// Of the way to v; infinity: not reached.
  double length(VertexId v) const { return slots_[slot_of(v)].length; }
  /// Is this the shortest way to v so far? Then it is kept, and v waits in the queue.
  void reach(VertexId v, double length, VertexId parent);

  bool empty() const { return queue_.empty(); }
  const QueueEntry& top() const { return queue_.top(); }
  /// Takes the top, and what waits behind it for ways that are no longer the shortest.
  QueueEntry pop() {
    const QueueEntry next = queue_.pop();
    while (!queue_.empty() && queue_.top().key > length(queue_.top().vertex)) queue_.pop();
    return next;
  }
  /// The vertices from v back to where the climb began.
  RawVector<VertexId> back_from(VertexId v) const {
    RawVector<VertexId> way;
    for (; v != no_vertex; v = slots_[slot_of(v)].parent) way.push_back(v);
    return way;
  }

 private:
  struct Slot {
    VertexId vertex = no_vertex;  // none: the slot is empty
    VertexId parent = no_vertex;
    double length = std::numeric_limits<double>::infinity();
  };
  static constexpr unsigned first_bits = 13;

  /// Where v stands; the empty slot for it where it doesn't.
  std::size_t slot_of(VertexId v) const {
    std::size_t slot = v * std::uint64_t{0x9e3779b97f4a7c15U} >> shift_;
    while (slots_[slot].vertex != v && slots_[slot].vertex != no_vertex) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow();

  std::vector<Slot> slots_;  // open addressing, at most half full
  unsigned shift_ = 64 - first_bits;
  std::vector<std::uint32_t> used_;  // slots
  LazyHeap queue_;                   // with entries of ways that were longer
};

/// What one thread keeps from one question to the next: as much as the largest of them touched.
using HierarchyScratch = std::array<HierarchyClimb, 2>;

/// One thread's. Refers to all that it is given.
class HierarchyQuery {
 public:
  HierarchyQuery(const Hierarchy& hierarchy, HierarchyScratch& scratch, const Execution& execution)
      : hierarchy_(hierarchy), scratch_(scratch), execution_(execution) {}

  /// Is there a way shorter than `limit`? Lengths of the ends included. Throws Stopped.
  bool search(std::span<const HierarchyEnd> start, std::span<const HierarchyEnd> goal, double limit);
  /// After a search that found one: from the vertex of start that it leaves from to that of the goal. Throws Stopped,
  /// and InputError for an index whose shortcuts have no end.
  RawVector<VertexId> path();

  std::uint64_t settled() const { return settled_; }
  std::uint64_t looks() const { return looks_; }  ///< at arcs, by the last search

 private:
  bool goes_on(const HierarchyClimb& side) const { return !side.empty() && side.top().key < best_; }
  void settle(std::size_t side);

  const Hierarchy& hierarchy_;
  HierarchyScratch& scratch_;
  const Execution& execution_;
  double best_ = 0.0;
  VertexId meeting_ = no_vertex;
  std::uint64_t settled_ = 0;
  std::uint64_t looks_ = 0;
};

/// The route of a question by a hierarchy: start and goal are two vertices more, which no way passes between its ends.
/// Start has the number vertex_count() of the hierarchy, goal the next one. `ends`: their edges, from a vertex of the
/// roadmap to one of them, or from start to goal; `lengths`: of each. The length of what is found is left 0. Throws
/// Stopped, and InputError as HierarchyQuery::path does.
SearchResult route_by_hierarchy(const Hierarchy& hierarchy, std::span<const Edge> ends, std::span<const double> lengths,
                                HierarchyScratch& scratch, const Execution& execution);

}  // namespace warren
