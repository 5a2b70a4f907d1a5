// SPDX-License-Identifier: BSD-3-Clause
// PRM for worlds whose motions have a direction (a car that only drives forwards): the way from a to b says nothing of
// the way back. Edges are directed, so the graph is; that start and goal lie in one component means little, and the
// search decides. Otherwise as prm and lazy_prm: milestones in tile order, rounds of growing size, the same answer for
// any number of threads.
//
// Which edges: from each milestone those to its nearest, and from the nearest to the goal (connection.hpp).
// Lazy: an edge is checked when the search would use it. Cost a round: n (4 k distances and k motion checks).
#pragma once

#include <bit>
#include <utility>

#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "planners/roadmap/prm.hpp"

namespace warren {

namespace detail {

template <World W>
class OneWayPlan final : public Rounds<W> {
 public:
  using State = typename W::State;
  OneWayPlan(const W& world, const State& start, const State& goal, const RoadmapOptions& options, bool lazy,
             const Execution& execution, PlannedRoadmap<State>* keep)
      : Rounds<W>(world, start, goal, options, execution, keep), lazy_(lazy) {}

 private:
  using Rounds<W>::execution_, Rounds<W>::options_, Rounds<W>::solution_, Rounds<W>::states_, Rounds<W>::world_,
      Rounds<W>::start_vertex, Rounds<W>::goal_vertex, Rounds<W>::keep_, Rounds<W>::tree_;

  static constexpr std::uint64_t checks_per_poll = 64;

  bool round(std::uint64_t samples) override {
    this->draw(samples);
    find_candidates(samples);
    if (!lazy_) check_all();
    return search();
  }
  void finish() override {
    if (this->is_to_separate()) {
      check_all();
      solution_.counters.edges_free += free_count() - solution_.roadmap.edges;
      const Graph graph = free_part(candidates_, known_, execution_);
      this->tell_separation(reached_and_reaching(graph, start_vertex(), goal_vertex(), execution_));
    }
    if (keep_ == nullptr) return;
    *keep_ = {std::move(states_), free_part(candidates_, known_, execution_), std::move(tree_)};
  }
  void find_candidates(std::uint64_t samples) {
    const StateIndex<W> index = this->index_milestones();
    const StageTimer timer(execution_, "queries", solution_.seconds.connect, this->milestones().size());
    const ConnectionRule rule = connection_rule_for(world_, options_, samples);
    const std::size_t begins = states_.size() - 1;  // nothing leads on from the goal
    candidates_ = Graph();
    EdgeParts edges = one_way_edges(world_, states_, begins, index, rule, execution_);
    edges.push_back(edges_to_goal(index, rule));
    solution_.counters.neighbour_queries += begins + 1;
    candidates_ = one_way_graph(states_.size(), edges, execution_);
    const std::size_t words = edge_state_words(candidates_.targets().size());
    execution_.reserve(words * sizeof(std::uint64_t));
    assign_polled(known_, words, std::uint64_t{0}, [&] { execution_.check(); });  // unchecked
  }
  /// And the edge from start to goal.
  RawVector<Edge> edges_to_goal(const StateIndex<W>& index, const ConnectionRule& rule) {
    RawVector<Edge> edges;
    for (const Neighbour& c :
         one_way_candidates<W>(world_, states_, index, rule, this->goal_, no_vertex, Heading::in)) {
      push_asked(edges, {c.id, goal_vertex()}, execution_);
    }
    if (world_.distance(this->start_, this->goal_) <= direct_reach(rule)) {
      edges.push_back({start_vertex(), goal_vertex()});
    }
    return edges;
  }
  void check_all() {
    const StageTimer timer(execution_, "checks", solution_.seconds.connect, states_.size());
    known_ = check_edges(world_, states_, candidates_, execution_, solution_.counters, {}, known_);
  }
  bool search() {
    const bool blind = !has_queue(options_.search);
    if (blind && lazy_) check_all();
    StageTimer timer(execution_, "expansion", solution_.seconds.search);
    const SearchResult found = search_edges(blind);
    solution_.roadmap.edges = free_count();
    solution_.counters.edges_free += solution_.roadmap.edges;  // of a search that was stopped, too
    if (found.status == SearchStatus::stopped) execution_.check();
    timer.set_items(found.expanded);
    this->count(found);
    return this->take(found.path);
  }
  /// Blindly: breadth or depth first, over the free edges.
  SearchResult search_edges(bool blind) {
    SearchState state;
    auto query = world_.make_query();
    Counters counters;
    PartClock clock(execution_, bunches_per_clock<W>);
    auto neighbours = [&](VertexId v, const AnyVisit& visit) {
      std::size_t end = candidates_.first_end(v);
      for (const VertexId to : candidates_.neighbours(v)) {
        const std::size_t its_end = end++;
        if (edge_state(known_, its_end) == EdgeState::blocked || !visit.wants(to, 0.0)) continue;
        const double length = world_.distance(states_[v], states_[to]);
        if (!visit.wants(to, length)) continue;
        if (edge_state(known_, its_end) == EdgeState::unchecked) {
          if (++counters.edges_checked % checks_per_poll == 0) execution_.check();
          clock.begin();
          const bool free = world_.is_free_motion(states_[v], states_[to], query);
          clock.lap(StagePart::checks);
          set_edge_state(known_, its_end, free ? EdgeState::free : EdgeState::blocked);
          if (!free) continue;
        }
        visit(to, world_.motion_cost ? world_.cost(states_[v], states_[to]) : length);
      }
    };
    const SearchResult found =
        blind ? search_blindly(options_.search, free_part(candidates_, known_, execution_), start_vertex(),
                               goal_vertex(), state, execution_)
              : search_implicit(neighbours, start_vertex(), goal_vertex(), this->asked(this->estimate()), state);
    counters.refused = refused_motions(query);
    solution_.counters += counters;
    if (keep_ != nullptr) tree_ = search_tree(state);
    return found;
  }
  std::uint64_t free_count() const {
    constexpr std::uint64_t low = 0x5555555555555555;  // free is 01
    std::uint64_t count = 0;
    for (const std::uint64_t word : known_)
      count += static_cast<std::uint64_t>(std::popcount(word & ~(word >> 1) & low));
    return count;
  }

  bool lazy_;
  Graph candidates_;
  RawVector<std::uint64_t> known_;  // of each edge: core/search/graph.hpp
};

}  // namespace detail

/// Plans from start to goal as prm does, or (lazy) as lazy_prm. `keep`, where given, receives the roadmap of the last
/// round; its graph is directed: w is among the neighbours of v where the motion from v to w is free.
template <class State, bool one_way>
Solution<State> one_way_prm(const AnyWorld<State, one_way>& world, const State& start, const State& goal,
                            const RoadmapOptions& options, bool lazy, const Execution& execution,
                            PlannedRoadmap<State>* keep = nullptr) {
  return run_plan(detail::OneWayPlan<AnyWorld<State, one_way>>(world, start, goal, options, lazy, execution, keep));
}

}  // namespace warren
