// SPDX-License-Identifier: BSD-3-Clause
// PRM: the probabilistic roadmap method (Kavraki, Svestka, Latombe, Overmars 1996), every candidate edge checked.
//
// A round draws milestones in tile order, indexes them, checks the candidate edges on all cores, assembles the graph,
// finds its components (on what the search's reduction leaves of it, where there is one) and, where start and goal are
// joined, searches it. With samples on auto a round that leaves
// them apart is followed by a larger one (roadmap_growth.hpp), until a documented cap. Time a round: O(n log n) for n
// milestones with a bounded number of neighbours; memory: 26 bytes a milestone, 16 an edge (plane).
// The result is a function of world, start, goal and options: the same bits for any thread count.
#pragma once

#include <optional>
#include <utility>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/components.hpp"
#include "parallel/execution.hpp"
#include "parallel/first_touch.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/milestones.hpp"
#include "planners/roadmap/roadmap.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "planners/roadmap/roadmap_search.hpp"
#include "planners/roadmap/separation.hpp"
#include "planners/roadmap/stopped_solution.hpp"

namespace warren {

namespace detail {

/// One plan: what its rounds share.
template <World W>
class PrmPlan {
 public:
  using State = typename W::State;
  PrmPlan(const W& world, const State& start, const State& goal, const RoadmapOptions& options,
          const Execution& execution, bool keep)
      : world_(world), start_(start), goal_(goal), options_(options), execution_(execution), keep_(keep) {}

  /// Builds and searches a roadmap with so many samples; true when the answer is final.
  bool round(std::uint64_t samples) {
    ++solution_.counters.rounds;
    solution_.counters.samples += samples;
    draw(samples);
    const EdgeParts edges = connect(samples);
    assemble(edges);
    reduce();
    return joined() && search();
  }
  void finish(Roadmap<State>* keep);
  Solution<State>& solution() { return solution_; }

 private:
  void draw(std::uint64_t samples);
  EdgeParts connect(std::uint64_t samples);
  void assemble(const EdgeParts& edges);
  void reduce();
  bool joined();
  bool search();
  VertexId start_vertex() const { return static_cast<VertexId>(roadmap_.states.size() - 2); }
  VertexId goal_vertex() const { return static_cast<VertexId>(roadmap_.states.size() - 1); }
  std::span<const State> milestones() const { return {roadmap_.states.data(), roadmap_.states.size() - 2}; }

  const W& world_;
  const State start_;
  const State goal_;
  const RoadmapOptions& options_;
  const Execution& execution_;
  bool keep_;
  Roadmap<State> roadmap_;
  std::optional<TwiceReducedGraphView> reduced_;
  Components components_;  // of the graph; empty if reduced_ knows them
  Solution<State> solution_;
};

template <World W>
void PrmPlan<W>::draw(std::uint64_t samples) {
  const StageTimer timer(execution_, "sample", solution_.seconds.sample, samples);
  reduced_.reset();
  roadmap_.graph = Graph();
  roadmap_.states = draw_milestones(world_, options_, samples, execution_);
  roadmap_.states.push_back(start_);
  roadmap_.states.push_back(goal_);
  solution_.roadmap = {roadmap_.states.size(), 0, 0};
}

template <World W>
EdgeParts PrmPlan<W>::connect(std::uint64_t samples) {
  StateIndex<W> index;
  {
    const StageTimer timer(execution_, "neighbours", solution_.seconds.neighbours, milestones().size());
    index = index_of_states(world_, milestones(), execution_);
  }
  const StageTimer timer(execution_, "connect", solution_.seconds.connect, milestones().size());
  const ConnectionRule rule = connection_rule_for(world_, options_, samples);
  EdgeParts edges = connect_milestones(world_, milestones(), index, rule, execution_, solution_.counters);
  edges.push_back(attach_start_and_goal(world_, milestones(), index, rule, start_, goal_, solution_.counters));
  return edges;
}

template <World W>
void PrmPlan<W>::assemble(const EdgeParts& edges) {
  const StageTimer timer(execution_, "graph", solution_.seconds.graph, roadmap_.states.size());
  roadmap_.graph = assemble_graph(roadmap_.states.size(), edges, execution_);
  solution_.roadmap.edges = roadmap_.graph.edge_count();
}

template <World W>
void PrmPlan<W>::reduce() {
  {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    reduced_ = reduced_for_search(world_, roadmap_.graph, roadmap_.states, start_vertex(), goal_vertex(), options_,
                                  execution_);
  }
  const StageTimer timer(execution_, "graph", solution_.seconds.graph);
  components_ = reduced_ ? Components() : components(roadmap_.graph, execution_);
  solution_.roadmap.components = reduced_ ? reduced_->component_count() : components_.count;
}

template <World W>
bool PrmPlan<W>::joined() {
  if (reduced_ ? reduced_->connected(start_vertex(), goal_vertex())
               : components_.connected(start_vertex(), goal_vertex())) {
    return true;
  }
  solution_.outcome = Outcome::not_connected;
  return false;
}

template <World W>
bool PrmPlan<W>::search() {
  const StageTimer timer(execution_, "search", solution_.seconds.search);
  const SearchResult found =
      search_roadmap(world_, roadmap_.graph, reduced_, roadmap_.states, start_vertex(), goal_vertex(), options_,
                     execution_, keep_ ? &roadmap_.search_tree : nullptr);
  reduced_.reset();
  solution_.counters.expanded += found.expanded;
  if (found.status != SearchStatus::found) return false;
  reserve_touched(solution_.path, found.path.size(), execution_);
  for (const VertexId v : found.path) solution_.path.push_back(roadmap_.states[v]);
  solution_.outcome = Outcome::solved;
  return true;
}

template <World W>
void PrmPlan<W>::finish(Roadmap<State>* keep) {
  if (solution_.outcome == Outcome::not_connected && !roadmap_.states.empty()) {
    if (reduced_) components_ = components(roadmap_.graph, execution_);
    solution_.separation =
        separation_of(world_, roadmap_.states, components_, start_vertex(), goal_vertex(), execution_);
  }
  if (keep == nullptr) return;
  *keep = std::move(roadmap_);
}

/// start_blocked, goal_blocked, or nothing.
template <World W>
std::optional<Outcome> blocked_end(const W& world, const typename W::State& start, const typename W::State& goal) {
  auto query = world.make_query();
  if (!world.is_free(start, query)) return Outcome::start_blocked;
  if (!world.is_free(goal, query)) return Outcome::goal_blocked;
  return std::nullopt;
}

/// Runs rounds of growing size until one gives the final answer, the samples end, or the deadline comes.
template <World W, class Plan>
Solution<typename W::State> plan_in_rounds(const W& world, const typename W::State& start,
                                           const typename W::State& goal, const RoadmapOptions& options,
                                           const Execution& execution, Roadmap<typename W::State>* keep, Plan& plan) {
  options.validate();
  Solution<typename W::State>& solution = plan.solution();
  if (const auto blocked = blocked_end(world, start, goal)) {
    solution.outcome = *blocked;
    return std::move(solution);
  }
  try {
    execution.check();
    const std::uint64_t usual = usual_samples(world, options, execution);
    for (std::uint64_t samples = first_samples(world, options, execution); samples != 0;
         samples = next_samples(options, usual, samples)) {
      if (plan.round(samples)) break;
    }
    plan.finish(keep);
  } catch (const Stopped& stopped) {
    mark_stopped(solution, stopped);
  }
  return std::move(solution);
}

}  // namespace detail

/// Plans from start to goal. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped. InputError for
/// options out of range. `keep`, where given, receives the roadmap of the last round.
template <World W>
Solution<typename W::State> prm(const W& world, const typename W::State& start, const typename W::State& goal,
                                const RoadmapOptions& options, const Execution& execution,
                                Roadmap<typename W::State>* keep = nullptr) {
  detail::PrmPlan<W> plan(world, start, goal, options, execution, keep != nullptr);
  return detail::plan_in_rounds(world, start, goal, options, execution, keep, plan);
}

}  // namespace warren
