// SPDX-License-Identifier: BSD-3-Clause
// Lazy PRM (Bohlin, Kavraki, ICRA 2000): milestones as in prm, but a motion is checked only where a search needs it.
//
// In this order (LazyPlan::round): milestones are drawn and indexed, the edges of start and goal are checked, then it
// searches, and checks an edge when expanding one end would improve the other. The loop that expands is best_first()
// (core/search/search.hpp), from both ends SearchSide::advance() (bidirectional_search.hpp there). By radius the graph
// is implicit (LazyGraph): the search asks for neighbours. By k, which is usual for poses, arms and the corridor
// sampler, the candidates become rows before it, unchecked. Blocked ends, and larger rounds where there is no path:
// prm.hpp; motions that have a direction: one_way_prm.hpp. The path is the shortest of the same roadmap as
// prm's. Tried and lost: a motion checked only when it lies on the best path so far, as Bohlin and Kavraki have it, for
// most candidate edges of mazes lead through walls, and each of them cost a repair.
// From 50,000 milestones on it searches from both ends (NBA*), if the estimate never exceeds the way: each end with a
// graph and a thread of its own; below that, two threads do not repay their start. The number of threads changes
// neither path nor counters. There it also leaves out the dead ends of a maze (DeadEnds).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/prm.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren {

/// Which cells lead nowhere, and when a search need not look into them any more. A cell from which all ways to the ends
/// of the question lead over one side, the way out, lies in a dead end: peeled cell by cell from its tip, so each cell
/// of it has a way out of its own, and behind that lies all that can be reached without it. Cells are peeled, not
/// vertices, for no edge is known yet. O(cells), two bytes a cell.
///
/// A search may leave a milestone of a dead end unexpanded once all milestones that a motion over the way out can come
/// to are settled, for nothing that it would lower lies elsewhere: a motion that leaves what lies behind passes the
/// side, and no motion is longer than the radius. So labels and parents beyond the dead end are those of a search
/// without it, and the path is the same. A search from both ends may do it where its own side has settled them (the
/// argument of core/search/bidirectional_search.hpp holds: a vertex of the middle of a shortest path, in a dead end, is
/// left by a vertex that is closed by neither side or was settled by both in one round, whose labels then are right).
/// In a maze that leaves the corridor between start and goal and a cell or two of each branch: of uniform milestones
/// among 4,000 x 4,000 cells an eighth is settled instead of nine tenths (docs/performance.md). Immutable; any number
/// of threads may ask.
class DeadEnds {
 public:
  DeadEnds() = default;  ///< none
  /// `kept`: the cells of the ends. Throws Stopped.
  DeadEnds(CellSides cells, std::span<const std::size_t> kept, const Execution& execution);

  bool empty() const { return cells_.open.empty(); }
  const CellSides& cells() const { return cells_; }
  std::uint8_t open_sides(std::size_t cell) const { return cells_.open[cell] & CellSides::all; }
  /// The side of the cell over which all ways lead; 0 outside of dead ends.
  std::uint8_t way_out(std::size_t cell) const { return static_cast<std::uint8_t>(cells_.open[cell] >> 4U); }

 private:
  CellSides cells_;  // way out in the upper half of the byte
};

/// What one search knows of them: belongs to one thread, or to one side of a search. Refers to all that it is given.
class DeadEndSeals {
 public:
  /// The milestones of the search, and the longest of its motions. Throws Stopped: four bytes a cell.
  DeadEndSeals(const DeadEnds& dead_ends, const Neighbours<2>& milestones, double radius, const Execution& execution);

  /// May milestone v stay unexpanded? labels: of a search, negative where it has settled the vertex. O(1) while the
  /// milestone that was the reason to say no is not settled; else O(milestones near the way out), a few times a cell.
  bool holds(VertexId v, std::span<const double> labels) {
    const std::size_t cell = dead_ends_->cells().cell_of(milestones_->point(v));
    return dead_ends_->way_out(cell) != 0 && is_sealed(cell, labels);
  }

 private:
  static constexpr std::size_t most_near = 64;
  static constexpr VertexId nobody = 0xffffffff;  // that is known yet
  static constexpr VertexId sealed = 0xfffffffe;

  bool is_sealed(std::size_t cell, std::span<const double> labels);
  bool gather_outside(std::size_t cell, const Segment& way_out);
  VertexId unsettled_outside(const Segment& way_out, std::span<const double> labels) const;

  const DeadEnds* dead_ends_;
  const Neighbours<2>* milestones_;
  double radius_;
  RawVector<VertexId> waits_for_;     // of each cell: an unsettled milestone beyond the way out, nobody or sealed
  std::vector<std::size_t> outside_;  // scratch: cells that a motion over the way out may come to
};

/// A roadmap whose edges are not checked before the search needs them: a motion is checked when it would improve a
/// vertex. Radius rule: the graph isn't built either, the neighbours of a milestone are asked of the index when the
/// search expands it. k rule: the candidates are a graph, since a milestone's k nearest alone would miss those that
/// count it among theirs. Either way it is the graph that prm checks as a whole, so the path is the same; one to six
/// checks an expansion instead of one a candidate. Where motions have a price the distance stands for it until then: it
/// is not more. Belongs to one thread; each side of a search has its own. Throws
/// Stopped between checks. Vertices: milestones, then start, then goal (whose edges were checked by attach()).
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
        query_(world.make_query()),
        clock_(execution, detail::bunches_per_clock<W>) {}

  /// Leaves milestones of dead ends unexpanded where nothing depends on them. Radius rule, in the plane.
  void leave_out(const DeadEnds& dead_ends) {
    if constexpr (W::in_plane) seals_.emplace(dead_ends, index_, rule_.radius, *execution_);
  }
  /// Keeps the free edges that were used, for pictures.
  void record(std::vector<Edge>* edges) { recorded_ = edges; }
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
      if (e.from == v) visit(e.to, world_.cost(states_[v], states_[e.to]));
      if (e.to == v) visit(e.from, world_.cost(states_[v], states_[e.from]));
    }
  }

 private:
  static constexpr std::uint64_t checks_per_poll = 64;

  /// What helps is put to the world bunch by bunch: that v is joined to one neighbour does not change what it is to
  /// another.
  void visit_milestones(VertexId v, const AnyVisit& visit) {
    ++counters_.neighbour_queries;
    clock_.begin();
    const auto try_edge = [&](VertexId w) {
      if (w == v) return;
      const double length = world_.distance(states_[v], states_[w]);
      if (!visit.wants(w, length)) return;
      lengths_[wanted_.edges().size()] = length;
      wanted_.add({v, w}, states_[std::min(v, w)], states_[std::max(v, w)]);
      if (wanted_.full()) visit_free(visit);
    };
    if (rule_.neighbours == 0) {
      index_.for_each_within(index_.point(v), radius_, [&](VertexId w, double distance) {
        if (visit.wants(w, distance)) try_edge(w);  // most are settled already
      });
    } else {
      for (const VertexId w : candidates_.neighbours(v)) {
        if (visit.wants(w, 0.0)) try_edge(w);
      }
    }
    visit_free(visit);
    clock_.lap(StagePart::queries);
  }

  /// Those of the wanted edges that are free.
  void visit_free(const AnyVisit& visit) {
    const std::size_t count = wanted_.edges().size();
    if (count == 0) return;
    if ((unpolled_ += count) >= checks_per_poll) {
      unpolled_ = 0;
      execution_->check();
    }
    clock_.lap(StagePart::queries);
    std::uint32_t free = world_.free_motions(wanted_.motions(), query_);
    clock_.lap(StagePart::checks);
    counters_.edges_checked += count;
    counters_.edges_free += static_cast<std::uint64_t>(std::popcount(free));
    for (; free != 0; free &= free - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(free));
      const auto [v, w] = wanted_.edges()[i];
      if (recorded_ != nullptr) recorded_->push_back({std::min(v, w), std::max(v, w)});
      visit(w, world_.motion_cost ? world_.cost(states_[v], states_[w]) : lengths_[i]);
    }
    wanted_.clear();
    clock_.lap(StagePart::rest);
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
  PartClock clock_;
  detail::Bunch<State> wanted_;
  std::array<double, bunch_size> lengths_;  ///< of what is wanted
  std::optional<DeadEndSeals> seals_;
  std::size_t unpolled_ = 0;
  std::vector<Edge>* recorded_ = nullptr;
};

namespace detail {

template <World W>
class LazyPlan final : public Rounds<W> {
 public:
  using Rounds<W>::Rounds;

 private:
  using Rounds<W>::execution_, Rounds<W>::options_, Rounds<W>::solution_, Rounds<W>::states_, Rounds<W>::world_,
      Rounds<W>::start_vertex, Rounds<W>::goal_vertex, Rounds<W>::milestones, Rounds<W>::keep_, Rounds<W>::tree_;

  bool round(std::uint64_t samples) override {
    this->draw(samples);
    index_ = this->index_milestones();
    rule_ = connection_rule_for(world_, options_, samples);
    join();
    return this->take(search_expanding());
  }
  void finish() override {
    if (this->is_to_separate()) {  // explores all that start and goal can reach
      SearchState from_start;
      SearchState from_goal;
      expand_from(start_vertex(), no_vertex, from_start, nullptr);
      expand_from(goal_vertex(), no_vertex, from_goal, nullptr);
      this->tell_separation(from_start, from_goal);
    }
    if (keep_ == nullptr) return;
    polled_sort(free_edges_.begin(), free_edges_.end(), execution_);
    free_edges_.erase(std::unique(free_edges_.begin(), free_edges_.end()), free_edges_.end());
    *keep_ = {std::move(states_), Graph(), std::move(tree_)};
    keep_->graph = assemble_graph(keep_->states.size(), free_edges_, execution_);
  }
  void join() {
    candidates_ = Graph();
    end_edges_ = this->attach_ends(index_, rule_);
    solution_.roadmap.edges = end_edges_.size();
    if (rule_.neighbours == 0) return;
    EdgeParts parts;
    {
      const StageTimer timer(execution_, "queries", solution_.seconds.connect, milestones().size());
      parts = candidate_edges(world_, milestones(), index_, rule_, execution_, solution_.counters);
    }
    const StageTimer timer(execution_, "rows", solution_.seconds.connect, states_.size());
    candidates_ = assemble_graph(states_.size(), parts, execution_);
    solution_.counters.row_bytes += candidates_.bytes();
  }
  RawVector<VertexId> search_expanding() {
    StageTimer timer(execution_, "expansion", solution_.seconds.search);
    const std::uint64_t before = solution_.counters.expanded;
    free_edges_.assign(end_edges_.begin(), end_edges_.end());
    const bool fits = never_overestimates(options_.heuristic);
    const bool from_both = states_.size() >= fewest_for_both_ends && fits;
    RawVector<VertexId> path = from_both ? search_from_both_ends() : search_from_start();
    timer.set_items(solution_.counters.expanded - before);
    return path;
  }
  RawVector<VertexId> search_from_start() {
    SearchState state;
    SearchResult found = expand_from(start_vertex(), goal_vertex(), state, keep_ != nullptr ? &free_edges_ : nullptr);
    if (keep_ != nullptr) tree_ = search_tree(state);
    return std::move(found.path);
  }
  RawVector<VertexId> search_from_both_ends() {
    struct alignas(bytes_apart) End {  // what one end has for itself
      LazyGraph<W> graph;
      SearchState state;
      std::vector<Edge> edges;
    };
    const DeadEnds dead_ends = find_dead_ends();
    std::array<End, 2> ends{End{lazy_graph(), {}, {}}, End{lazy_graph(), {}, {}}};
    for (End& end : ends) {
      if (!dead_ends.empty()) end.graph.leave_out(dead_ends);
      if (keep_ != nullptr) end.graph.record(&end.edges);
    }
    const SearchResult found =
        search_implicit_from_both_ends({ends[0].graph, ends[1].graph}, {start_vertex(), goal_vertex()},
                                       this->asked(this->estimate()), {&ends[0].state, &ends[1].state});
    Rounds<W>::count(found);
    for (const End& end : ends) {
      count(end.graph);
      free_edges_.insert(free_edges_.end(), end.edges.begin(), end.edges.end());
    }
    if (keep_ != nullptr) tree_ = search_trees(ends[0].state, ends[1].state);
    return found.path;
  }
  /// None where the cells are more than half of the milestones, or where motions are longer than two cells. What start
  /// and goal are joined to has its cells kept, too: it may lie farther than the radius, and the ends themselves are no
  /// milestones, so that before a dead end nobody would wait for them.
  DeadEnds find_dead_ends() const {
    constexpr double longest_motion = 2.0;
    if constexpr (W::in_plane) {
      if (rule_.neighbours != 0 || !(rule_.radius <= longest_motion) || world_.motion_cost) return {};
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
  SearchResult expand_from(VertexId from, VertexId to, SearchState& state, std::vector<Edge>* record) {
    LazyGraph<W> graph = lazy_graph();
    graph.record(record);
    SearchResult found = search_implicit(graph, from, to, this->asked(this->estimate()), state);
    if (found.status == SearchStatus::stopped) execution_.check();
    Rounds<W>::count(found);
    count(graph);
    return found;
  }
  LazyGraph<W> lazy_graph() const { return {world_, states_, index_, rule_, candidates_, end_edges_, execution_}; }
  void count(const LazyGraph<W>& graph) {
    solution_.counters += graph.counters();
    solution_.roadmap.edges += graph.counters().edges_free;
  }
  ConnectionRule rule_;
  StateIndex<W> index_;
  RawVector<Edge> end_edges_;
  Graph candidates_;  ///< unchecked; only where the rule needs them
  std::vector<Edge> free_edges_;
};

}  // namespace detail

/// Plans from start to goal. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped. InputError for
/// options out of range. `keep`, where given, receives milestones, free edges and search tree of the last round.
template <class State>
Solution<State> lazy_prm(const AnyWorld<State>& world, const State& start, const State& goal,
                         const RoadmapOptions& options, const Execution& execution,
                         PlannedRoadmap<State>* keep = nullptr) {
  return run_plan(detail::LazyPlan<AnyWorld<State>>(world, start, goal, options, execution, keep));
}

}  // namespace warren
