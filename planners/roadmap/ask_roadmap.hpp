// SPDX-License-Identifier: BSD-3-Clause
// A question to a roadmap that was built without one (build_roadmap.hpp): start and goal are attached as prm attaches
// them, and the search is that of the planner which the roadmap is for, so the answer is the planner's own: the same
// path, length and number of expanded vertices. What is not known of an edge is asked of the world when the search
// wants it, and kept for the next question.
//
// Any number of threads may ask at once, each with a scratch of its own; what they learn is the same whatever their
// order. Cost: two neighbour queries and one search; nothing is copied, but where large roadmaps are stringy
// (is_stringy) or are searched blindly: then the free edges are. Where
// the roadmap has an index (planners/graph), that is asked instead of searching, for the same path.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/hierarchy.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "planners/roadmap/prm.hpp"

namespace warren {

/// A roadmap ready to be asked: with the index that attaches start and goal, and with what is known of its edges, which
/// questions add to. Refers to the world, and to the hierarchy where it has one; its index looks at its states.
template <World W>
struct AskedRoadmap : NotCopied {
  using State = typename W::State;

  /// lazy: the roadmap is lazy_prm's, whose searches run so. Throws Stopped.
  AskedRoadmap(const W& its_world, RawVector<State> its_states, Graph its_candidates,
               std::span<const std::uint64_t> edge_states, const ConnectionRule& its_rule, bool lazy,
               const Execution& execution, const Hierarchy* its_hierarchy = nullptr)
      : world(its_world),
        states(std::move(its_states)),
        candidates(std::move(its_candidates)),
        known((execution.reserve(edge_states.size_bytes()), edge_states)),
        rule(its_rule),
        is_lazy(lazy),
        hierarchy(its_hierarchy),
        index(index_of_states(world, states, execution)) {
    if (is_lazy) return;
    const Graph free = free_part(candidates, edge_states, execution);
    if constexpr (W::one_way) {
      free_edges = free.targets().size();
    } else {
      free_edges = free.edge_count();
      is_stringy = warren::is_stringy(free, execution);
      component_labels = components(free, execution);
    }
  }

  /// All that was learnt so far; while nobody asks.
  std::span<const std::uint64_t> edge_states() const { return known.words(); }

  const W& world;
  const RawVector<State> states;
  const Graph candidates;
  const SharedEdgeStates known;
  const ConnectionRule rule;
  const bool is_lazy;
  const Hierarchy* const hierarchy;  ///< of the free edges; nullptr: there is none
  const StateIndex<W> index;
  // Of the free edges. Not known where the roadmap is lazy; where edges lead one way, their number alone is.
  std::uint64_t free_edges = 0;
  bool is_stringy = false;
  Components component_labels;
};

/// What one thread asks with: kept from one question to the next, it costs what a question touches.
struct AskScratch {
  std::array<SearchState, 2> states;
  HierarchyScratch hierarchy;
  bool by_hierarchy = true;      ///< where the roadmap has one; false: by a search
  bool tells_separation = true;  ///< where there is no path: how far apart are the parts? Takes a pass over the roadmap
};

namespace detail {

/// One question.
template <World W>
class Ask {
 public:
  using State = typename W::State;
  Ask(const AskedRoadmap<W>& roadmap, const State& start, const State& goal, const RoadmapOptions& options,
      const Execution& execution, AskScratch& scratch, PlannedRoadmap<State>* keep)
      : roadmap_(roadmap),
        world_(roadmap.world),
        ends_{start, goal},
        options_(options),
        execution_(execution),
        scratch_(scratch),
        keep_(keep) {}

  void run() {
    if (const auto blocked = blocked_end(world_, ends_[0], ends_[1])) {
      solution_.outcome = *blocked;
      return;
    }
    execution_.check();
    attach_ends();
    search();
    const bool tells_separation = scratch_.tells_separation || roadmap_.is_lazy;  // of a lazy one learnt on the way
    if (solution_.outcome == Outcome::not_connected && tells_separation) tell_separation();
    if (keep_ != nullptr) *keep_ = {all_states(), free_graph(), tree_};
  }
  Solution<State>& solution() { return solution_; }

 private:
  static constexpr bool one_way = W::one_way;

  /// The neighbours that the search of the question sees: those of the roadmap, and start and goal as two vertices
  /// more. What is not known of an edge is asked of the world when the search wants it, and kept. One a thread. Refers
  /// to the question and what it is given.
  class AskedNeighbours {
   public:
    explicit AskedNeighbours(const Ask& ask) : ask_(ask), roadmap_(ask.roadmap_), query_(ask.world_.make_query()) {}

    void operator()(VertexId v, const AnyVisit& visit) {
      if (v < roadmap_.states.size()) {
        std::size_t end = roadmap_.candidates.first_end(v);
        for (const VertexId w : roadmap_.candidates.neighbours(v)) visit_if_free(v, w, end++, visit);
      }
      for (const Edge& e : ask_.end_edges_) {
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
    static constexpr std::uint64_t checks_per_poll = 64;

    void visit_if_free(VertexId v, VertexId w, std::size_t end, const AnyVisit& visit) {
      const EdgeState known = roadmap_.known[end];
      if (known == EdgeState::blocked || !visit.wants(w, 0.0)) return;
      const double length = ask_.distance(v, w);
      if (!visit.wants(w, length)) return;
      if (known == EdgeState::unchecked) {
        const bool free = one_way ? is_free(v, w) : is_free(std::min(v, w), std::max(v, w));
        learn_edge<W>(roadmap_.known, roadmap_.candidates, v, end, free);
        if (!free) return;
      }
      ++free_edges_;
      visit(w, ask_.world_.motion_cost ? ask_.cost(v, w) : length);
    }
    /// An edge of start or goal. Of lazy roadmaps whose edges lead one way it is asked about here, as one_way_prm does.
    void visit_end(VertexId v, VertexId w, const AnyVisit& visit) {
      const double length = ask_.distance(v, w);
      if (one_way && roadmap_.is_lazy) {
        if (!visit.wants(w, length) || !is_free(v, w)) return;
        ++free_edges_;
      }
      visit(w, ask_.world_.motion_cost ? ask_.cost(v, w) : length);
    }
    /// Asks the world.
    bool is_free(VertexId from, VertexId to) {
      if (++counters_.edges_checked % checks_per_poll == 0) ask_.execution_.check();
      const bool free = ask_.world_.is_free_motion(ask_.state(from), ask_.state(to), query_);
      counters_.edges_free += free ? 1 : 0;
      return free;
    }

    const Ask& ask_;
    const AskedRoadmap<W>& roadmap_;
    typename W::Query query_;
    Counters counters_;
    std::uint64_t free_edges_ = 0;
  };

  const State& state(VertexId v) const {
    const std::size_t n = roadmap_.states.size();
    return v < n ? roadmap_.states[v] : ends_[v - n];
  }
  double distance(VertexId v, VertexId w) const { return world_.distance(state(v), state(w)); }
  double cost(VertexId v, VertexId w) const { return world_.cost(state(v), state(w)); }
  VertexId start_vertex() const { return static_cast<VertexId>(roadmap_.states.size()); }
  VertexId goal_vertex() const { return start_vertex() + 1; }
  std::size_t vertex_count() const { return roadmap_.states.size() + 2; }
  ImplicitSearch asked(const VertexDistance& estimate) const {
    return {estimate, options_.search == SearchKind::astar, options_.queue, vertex_count(), execution_};
  }
  auto estimate() const {
    return [this](VertexId v, VertexId to) { return estimated_way(world_, options_.heuristic, state(v), state(to)); };
  }

  void attach_ends() {
    const StageTimer timer(execution_, "connect", solution_.seconds.connect);
    if constexpr (one_way) {
      auto query = world_.make_query();
      attach_one_way(0, Heading::out, query);
      attach_one_way(1, Heading::in, query);
      if (world_.distance(ends_[0], ends_[1]) <= direct_reach(roadmap_.rule) &&
          may_be_free(ends_[0], ends_[1], query)) {
        end_edges_.push_back({start_vertex(), goal_vertex()});
      }
      solution_.counters.refused += refused_motions(query);
    } else {
      end_edges_ = attach_start_and_goal(world_, roadmap_.states, roadmap_.index, roadmap_.rule, ends_[0], ends_[1],
                                         solution_.counters, execution_);
    }
    const std::uint64_t known = one_way && roadmap_.is_lazy ? 0 : end_edges_.size();
    solution_.roadmap = {vertex_count(), roadmap_.free_edges + known, 0};
  }
  void attach_one_way(std::size_t end, Heading heading, typename W::Query& query) {
    const State& here = ends_[end];
    const auto vertex = static_cast<VertexId>(start_vertex() + end);
    ++solution_.counters.neighbour_queries;
    for (const Neighbour& c :
         one_way_candidates<W>(world_, roadmap_.states, roadmap_.index, roadmap_.rule, here, no_vertex, heading)) {
      const State& there = roadmap_.states[c.id];
      const bool out = heading == Heading::out;
      if (!(out ? may_be_free(here, there, query) : may_be_free(there, here, query))) continue;
      end_edges_.push_back(out ? Edge{vertex, c.id} : Edge{c.id, vertex});
    }
  }
  /// Is the motion free? A lazy roadmap leaves that to the search.
  bool may_be_free(const State& from, const State& to, typename W::Query& query) {
    if (roadmap_.is_lazy) return true;
    ++solution_.counters.edges_checked;
    const bool free = world_.is_free_motion(from, to, query);
    solution_.counters.edges_free += free ? 1 : 0;
    return free;
  }
  void search() {
    solution_.outcome = Outcome::not_connected;
    if (known_to_be_joined() == false) return;
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    const bool fits = never_overestimates(options_.heuristic);
    const bool large = !one_way && fits && vertex_count() >= fewest_for_both_ends;
    SearchResult found;
    if (roadmap_.hierarchy != nullptr && scratch_.by_hierarchy) {
      found = search_hierarchy();
    } else if (!has_queue(options_.search) || (large && roadmap_.is_stringy)) {
      found = search_copy();
    } else if (large) {
      found = search_both_ends();
    } else {
      found = search_plainly(start_vertex(), goal_vertex(), scratch_.states[0]);
      if (keep_ != nullptr) tree_ = search_tree(scratch_.states[0]);
    }
    solution_.counters.expanded += found.expanded;
    if (found.path.empty()) return;
    solution_.outcome = Outcome::solved;
    for (const VertexId v : found.path) push_asked(solution_.path, state(v), execution_);
  }
  SearchResult search_plainly(VertexId from, VertexId to, SearchState& state) {
    AskedNeighbours seen(*this);
    const SearchResult found = search_implicit(seen, from, to, asked(estimate()), state);
    if (found.status == SearchStatus::stopped) execution_.check();
    count(seen);
    return found;
  }
  SearchResult search_both_ends() {
    std::array<AskedNeighbours, 2> seen{AskedNeighbours(*this), AskedNeighbours(*this)};
    const SearchResult found =
        search_implicit_from_both_ends({seen[0], seen[1]}, {start_vertex(), goal_vertex()}, asked(estimate()),
                                       {&scratch_.states[0], &scratch_.states[1]});
    for (const AskedNeighbours& side : seen) count(side);
    if (keep_ != nullptr) tree_ = search_trees(scratch_.states[0], scratch_.states[1]);
    return found;
  }
  /// On a copy of what is free, as the planner searches it.
  SearchResult search_copy() {
    const Graph graph = free_graph();
    const auto length = [&](VertexId v, VertexId w) { return cost(v, w); };
    const auto estimate = this->estimate();
    const RoadmapSearch asked{.start = start_vertex(),
                              .goal = goal_vertex(),
                              .length = VertexDistance(length),
                              .estimate = VertexDistance(estimate),
                              .search = options_.search,
                              .queue = options_.queue,
                              .execution = execution_,
                              .tree = keep_ != nullptr ? &tree_ : nullptr};
    if (const auto reduced = reduced_for_search(graph, asked)) return search_roadmap(*reduced, asked);
    return search_roadmap(graph, asked);
  }
  SearchResult search_hierarchy() {
    std::vector<double> lengths;
    for (const Edge& e : end_edges_) lengths.push_back(distance(e.from, e.to));
    return route_by_hierarchy(*roadmap_.hierarchy, end_edges_, lengths, scratch_.hierarchy, execution_);
  }
  /// Are start and goal joined? Nothing where that is not known before the search. Counts the components, start and
  /// goal among them.
  std::optional<bool> known_to_be_joined() {
    if (roadmap_.is_lazy || one_way) return std::nullopt;
    std::array<std::set<VertexId>, 2> joined_to;  // components
    bool direct = false;
    for (const Edge& e : end_edges_) {
      if (e.from == start_vertex()) {
        direct = true;
      } else {
        joined_to[e.to - start_vertex()].insert(roadmap_.component_labels.label[e.from]);
      }
    }
    std::vector<VertexId> shared;
    std::set_intersection(joined_to[0].begin(), joined_to[0].end(), joined_to[1].begin(), joined_to[1].end(),
                          std::back_inserter(shared));
    const bool joined = direct || !shared.empty();
    solution_.roadmap.components =
        roadmap_.component_labels.count + (joined ? 1 : 2) + shared.size() - joined_to[0].size() - joined_to[1].size();
    return joined;
  }
  /// Asks the world about all edges that start or the goal can reach; about all that there are where they lead one way.
  void learn_around_ends() {
    if constexpr (one_way) {
      const auto states = check_edges(world_, roadmap_.states, roadmap_.candidates, execution_, solution_.counters);
      for (std::size_t end = 0; end < roadmap_.candidates.targets().size(); ++end) {
        execution_.poll(end);
        roadmap_.known.learn(end, edge_state(states, end));
      }
    } else {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto from = static_cast<VertexId>(start_vertex() + end);
        solution_.counters.expanded += search_plainly(from, no_vertex, scratch_.states[end]).expanded;
      }
    }
  }
  /// Between the components of start and goal. Where edges lead one way: between what start reaches and what reaches
  /// the goal.
  void tell_separation() {
    if (roadmap_.is_lazy) learn_around_ends();
    const Graph graph = free_graph();
    const Components parts = one_way ? reached_and_reaching(graph, start_vertex(), goal_vertex(), execution_)
                                     : components(graph, execution_);
    solution_.separation = separation_of(world_, all_states(), parts, start_vertex(), goal_vertex(), execution_);
  }
  void count(const AskedNeighbours& seen) {
    solution_.counters += seen.counters();
    if (roadmap_.is_lazy) solution_.roadmap.edges += seen.free_edges();
  }
  /// The free edges, those of start and goal among them; all of them are asked about first where they lead one way.
  Graph free_graph() const {
    execution_.reserve((vertex_count() + 1) * sizeof(EdgeEnd) + 2 * end_edges_.size() * sizeof(Edge) +
                       (roadmap_.candidates.targets().size() + 2 * end_edges_.size()) * sizeof(VertexId));
    std::vector<Edge> sorted;
    auto query = world_.make_query();
    for (const Edge& e : end_edges_) {
      if (one_way && roadmap_.is_lazy && !world_.is_free_motion(state(e.from), state(e.to), query)) continue;
      sorted.push_back(e);
      if (!one_way) sorted.push_back({e.to, e.from});
    }
    std::sort(sorted.begin(), sorted.end());
    const auto is_free = [&](std::size_t end) { return roadmap_.known[end] == EdgeState::free; };
    return part_with_edges(roadmap_.candidates, is_free, vertex_count(), sorted, execution_);
  }
  RawVector<State> all_states() const {
    execution_.reserve(vertex_count() * sizeof(State));
    RawVector<State> states;
    states.reserve(vertex_count());
    for (VertexId v = 0; v < vertex_count(); ++v) {
      execution_.poll(v);
      states.push_back(state(v));
    }
    return states;
  }
  const AskedRoadmap<W>& roadmap_;
  const W& world_;
  const std::array<State, 2> ends_;
  const RoadmapOptions& options_;
  const Execution& execution_;
  AskScratch& scratch_;
  PlannedRoadmap<State>* keep_;
  RawVector<Edge> end_edges_;
  std::vector<Edge> tree_;
  Solution<State> solution_;
};

}  // namespace detail

/// Never throws Stopped: a deadline or a memory limit gives Outcome::stopped. `options`: how it is searched, by which
/// queue; all else is the roadmap's. `keep`, where given, receives the roadmap with start and goal, and the search
/// tree.
template <World W>
Solution<typename W::State> ask_roadmap(const AskedRoadmap<W>& roadmap, const typename W::State& start,
                                        const typename W::State& goal, const RoadmapOptions& options,
                                        const Execution& execution, AskScratch& scratch,
                                        PlannedRoadmap<typename W::State>* keep = nullptr) {
  return run_plan(detail::Ask<W>(roadmap, start, goal, options, execution, scratch, keep));
}

}  // namespace warren
