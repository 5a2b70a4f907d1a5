// SPDX-License-Identifier: BSD-3-Clause
// The neighbours that the search of a question sees (ask_roadmap.hpp): those of the roadmap, and start and goal as two
// vertices more. What is not known of an edge is asked of the world when the search wants it, and kept.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "planners/roadmap/asked_roadmap.hpp"

namespace warren::detail {

/// One a thread. Refers to all that it is given.
template <World W>
class AskedNeighbours {
 public:
  using State = typename W::State;
  AskedNeighbours(const AskedRoadmap<W>& roadmap, const std::array<State, 2>& ends, std::span<const Edge> end_edges,
                  std::vector<Edge>* used, const Execution& execution)
      : roadmap_(&roadmap),
        ends_(&ends),
        end_edges_(end_edges),
        used_(used),
        execution_(&execution),
        query_(roadmap.world().make_query()) {}

  const State& state(VertexId v) const {
    const std::size_t n = roadmap_->states().size();
    return v < n ? roadmap_->states()[v] : (*ends_)[v - n];
  }
  double distance(VertexId v, VertexId w) const { return roadmap_->world().distance(state(v), state(w)); }

  void operator()(VertexId v, const AnyVisit& visit) {
    if (v < roadmap_->states().size()) {
      std::size_t end = roadmap_->candidates().first_end(v);
      for (const VertexId w : roadmap_->candidates().neighbours(v)) visit_if_free(v, w, end++, visit);
    }
    for (const Edge& e : end_edges_) {
      if (e.from == v) visit_end(v, e.to, visit);
      if (e.to == v && !one_way) visit_end(v, e.from, visit);
    }
  }
  Counters counters() const {
    Counters all = counters_;
    all.refused = refused_motions(query_);
    return all;
  }
  std::uint64_t free_edges() const { return free_edges_; }

 private:
  static constexpr bool one_way = edge_directions<W>() == EdgeDirections::one;
  static constexpr std::uint64_t checks_per_poll = 64;

  void visit_if_free(VertexId v, VertexId w, std::size_t end, const AnyVisit& visit) {
    const EdgeState known = roadmap_->known()[end];
    if (known == EdgeState::blocked || !visit.wants(w, 0.0)) return;
    const double length = distance(v, w);
    if (!visit.wants(w, length)) return;
    if (known == EdgeState::unchecked && !asked(v, w, end)) return;
    ++free_edges_;
    if (used_ != nullptr) used_->push_back(one_way ? Edge{v, w} : Edge{std::min(v, w), std::max(v, w)});
    visit(w, length);
  }
  /// An edge of start or goal. Of lazy roadmaps whose edges lead one way it is asked about here, as one_way_prm does.
  void visit_end(VertexId v, VertexId w, const AnyVisit& visit) {
    const double length = distance(v, w);
    if (one_way && roadmap_->is_lazy()) {
      if (!visit.wants(w, length)) return;
      if (++counters_.edges_checked % checks_per_poll == 0) execution_->check();
      if (!roadmap_->world().is_free_motion(state(v), state(w), query_)) return;
      ++counters_.edges_free;
      ++free_edges_;
    }
    visit(w, length);
  }
  /// Asks the world; remembers at both ends.
  bool asked(VertexId v, VertexId w, std::size_t end) {
    if (++counters_.edges_checked % checks_per_poll == 0) execution_->check();
    const VertexId from = one_way ? v : std::min(v, w);
    const VertexId to = one_way ? w : std::max(v, w);
    const bool free = roadmap_->world().is_free_motion(state(from), state(to), query_);
    counters_.edges_free += free ? 1 : 0;
    const EdgeState answer = free ? EdgeState::free : EdgeState::blocked;
    roadmap_->known().learn(end, answer);
    if (!one_way) roadmap_->known().learn(end_of_edge(roadmap_->candidates(), w, v), answer);
    return free;
  }

  const AskedRoadmap<W>* roadmap_;
  const std::array<State, 2>* ends_;
  std::span<const Edge> end_edges_;
  std::vector<Edge>* used_;
  const Execution* execution_;
  typename W::Query query_;
  Counters counters_;
  std::uint64_t free_edges_ = 0;
};

}  // namespace warren::detail
