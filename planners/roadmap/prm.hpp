// SPDX-License-Identifier: BSD-3-Clause
// PRM: the probabilistic roadmap method (Kavraki, Svestka, Latombe, Overmars 1996), every candidate edge checked. Where
// motions have a price edges weigh it (AnyWorld::motion_cost), else their distance.
//
// What all planners that draw samples in rounds share is Rounds: prm, lazy_prm and one_way_prm. A round draws
// milestones in tile order, start and goal after them, and looks for a path; with samples on auto a round that leaves
// start and goal apart is followed by a larger one (connection.hpp), until a documented cap.
//
// A round of prm indexes the milestones, checks the candidate edges on all cores, assembles the graph, finds its
// components (on what the search's reduction leaves of it, where there is one) and, where start and goal are joined,
// searches it. Time a round: O(n log n) for n milestones with a bounded number of neighbours; memory: 26 bytes a
// milestone, 16 an edge (plane). The result is a function of world, start, goal and options: the same bits for any
// thread count.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/sampler.hpp"

namespace warren {

namespace detail {

/// start_blocked, goal_blocked, or nothing.
template <World W>
std::optional<Outcome> blocked_end(const W& world, const typename W::State& start, const typename W::State& goal) {
  auto query = world.make_query();
  if (!world.is_free(start, query)) return Outcome::start_blocked;
  if (!world.is_free(goal, query)) return Outcome::goal_blocked;
  return std::nullopt;
}

/// The question, the vertices of the round, and the answer so far. Vertices: milestones, start, goal.
template <World W>
class Rounds {
 public:
  using State = typename W::State;
  /// keep: where given, receives the roadmap of the last round.
  Rounds(const W& world, const State& start, const State& goal, const RoadmapOptions& options,
         const Execution& execution, PlannedRoadmap<State>* keep)
      : world_(world), start_(start), goal_(goal), options_(options), execution_(execution), keep_(keep) {}

  /// Runs rounds of growing size until one gives the final answer or the samples end. Throws Stopped.
  void run() {
    options_.validate();
    if (const auto blocked = blocked_end(world_, start_, goal_)) {
      solution_.outcome = *blocked;
      return;
    }
    execution_.check();
    const std::uint64_t usual = usual_samples(world_, options_, execution_);
    for (std::uint64_t samples = first_samples(world_, options_, execution_); samples != 0;
         samples = next_samples(options_, usual, samples)) {
      if (round(samples)) break;
    }
    finish();
  }
  Solution<State>& solution() { return solution_; }

 protected:
  ~Rounds() = default;

  /// A round with so many samples: true when the answer is final.
  virtual bool round(std::uint64_t samples) = 0;
  /// Ends the last round.
  virtual void finish() = 0;

  /// Begins a round.
  void draw(std::uint64_t samples) {
    ++solution_.counters.rounds;
    const StageTimer timer(execution_, "sample", solution_.seconds.sample, samples);
    states_ = draw_milestones(world_, options_, samples, execution_);
    solution_.counters.samples += samples;
    solution_.counters.kept += states_.size();
    states_.push_back(start_);
    states_.push_back(goal_);
    solution_.roadmap = {states_.size(), 0, 0, samples};
  }
  StateIndex<W> index_milestones() {
    const StageTimer timer(execution_, "neighbours", solution_.seconds.neighbours, milestones().size());
    return index_of_states(world_, milestones(), execution_, options_.neighbour_index);
  }
  /// The free edges of start and goal, whose motions are all that takes time here.
  RawVector<Edge> attach_ends(const StateIndex<W>& index, const ConnectionRule& rule) {
    const StageTimer timer(execution_, "checks", solution_.seconds.connect);
    return attach_start_and_goal(world_, milestones(), index, rule, start_, goal_, solution_.counters, execution_);
  }
  auto estimate() const {
    return
        [this](VertexId v, VertexId to) { return estimated_way(world_, options_.heuristic, states_[v], states_[to]); };
  }

  ImplicitSearch asked(const VertexDistance& estimate) const {
    return {estimate, options_.search == SearchKind::astar, options_.queue, states_.size(), execution_};
  }

  std::span<const State> milestones() const { return {states_.data(), states_.size() - 2}; }
  VertexId start_vertex() const { return static_cast<VertexId>(states_.size() - 2); }
  VertexId goal_vertex() const { return static_cast<VertexId>(states_.size() - 1); }

  /// The path of a search, or none: true when it is final.
  bool take(const RawVector<VertexId>& path) {
    solution_.outcome = path.empty() ? Outcome::not_connected : Outcome::solved;
    if (path.empty()) return false;
    reserve_touched(solution_.path, path.size(), execution_);
    for (const VertexId v : path) solution_.path.push_back(states_[v]);
    return true;
  }

  void count(const SearchResult& found) {
    solution_.counters.expanded += found.expanded;
    solution_.counters.pushes += found.pushes;
    solution_.counters.decreases += found.decreases;
  }

  /// Does somebody want to know what is between start and goal?
  bool is_to_separate() const {
    return options_.tells_separation && solution_.outcome == Outcome::not_connected && !states_.empty();
  }
  void tell_separation(const Components& components) {
    solution_.separation = separation_of(world_, states_, components, start_vertex(), goal_vertex(), execution_);
  }
  /// Between what start has reached and what has reached the goal.
  void tell_separation(const SearchState& from_start, const SearchState& from_goal) {
    Components reached;
    execution_.reserve(states_.size() * sizeof(VertexId));
    assign_polled(reached.label, states_.size(), no_vertex, [&] { execution_.check(); });
    for (VertexId v = 0; v < states_.size(); ++v) {
      if (from_start.reached(v)) reached.label[v] = start_vertex();
      if (from_goal.reached(v)) reached.label[v] = goal_vertex();
    }
    tell_separation(reached);
  }

  const W& world_;
  const State start_;
  const State goal_;
  const RoadmapOptions& options_;
  const Execution& execution_;
  PlannedRoadmap<State>* keep_;
  RawVector<State> states_;
  std::vector<Edge> tree_;  // of the search, where the roadmap is kept
  Solution<State> solution_;
};

/// One plan: what its rounds share.
template <World W>
class PrmPlan final : public Rounds<W> {
 public:
  using Rounds<W>::Rounds;

 private:
  using Rounds<W>::execution_, Rounds<W>::solution_, Rounds<W>::states_, Rounds<W>::world_, Rounds<W>::start_vertex,
      Rounds<W>::goal_vertex, Rounds<W>::keep_, Rounds<W>::tree_;

  bool round(std::uint64_t samples) override {
    reduced_.reset();
    graph_ = Graph();
    this->draw(samples);
    assemble(connect(samples));
    return search();
  }
  void finish() override {
    if (this->is_to_separate()) {
      if (reduced_) components_ = components(graph_, execution_);
      this->tell_separation(components_);
    }
    if (keep_ != nullptr) *keep_ = {std::move(states_), std::move(graph_), std::move(tree_)};
  }
  EdgeParts connect(std::uint64_t samples) {
    const StateIndex<W> index = this->index_milestones();
    const ConnectionRule rule = connection_rule_for(world_, this->options_, samples);
    EdgeParts edges;
    {
      const StageTimer timer(execution_, "queries", solution_.seconds.connect, this->milestones().size());
      edges = connect_milestones(world_, this->milestones(), index, rule, execution_, solution_.counters);
    }
    edges.push_back(this->attach_ends(index, rule));
    return edges;
  }
  void assemble(const EdgeParts& edges) {
    const StageTimer timer(execution_, "rows", solution_.seconds.graph, states_.size());
    graph_ = assemble_graph(states_.size(), edges, execution_);
    solution_.roadmap.edges = graph_.edge_count();
    solution_.counters.row_bytes += graph_.bytes();
  }
  bool search() {
    const auto distance = [this](VertexId v, VertexId w) { return world_.cost(states_[v], states_[w]); };
    const auto estimate = this->estimate();
    const RoadmapSearch asked{.start = start_vertex(),
                              .goal = goal_vertex(),
                              .length = VertexDistance(distance),
                              .estimate = VertexDistance(estimate),
                              .search = this->options_.search,
                              .queue = this->options_.queue,
                              .execution = execution_,
                              .tree = keep_ != nullptr ? &tree_ : nullptr,
                              .estimate_fits = never_overestimates(this->options_.heuristic)};
    {
      const StageTimer timer(execution_, "reduction", solution_.seconds.search, states_.size());
      reduced_ = reduced_for_search(graph_, asked);
    }
    {
      const StageTimer timer(execution_, "components", solution_.seconds.graph, states_.size());
      components_ = reduced_ ? Components() : components(graph_, execution_);
      solution_.roadmap.components = reduced_ ? reduced_->component_count() : components_.count;
    }
    solution_.outcome = Outcome::not_connected;
    const bool joined = reduced_ ? reduced_->connected(start_vertex(), goal_vertex())
                                 : components_.connected(start_vertex(), goal_vertex());
    if (!joined) return false;
    StageTimer timer(execution_, "expansion", solution_.seconds.search);
    const SearchResult found = reduced_ ? search_roadmap(*reduced_, asked) : search_roadmap(graph_, asked);
    timer.set_items(found.expanded);
    reduced_.reset();
    this->count(found);
    return this->take(found.path);
  }

  Graph graph_;
  std::optional<TwiceReducedGraphView> reduced_;
  Components components_;  // of the graph; empty if reduced_ knows them
};

}  // namespace detail

/// Plans from start to goal. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped. InputError for
/// options out of range. `keep`, where given, receives the roadmap of the last round.
template <class State>
Solution<State> prm(const AnyWorld<State>& world, const State& start, const State& goal, const RoadmapOptions& options,
                    const Execution& execution, PlannedRoadmap<State>* keep = nullptr) {
  return run_plan(detail::PrmPlan<AnyWorld<State>>(world, start, goal, options, execution, keep));
}

}  // namespace warren
