// SPDX-License-Identifier: BSD-3-Clause
// What all planners that draw samples in rounds share: prm, lazy_prm and one_way_prm. A round draws
// milestones in tile order, start and goal after them, and looks for a path; with samples on auto a round that leaves
// start and goal apart is followed by a larger one (connection.hpp), until a documented cap.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/milestones.hpp"

namespace warren::detail {

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

  /// Runs rounds of growing size until one gives the final answer, the samples end, or the deadline comes.
  Solution<State> run() {
    options_.validate();
    if (const auto blocked = blocked_end(world_, start_, goal_)) {
      solution_.outcome = *blocked;
      return std::move(solution_);
    }
    try {
      execution_.check();
      const std::uint64_t usual = usual_samples(world_, options_, execution_);
      for (std::uint64_t samples = first_samples(world_, options_, execution_); samples != 0;
           samples = next_samples(options_, usual, samples)) {
        if (round(samples)) break;
      }
      finish();
    } catch (const Stopped& stopped) {
      mark_stopped(solution_, stopped);
    }
    return std::move(solution_);
  }

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
  ConnectionRule rule_for(std::uint64_t samples) const { return connection_rule_for(world_, options_, samples); }
  auto estimate() const {
    return
        [this](VertexId v, VertexId to) { return estimated_way(world_, options_.heuristic, states_[v], states_[to]); };
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

}  // namespace warren::detail
