// SPDX-License-Identifier: BSD-3-Clause
// Lazy PRM (Bohlin, Kavraki, ICRA 2000): milestones as in prm, but a motion is checked only where a search needs it.
//
// The graph is implicit (lazy_graph.hpp); an edge is checked when expanding one end would improve the other. The path
// is the shortest of the same roadmap as prm's. Tried and lost: a motion checked only when it lies on the best path so
// far, as they have it, for most candidate edges of mazes lead through walls, and each of them cost a repair.
// From 50,000 milestones on it searches from both ends (NBA*), each end with a graph and a thread of its
// own; below that, two threads do not repay their start. The number of threads changes neither path nor counters. There
// it also leaves out the dead ends of a maze (dead_ends.hpp).
#pragma once

#include <array>
#include <utility>

#include "core/search/bidirectional_search.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/roadmap/lazy_graph.hpp"
#include "planners/roadmap/plan_in_rounds.hpp"
#include "planners/roadmap/roadmap_search.hpp"

namespace warren {

namespace detail {

/// What one end of a search has for itself.
template <World W>
struct alignas(apart) LazyEnd {
  LazyGraph<W> graph;
  SearchState state;
  std::vector<Edge> edges;
};

template <World W>
class LazyPlan : public Rounds<W> {
 public:
  using State = typename W::State;
  LazyPlan(const W& world, const State& start, const State& goal, const RoadmapOptions& options,
           const Execution& execution, bool keep)
      : Rounds<W>(world, start, goal, options, execution), keep_(keep) {}

  bool round(std::uint64_t samples) {
    this->draw(samples);
    index_ = this->index_milestones();
    rule_ = this->rule_for(samples);
    attach_ends();
    return this->take(search_expanding());
  }
  void finish(PlannedRoadmap<State>* keep);

 private:
  using Rounds<W>::execution_;
  using Rounds<W>::options_;
  using Rounds<W>::solution_;
  using Rounds<W>::states_;
  using Rounds<W>::world_;
  using Rounds<W>::start_vertex;
  using Rounds<W>::goal_vertex;
  using Rounds<W>::milestones;

  void attach_ends();
  RawVector<VertexId> search_expanding();
  RawVector<VertexId> search_from_both_ends();
  DeadEnds find_dead_ends() const;
  SearchResult expand_from(VertexId from, VertexId to, SearchState& state, std::vector<Edge>* record);
  LazyGraph<W> lazy_graph() const { return {world_, states_, index_, rule_, candidates_, end_edges_, execution_}; }
  void count(const LazyGraph<W>& graph);
  ImplicitSearch asked(const VertexDistance& estimate) const {
    return {estimate, options_.search == SearchKind::astar, options_.queue, states_.size(), execution_};
  }
  auto estimate() const {
    return
        [this](VertexId v, VertexId to) { return estimated_way(world_, options_.heuristic, states_[v], states_[to]); };
  }
  bool keep_;
  ConnectionRule rule_;
  StateIndex<W> index_;
  RawVector<Edge> end_edges_;
  Graph candidates_;  ///< unchecked; only where the rule needs them
  std::vector<Edge> free_edges_;
  std::vector<Edge> tree_;
};

template <World W>
void LazyPlan<W>::attach_ends() {
  const StageTimer timer(execution_, "connect", solution_.seconds.connect);
  end_edges_ =
      attach_start_and_goal(world_, milestones(), index_, rule_, this->start_, this->goal_, solution_.counters);
  solution_.roadmap.edges = end_edges_.size();
  candidates_ = Graph();
  if (rule_.neighbours == 0) return;
  candidates_ = assemble_graph(
      states_.size(), candidate_edges(world_, milestones(), index_, rule_, execution_, solution_.counters), execution_);
}

template <World W>
SearchResult LazyPlan<W>::expand_from(VertexId from, VertexId to, SearchState& state, std::vector<Edge>* record) {
  LazyGraph<W> graph = lazy_graph();
  graph.record(record);
  const auto estimate = this->estimate();
  SearchResult found = search_implicit(AnyNeighbours(graph), from, to, asked(VertexDistance(estimate)), state);
  if (found.status == SearchStatus::stopped) execution_.check();
  solution_.counters.expanded += found.expanded;
  count(graph);
  return found;
}

template <World W>
void LazyPlan<W>::count(const LazyGraph<W>& graph) {
  solution_.counters += graph.counters();
  solution_.roadmap.edges += graph.free_edges();
}

template <World W>
RawVector<VertexId> LazyPlan<W>::search_expanding() {
  const StageTimer timer(execution_, "search", solution_.seconds.search);
  free_edges_.assign(end_edges_.begin(), end_edges_.end());
  const bool fits = never_overestimates(options_.heuristic);
  if (states_.size() >= fewest_for_both_ends && fits) return search_from_both_ends();
  execution_.reserve(states_.size() * 24);
  SearchState state;
  const SearchResult found = expand_from(start_vertex(), goal_vertex(), state, keep_ ? &free_edges_ : nullptr);
  if (keep_) tree_ = search_tree(state);
  return found.path;
}

template <World W>
RawVector<VertexId> LazyPlan<W>::search_from_both_ends() {
  execution_.reserve(states_.size() * 36);
  const DeadEnds dead_ends = find_dead_ends();
  std::array<LazyEnd<W>, 2> ends{LazyEnd<W>{lazy_graph(), {}, {}}, LazyEnd<W>{lazy_graph(), {}, {}}};
  for (LazyEnd<W>& end : ends) {
    if (!dead_ends.empty()) end.graph.leave_out(dead_ends);
  }
  if (keep_) {
    for (LazyEnd<W>& end : ends) end.graph.record(&end.edges);
  }
  const auto estimate = this->estimate();
  const SearchResult found = search_implicit_from_both_ends(
      {AnyNeighbours(ends[0].graph), AnyNeighbours(ends[1].graph)}, {start_vertex(), goal_vertex()},
      asked(VertexDistance(estimate)), {&ends[0].state, &ends[1].state});
  solution_.counters.expanded += found.expanded;
  for (const LazyEnd<W>& end : ends) {
    count(end.graph);
    free_edges_.insert(free_edges_.end(), end.edges.begin(), end.edges.end());
  }
  if (keep_) tree_ = search_trees(ends[0].state, ends[1].state);
  return found.path;
}

/// None where the cells are more than half of the milestones, or where motions are longer than two cells. What start
/// and goal are joined to has its cells kept, too: it may lie farther than the radius, and the ends themselves are no
/// milestones, so that before a dead end nobody would wait for them.
template <World W>
DeadEnds LazyPlan<W>::find_dead_ends() const {
  constexpr double longest_motion = 2.0;
  if constexpr (CellSideWorld<W>) {
    if (rule_.neighbours != 0 || !(rule_.radius <= longest_motion)) return {};
    CellSides cells = world_.cell_sides(states_.size() / 2, execution_);
    if (cells.open.empty()) return {};
    std::vector<std::size_t> kept{cells.cell_of(this->start_), cells.cell_of(this->goal_)};
    for (const Edge& e : end_edges_) {
      kept.push_back(cells.cell_of(states_[e.from]));
      kept.push_back(cells.cell_of(states_[e.to]));
    }
    return DeadEnds(std::move(cells), kept, execution_);
  }
  return {};
}

template <World W>
void LazyPlan<W>::finish(PlannedRoadmap<State>* keep) {
  if (this->is_apart()) {  // explores all that start and goal can reach
    SearchState from_start;
    SearchState from_goal;
    expand_from(start_vertex(), no_vertex, from_start, nullptr);
    expand_from(goal_vertex(), no_vertex, from_goal, nullptr);
    this->tell_separation(from_start, from_goal);
  }
  if (keep == nullptr) return;
  polled_sort(free_edges_.begin(), free_edges_.end(), execution_);
  free_edges_.erase(std::unique(free_edges_.begin(), free_edges_.end()), free_edges_.end());
  *keep = {std::move(states_), Graph(), std::move(tree_)};
  keep->graph = assemble_graph(keep->states.size(), free_edges_, execution_);
}

}  // namespace detail

/// Plans from start to goal. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped. InputError for
/// options out of range. `keep`, where given, receives milestones, free edges and search tree of the last round.
template <World W>
Solution<typename W::State> lazy_prm(const W& world, const typename W::State& start, const typename W::State& goal,
                                     const RoadmapOptions& options, const Execution& execution,
                                     PlannedRoadmap<typename W::State>* keep = nullptr) {
  detail::LazyPlan<W> plan(world, start, goal, options, execution, keep != nullptr);
  return detail::plan_in_rounds(world, start, goal, options, execution, keep, plan);
}

}  // namespace warren
