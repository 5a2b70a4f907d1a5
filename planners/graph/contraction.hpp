// SPDX-License-Identifier: BSD-3-Clause
// Makes the hierarchy (hierarchy.hpp) of an undirected graph. Vertices are taken out in rounds: in each all those whose
// key, from their degree and how much was taken out around them, is below their neighbours', so that no two of them are
// neighbours and all can go at once; shortcuts keep the lengths between what is left (witnesses say which are needed).
// Everything is a function of the graph: the same bytes for any number of threads.
//
// Where ways through a place are few, as in corridors, what is left grows no denser, and a question climbs through a
// few hundred vertices. In open space it does: then nobody gains, and counting says so, first in samples of the graph,
// later while it is made, at last by asking it.
// Cost: 800,000 milestones in a maze of 300 x 300 cells with 10 % loops, 5 million edges: 6 s on two busy cores, 1.3
// arcs an edge. The searches for witnesses are nearly all of it: fewer looks make it slower, for the shortcuts that are
// too many cost more later (60 instead of 120 settled vertices: 1.7 times the arcs that a question looks at).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "planners/graph/hierarchy.hpp"

namespace warren {

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
  /// What a chunk of vertices leaves behind: those that went, with their arcs.
  struct TakenOut {
    RawVector<VertexId> vertex;
    RawVector<EdgeEnd> arcs;      // of each
    RawVector<HierarchyArc> arc;  // to: of the whole graph, ascending in each row

    /// Calls visit(vertex, its arcs) for each.
    template <class Visit>
    void for_each_row(const Visit& visit) const {
      const HierarchyArc* next = arc.data();
      for (std::size_t i = 0; i < vertex.size(); ++i) {
        visit(vertex[i], std::span(next, arcs[i]));
        next += arcs[i];
      }
    }
  };
  RawVector<std::uint8_t> choose() const;

  const Execution& execution_;
  ShrinkingGraph left_;
  RawVector<std::uint32_t> level_;  // of a vertex: 1 more than the highest of those that went beside it
  std::vector<TakenOut> gone_;
};

}  // namespace warren
