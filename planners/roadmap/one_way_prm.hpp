// SPDX-License-Identifier: BSD-3-Clause
// PRM for worlds whose motions have a direction (a car that only drives forwards): the way from a to b says nothing of
// the way back. Edges are directed, so the graph is; that start and goal lie in one component means little, and the
// search decides. Otherwise as prm and lazy_prm: milestones in tile order, rounds of growing size, the same answer for
// any number of threads.
//
// Which edges: from each milestone those to its nearest, and from the nearest to the goal (one_way_candidates.hpp).
// Lazy: an edge is checked when the search would use it. Cost a round: n (4 k distances and k motion checks).
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "planners/roadmap/one_way_candidates.hpp"
#include "planners/roadmap/plan_in_rounds.hpp"
#include "planners/roadmap/roadmap_search.hpp"

namespace warren {

namespace detail {

template <World W>
class OneWayPlan : public Rounds<W> {
 public:
  using State = typename W::State;
  OneWayPlan(const W& world, const State& start, const State& goal, const RoadmapOptions& options, bool lazy,
             const Execution& execution, bool keep)
      : Rounds<W>(world, start, goal, options, execution), lazy_(lazy), keep_(keep) {}

  bool round(std::uint64_t samples) {
    this->draw(samples);
    index_ = this->index_milestones();
    find_candidates(samples);
    if (!lazy_) check_all();
    return search();
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

  static constexpr std::uint64_t checks_per_poll = 64;
  static constexpr std::size_t ways_per_poll = 4096;
  enum class Check : std::uint8_t { unknown, free, blocked };
  /// An edge from a vertex.
  struct Way {
    double length;
    VertexId to;
    Check state = Check::unknown;
  };
  using Ways = std::vector<Way>;

  void find_candidates(std::uint64_t samples);
  Ways nearest(VertexId v, const ConnectionRule& rule, Heading heading, std::vector<Neighbour>& near) const;
  void attach_goal(const ConnectionRule& rule);
  bool is_free(VertexId from, Way& way, typename W::Query& query, Counters& counters) const {
    if (way.state == Check::unknown) {
      if (++counters.edges_checked % checks_per_poll == 0) execution_.check();
      way.state = world_.is_free_motion(states_[from], states_[way.to], query) ? Check::free : Check::blocked;
      counters.edges_free += way.state == Check::free ? 1 : 0;
    }
    return way.state == Check::free;
  }
  void check_all();
  bool search();
  SearchResult search_best();
  SearchResult search_plainly();
  std::uint64_t free_count() const;
  Graph free_graph(bool reversed) const;
  void explore(const Graph& graph, VertexId from, SearchState& state) const;

  bool lazy_;
  bool keep_;
  StateIndex<W> index_;
  std::vector<Ways> ways_;  // from each vertex, ascending by vertex
  std::vector<Edge> tree_;
};

template <World W>
auto OneWayPlan<W>::nearest(VertexId v, const ConnectionRule& rule, Heading heading, std::vector<Neighbour>& near) const
    -> Ways {
  const VertexId except = v < index_.size() ? v : no_vertex;
  const auto candidates = one_way_candidates<W>(world_, states_, index_, rule, states_[v], except, heading, near);
  execution_.reserve(candidates.size() * sizeof(Way));
  Ways ways;
  ways.reserve(candidates.size());
  for (const OneWayCandidate& c : candidates) ways.push_back({c.length, c.to});
  return ways;
}

template <World W>
void OneWayPlan<W>::find_candidates(std::uint64_t samples) {
  constexpr std::size_t grain = 64;
  const StageTimer timer(execution_, "queries", solution_.seconds.connect, this->milestones().size());
  const ConnectionRule rule = this->rule_for(samples);
  const std::size_t begins = states_.size() - 1;  // nothing leads on from the goal
  execution_.reserve(states_.size() * sizeof(Ways));
  ways_.assign(states_.size(), {});
  for_chunks(begins, grain, execution_, [&](Range r) {
    std::vector<Neighbour> near;
    for (std::size_t v = r.first; v < r.last; ++v) {
      ways_[v] = nearest(static_cast<VertexId>(v), rule, Heading::out, near);
      std::sort(ways_[v].begin(), ways_[v].end(), [](const Way& a, const Way& b) { return a.to < b.to; });
    }
  });
  solution_.counters.neighbour_queries += begins + 1;
  attach_goal(rule);  // whose vertex is the last one
}

/// And the edge from start to goal.
template <World W>
void OneWayPlan<W>::attach_goal(const ConnectionRule& rule) {
  std::vector<Neighbour> near;
  for (const Way& way : nearest(goal_vertex(), rule, Heading::in, near)) {
    ways_[way.to].push_back({way.length, goal_vertex()});
  }
  const double length = world_.distance(this->start_, this->goal_);
  if (length <= direct_reach(rule)) ways_[start_vertex()].push_back({length, goal_vertex()});
}

template <World W>
void OneWayPlan<W>::check_all() {
  constexpr std::size_t grain = 64;
  const StageTimer timer(execution_, "checks", solution_.seconds.connect, ways_.size());
  std::vector<Counters> done(chunk_count(ways_.size(), grain));
  for_chunks(ways_.size(), grain, execution_, [&](Range r) {
    auto query = world_.make_query();
    Counters& counters = done[r.first / grain];
    for (std::size_t v = r.first; v < r.last; ++v) {
      execution_.check();
      for (Way& way : ways_[v]) is_free(static_cast<VertexId>(v), way, query, counters);
    }
    counters.refused = refused_motions(query);
  });
  for (const Counters& part : done) solution_.counters += part;
}

template <World W>
bool OneWayPlan<W>::search() {
  const bool best = options_.search == SearchKind::astar || options_.search == SearchKind::dijkstra;
  if (!best && lazy_) check_all();
  StageTimer timer(execution_, "expansion", solution_.seconds.search);
  const SearchResult found = best ? search_best() : search_plainly();
  if (found.status == SearchStatus::stopped) execution_.check();
  timer.set_items(found.expanded);
  this->count(found);
  solution_.roadmap.edges = free_count();
  return this->take(found.path);
}

template <World W>
SearchResult OneWayPlan<W>::search_best() {
  SearchState state;
  auto query = world_.make_query();
  Counters counters;
  PartClock clock(execution_, bunches_per_clock<W>);
  auto neighbours = [&](VertexId v, const AnyVisit& visit) {
    for (Way& way : ways_[v]) {
      if (!visit.wants(way.to, way.length)) continue;
      const bool is_checked = way.state == Check::unknown;
      if (is_checked) clock.begin();
      const bool free = is_free(v, way, query, counters);
      if (is_checked) clock.lap(StagePart::checks);
      if (free) visit(way.to, way.length);
    }
  };
  const auto estimate = [&](VertexId v, VertexId to) { return world_.distance(states_[v], states_[to]); };
  const ImplicitSearch asked{VertexDistance(estimate), options_.search == SearchKind::astar, options_.queue,
                             states_.size(), execution_};
  const SearchResult found = search_implicit(AnyNeighbours(neighbours), start_vertex(), goal_vertex(), asked, state);
  counters.refused = refused_motions(query);
  solution_.counters += counters;
  if (keep_) tree_ = search_tree(state);
  return found;
}

/// Breadth or depth first, over the free edges.
template <World W>
SearchResult OneWayPlan<W>::search_plainly() {
  SearchState state;
  state.resize(states_.size(), [&] { execution_.check(); });
  const Graph graph = free_graph(false);
  const auto should_stop = [&] { return execution_.should_stop(); };
  const SearchResult found = options_.search == SearchKind::bfs
                                 ? breadth_first(graph, start_vertex(), goal_vertex(), state, should_stop)
                                 : depth_first(graph, start_vertex(), goal_vertex(), state, should_stop);
  if (keep_) tree_ = search_tree(state);
  return found;
}

template <World W>
std::uint64_t OneWayPlan<W>::free_count() const {
  std::uint64_t count = 0;
  for (std::size_t v = 0; v < ways_.size(); ++v) {
    if (v % ways_per_poll == 0) execution_.check();
    for (const Way& way : ways_[v]) count += way.state == Check::free ? 1 : 0;
  }
  return count;
}

/// The free edges, each in the row of its begin (reversed: of its end). Throws InputError for 2^32 of them or more.
template <World W>
Graph OneWayPlan<W>::free_graph(bool reversed) const {
  const std::uint64_t edges = free_count();
  if (edges > std::numeric_limits<EdgeEnd>::max()) {
    throw InputError("graph", "too many edges for 32-bit positions; use fewer samples or neighbours",
                     std::to_string(edges));
  }
  execution_.reserve((states_.size() + 1) * 2 * sizeof(EdgeEnd) + edges * sizeof(VertexId));
  RawVector<EdgeEnd> offsets(states_.size() + 1);
  std::fill(offsets.begin(), offsets.end(), 0);
  const auto each = [&](const auto& visit) {
    for (VertexId v = 0; v < ways_.size(); ++v) {
      if (v % ways_per_poll == 0) execution_.check();
      for (const Way& way : ways_[v]) {
        if (way.state == Check::free) reversed ? visit(way.to, v) : visit(v, way.to);
      }
    }
  };
  each([&](VertexId row, VertexId) { ++offsets[row + 1]; });
  for (std::size_t v = 0; v < states_.size(); ++v) offsets[v + 1] += offsets[v];
  RawVector<VertexId> targets(offsets[states_.size()]);
  std::vector<EdgeEnd> next(offsets.begin(), offsets.end() - 1);
  each([&](VertexId row, VertexId other) { targets[next[row]++] = other; });
  return {std::move(offsets), std::move(targets)};
}

/// Reaches all that can be reached.
template <World W>
void OneWayPlan<W>::explore(const Graph& graph, VertexId from, SearchState& state) const {
  state.resize(states_.size(), [&] { execution_.check(); });
  breadth_first(graph, from, no_vertex, state, [&] { return execution_.should_stop(); });
  execution_.check();
}

template <World W>
void OneWayPlan<W>::finish(PlannedRoadmap<State>* keep) {
  if (this->is_apart()) {
    check_all();
    SearchState from_start;
    SearchState to_goal;
    explore(free_graph(false), start_vertex(), from_start);
    explore(free_graph(true), goal_vertex(), to_goal);
    this->tell_separation(from_start, to_goal);
  }
  if (keep == nullptr) return;
  *keep = {RawVector<State>(), free_graph(false), std::move(tree_)};
  keep->states = std::move(states_);
}

}  // namespace detail

/// Plans from start to goal as prm does, or (lazy) as lazy_prm. `keep`, where
/// given, receives the roadmap of the last round; its graph is directed: w is among the neighbours of v where the
/// motion from v to w is free.
template <World W>
Solution<typename W::State> one_way_prm(const W& world, const typename W::State& start, const typename W::State& goal,
                                        const RoadmapOptions& options, bool lazy, const Execution& execution,
                                        PlannedRoadmap<typename W::State>* keep = nullptr) {
  detail::OneWayPlan<W> plan(world, start, goal, options, lazy, execution, keep != nullptr);
  return detail::plan_in_rounds(world, start, goal, options, execution, keep, plan);
}

}  // namespace warren
