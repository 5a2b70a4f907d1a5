// SPDX-License-Identifier: BSD-3-Clause
// PRM: the probabilistic roadmap method (Kavraki, Svestka, Latombe, Overmars 1996), every candidate edge checked. Where
// motions have a price edges weigh it (AnyWorld::motion_cost), else their distance.
//
// A round draws milestones, indexes them, checks the candidate edges on all cores, assembles the graph, finds its
// components (on what the search's reduction leaves of it, where there is one) and, where start and goal are joined,
// searches it. Time a round: O(n log n) for n milestones with a bounded number of neighbours; memory: 26 bytes a
// milestone, 16 an edge (plane). The result is a function of world, start, goal and options: the same bits for any
// thread count.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/plan_in_rounds.hpp"

namespace warren {

namespace detail {

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
    const ConnectionRule rule = this->rule_for(samples);
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
    if (!joined()) return false;
    StageTimer timer(execution_, "expansion", solution_.seconds.search);
    const SearchResult found = reduced_ ? search_roadmap(*reduced_, asked) : search_roadmap(graph_, asked);
    timer.set_items(found.expanded);
    reduced_.reset();
    this->count(found);
    return this->take(found.path);
  }
  bool joined() const {
    return reduced_ ? reduced_->connected(start_vertex(), goal_vertex())
                    : components_.connected(start_vertex(), goal_vertex());
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
  return detail::PrmPlan<AnyWorld<State>>(world, start, goal, options, execution, keep).run();
}

}  // namespace warren
