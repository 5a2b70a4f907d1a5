// SPDX-License-Identifier: BSD-3-Clause
// A roadmap whose edges are not checked before the search needs them: a motion is checked when it would improve a
// vertex. Radius rule: the graph isn't built either, the neighbours of a milestone are asked of the index when the
// search expands it. k rule: the candidates are a graph, since a milestone's k nearest alone would miss those that
// count it among theirs. Either way it is the graph that prm checks as a whole, so the path is the same; one to six
// checks an expansion instead of one a candidate.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/counters.hpp"
#include "core/base/world.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/dead_ends.hpp"
#include "planners/roadmap/roadmap_growth.hpp"

namespace warren {

/// Belongs to one thread; each side of a search has its own. Throws Stopped between checks. Vertices: milestones, then
/// start, then goal (whose edges were checked by attach()).
template <World W>
class LazyGraph {
 public:
  using State = typename W::State;
  LazyGraph(const W& world, std::span<const State> states, const StateIndex<W>& index, const ConnectionRule& rule,
            const Graph& candidates, std::span<const Edge> end_edges, const Execution& execution)
      : world_(world),
        states_(states),
        index_(index),
        rule_(rule),
        radius_(rule.radius),
        candidates_(candidates),
        end_edges_(end_edges),
        execution_(&execution),
        query_(world.make_query()) {}

  /// Leaves milestones of dead ends unexpanded where nothing depends on them. Radius rule, in the plane.
  void leave_out(const DeadEnds& dead_ends) {
    if constexpr (CellSideWorld<W>) seals_.emplace(dead_ends, index_, rule_.radius, *execution_);
  }
  /// Keeps the free edges that were used, for pictures.
  void record(std::vector<Edge>* edges) { recorded_ = edges; }
  std::uint64_t free_edges() const { return free_edges_; }
  /// Queries and checks so far.
  Counters counters() const {
    Counters all = counters_;
    all.refused = refused_motions(query_);
    return all;
  }

  /// The free edges of v of which visit.wants(w, length) says that they help. visit.labels(): of all vertices.
  void operator()(VertexId v, const AnyVisit& visit) {
    if (v < index_.size()) {
      if (seals_ && seals_->holds(v, visit.labels())) return;
      visit_milestones(v, visit);
    }
    for (const Edge& e : end_edges_) {
      if (e.from == v) visit(e.to, world_.distance(states_[v], states_[e.to]));
      if (e.to == v) visit(e.from, world_.distance(states_[v], states_[e.from]));
    }
  }

 private:
  static constexpr std::uint64_t checks_per_poll = 64;

  /// What helps is put to the world bunch by bunch: that v is joined to one neighbour does not change what it is to
  /// another.
  void visit_milestones(VertexId v, const AnyVisit& visit) {
    ++counters_.neighbour_queries;
    const auto try_edge = [&](VertexId w, double at_least) {
      if (!visit.wants(w, at_least) || w == v) return;  // most are settled already
      const double length = world_.distance(states_[v], states_[w]);
      if (!visit.wants(w, length)) return;
      lengths_[wanted_.edges().size()] = length;
      wanted_.add({v, w}, states_[std::min(v, w)], states_[std::max(v, w)]);
      if (wanted_.full()) visit_free(visit);
    };
    if (rule_.neighbours == 0) {
      index_.for_each_relaxable(index_.point(v), radius_, visit.through(), visit.labels(), try_edge);
    } else {
      for (const VertexId w : candidates_.neighbours(v)) try_edge(w, 0.0);
    }
    visit_free(visit);
  }

  /// Those of the wanted edges that are free.
  void visit_free(const AnyVisit& visit) {
    const std::size_t count = wanted_.edges().size();
    if (count == 0) return;
    if ((unpolled_ += count) >= checks_per_poll) {
      unpolled_ = 0;
      execution_->check();
    }
    std::uint32_t free = detail::free_motions(world_, wanted_.motions(), query_);
    counters_.edges_checked += count;
    counters_.edges_free += static_cast<std::uint64_t>(std::popcount(free));
    free_edges_ += static_cast<std::uint64_t>(std::popcount(free));
    for (; free != 0; free &= free - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(free));
      const auto [v, w] = wanted_.edges()[i];
      if (recorded_ != nullptr) recorded_->push_back({std::min(v, w), std::max(v, w)});
      visit(w, lengths_[i]);
    }
    wanted_.clear();
  }

  const W& world_;
  std::span<const State> states_;
  const StateIndex<W>& index_;
  ConnectionRule rule_;
  SearchRadius radius_;
  const Graph& candidates_;  // k rule only
  std::span<const Edge> end_edges_;
  const Execution* execution_;
  Counters counters_;
  typename W::Query query_;
  detail::Bunch<State> wanted_;
  std::array<double, bunch_size> lengths_;  ///< of what is wanted
  std::optional<DeadEndSeals> seals_;
  std::size_t unpolled_ = 0;
  std::vector<Edge>* recorded_ = nullptr;
  std::uint64_t free_edges_ = 0;
};

}  // namespace warren
