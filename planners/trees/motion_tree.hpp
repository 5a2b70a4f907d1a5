// SPDX-License-Identifier: BSD-3-Clause
// A tree of free motions that grows from its roots: what rrt, rrt_connect and rrt_star share. A forward tree's motions
// lead from the roots to its states, a backward tree's from the states to the roots; so worlds may be used whose
// motions have a direction. A step costs one neighbour query in the world's embedding and one motion check.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/sampler.hpp"
#include "spatial/points/kd_tree.hpp"

namespace warren {

enum class GrowthDirection : std::uint8_t { forward, backward };

/// Used by one thread. Refers to the world.
template <SteerableWorld W>
class MotionTree {
 public:
  using State = typename W::State;
  using Embedding = PointOf<embedding_dimension<W>>;

  MotionTree(const W& world, GrowthDirection direction) : world_(&world), direction_(direction) {}

  void add_root(const State& state) { add(state, no_vertex); }
  GrowthDirection direction() const { return direction_; }
  std::size_t size() const { return states_.size(); }
  const State& state(VertexId v) const { return states_[v]; }
  VertexId parent(VertexId v) const { return parents_[v]; }  ///< no_vertex for roots
  /// Of the motions between v and its root, in the world's metric.
  double cost(VertexId v) const { return costs_[v]; }
  /// What growing has taken: a state check 1, a motion check 4, a neighbour query 1 for each neighbour that it gives.
  std::uint64_t work() const { return work_; }
  /// No state is grown for less.
  static constexpr std::uint64_t work_of_motion = 4;

  /// Asks for what the tree takes while it grows by an eighth, a copy of what it has included, whenever it has, and for
  /// so many more bytes a state: what is asked long before it is used, others take for theirs. Of trees that grow side
  /// by side each asks for all: none sees what others are about to take. Throws Stopped.
  void ask_room(const Execution& execution, std::size_t more_bytes = 0, std::size_t side_by_side = 1) {
    if (states_.size() < asked_at_) return;
    asked_at_ = next_size(states_.size());
    execution.reserve(side_by_side * asked_at_ * (bytes_a_state + more_bytes));
  }
  /// Bytes that a tree of so many states holds and has asked for beside them, at most.
  static std::size_t room_for(std::size_t states, std::size_t more_bytes = 0) {
    return (states + next_size(states)) * (bytes_a_state + more_bytes);
  }
  /// Those of all states. Throws Stopped.
  std::vector<Embedding> embeddings(const Execution& execution) const {
    execution.reserve(states_.size() * sizeof(Embedding));
    std::vector<Embedding> all;
    all.reserve(states_.size());
    for (const State& state : states_) {
      execution.poll(all.size());
      all.push_back(embedded(*world_, state));
    }
    return all;
  }

  VertexId nearest(const State& to, Counters& counters) {
    ++counters.neighbour_queries;
    ++work_;
    return index_.nearest(embedded(*world_, to)).id;
  }
  /// The k nearest by the embedding.
  void nearest(const State& to, std::size_t k, std::vector<Neighbour>& out, Counters& counters) {
    ++counters.neighbour_queries;
    index_.nearest(embedded(*world_, to), k, out);
    work_ += out.size();
  }
  /// Of the motion that joins a vertex with a state, in the tree's direction.
  double length(VertexId from, const State& to) const {
    const bool forward = direction_ == GrowthDirection::forward;
    return forward ? world_->distance(states_[from], to) : world_->distance(to, states_[from]);
  }
  /// Where the motion from a vertex towards a state has gone so far, at most, in the world's metric.
  State towards(VertexId from, const State& to, double step) const {
    const double whole = length(from, to);
    if (whole <= step) return to;
    return direction_ == GrowthDirection::forward ? world_->interpolate(states_[from], to, step / whole)
                                                  : world_->interpolate(to, states_[from], 1.0 - step / whole);
  }
  bool is_free(const State& state, typename W::Query& query) {
    work_ += work_of_state;
    return world_->is_free(state, query);
  }
  /// Is the motion that joins a vertex with a free state free?
  bool is_free_motion(VertexId from, const State& to, typename W::Query& query, Counters& counters) {
    work_ += work_of_motion;
    ++counters.edges_checked;
    const bool forward = direction_ == GrowthDirection::forward;
    const bool free =
        forward ? world_->is_free_motion(states_[from], to, query) : world_->is_free_motion(to, states_[from], query);
    counters.edges_free += free ? 1 : 0;
    return free;
  }
  /// Grows one motion from `from` all the way to `to`: its vertex, or nothing where `to` or the motion is not free.
  std::optional<VertexId> join(VertexId from, const State& to, typename W::Query& query, Counters& counters) {
    const Step step = step_to(*world_, states_[from], to, direction_ == GrowthDirection::backward, query);
    ++counters.edges_checked;
    work_ += step == Step::state_blocked ? work_of_state : work_of_state + work_of_motion;
    if (step != Step::free) return std::nullopt;
    ++counters.edges_free;
    return add(to, from);
  }
  /// Grows from `from` towards `to` step by step: the last vertex, which stands at `to` where nothing is in the way,
  /// goes_on() says so before each motion, and a step gets anywhere in the states' numbers.
  template <class GoesOn>
  VertexId connect(VertexId from, const State& to, double step, typename W::Query& query, Counters& counters,
                   const GoesOn& goes_on) {
    while (!(states_[from] == to) && goes_on()) {
      const State next = towards(from, to, step);
      const std::optional<VertexId> grown = next == states_[from] ? std::nullopt : join(from, next, query, counters);
      if (!grown) break;
      from = *grown;
    }
    return from;
  }
  /// The states from v to its root, in this order.
  Path<State> way_to_root(VertexId v) const {
    Path<State> way;
    for (; v != no_vertex; v = parents_[v]) way.push_back(states_[v]);
    return way;
  }

 protected:
  VertexId add(const State& state, VertexId parent) {
    costs_.push_back(parent == no_vertex ? 0.0 : costs_[parent] + length(parent, state));
    states_.push_back(state);
    parents_.push_back(parent);
    index_.insert(embedded(*world_, state));
    return static_cast<VertexId>(states_.size() - 1);
  }

  std::vector<VertexId> parents_;
  std::vector<double> costs_;

 private:
  static constexpr std::uint64_t work_of_state = 1;
  static constexpr std::size_t index_bytes = sizeof(Embedding) > 4 * sizeof(double) ? 96 : 32;  // of its own, a state
  static constexpr std::size_t bytes_a_state =
      sizeof(State) + sizeof(VertexId) + sizeof(double) + sizeof(Embedding) + index_bytes;
  static std::size_t next_size(std::size_t states) {
    constexpr std::size_t least = 64;  // small trees count, too: there may be 4,096
    return states + std::max(least, states / 8);
  }

  const W* world_;
  GrowthDirection direction_;
  std::vector<State> states_;
  GrowingTree<embedding_dimension<W>> index_;
  std::size_t asked_at_ = 0;  // at so many states memory is asked for again
  std::uint64_t work_ = 0;
};

/// The trees as a roadmap, one after the other; the first root of the first tree and of the last stand once more as
/// start and goal. Throws Stopped.
template <SteerableWorld W>
void keep_trees(std::span<const MotionTree<W>> trees, PlannedRoadmap<typename W::State>& roadmap,
                const Execution& execution) {
  std::vector<Edge> edges;
  std::size_t count = 2;
  for (const MotionTree<W>& tree : trees) count += tree.size();
  execution.reserve(count * (sizeof(typename W::State) + 2 * sizeof(Edge)));
  edges.reserve(count);
  roadmap.states.clear();
  roadmap.states.reserve(count);
  roadmap.motions.clear();
  roadmap.motions.reserve(count);
  for (const MotionTree<W>& tree : trees) {
    const auto first = static_cast<VertexId>(roadmap.states.size());
    for (VertexId v = 0; v < tree.size(); ++v) {
      execution.poll(v);
      roadmap.states.push_back(tree.state(v));
      if (tree.parent(v) == no_vertex) continue;
      edges.push_back({first + tree.parent(v), first + v});
      const bool forward = tree.direction() == GrowthDirection::forward;
      roadmap.motions.push_back(forward ? edges.back() : Edge{first + v, first + tree.parent(v)});
    }
  }
  roadmap.states.push_back(trees.front().state(0));
  roadmap.states.push_back(trees.back().state(0));
  roadmap.graph = assemble_graph(roadmap.states.size(), edges, execution);
}

// Runs independent searches by growing trees side by side until one arrives, so that the answer does not depend on the
// machine: all of them take the same number of steps, batch after batch; after a batch the first in index order that
// has arrived answers. Batches grow from 32 to 1024 steps, so that easy problems waste little. Every search is a
// function of (problem, options, index); the threads are used across searches.

/// The seed of the index-th tree.
inline std::uint64_t tree_seed(std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t purpose = 0x7265657374726565U;
  return index == 0 ? seed : random_bits(seed, index, purpose);
}

/// A motion's length where none is given: a third of the way from the middle of the states to a corner of them, were
/// the coordinates square to each other, by the embedding (a car's own metric has loops in it).
template <World W>
double usual_step(const W& world) {
  std::array<double, W::dimension> u;
  u.fill(0.5);
  const auto middle = world.embed(world.at_unit(u));
  double sum = 0.0;
  for (std::size_t axis = 0; axis < W::dimension; ++axis) {
    u[axis] = std::nextafter(1.0, 0.0);
    const auto end = world.embed(world.at_unit(u));
    for (std::size_t i = 0; i < end.size(); ++i) sum += (end[i] - middle[i]) * (end[i] - middle[i]);
    u[axis] = 0.5;
  }
  return std::sqrt(sum) / 3.0;
}

/// s.advance(steps) takes so many steps, fewer where it arrives or gives up; s.arrived(), s.gave_up(),
/// s.counters() and s.finish(solution, keep, execution).
namespace detail {

/// Batches until one has arrived or all have given up: which one answers.
template <class Search>
std::optional<std::size_t> race(std::vector<Search>& searches, std::uint64_t& batches, const Execution& execution) {
  constexpr std::uint64_t first_batch = 32;
  constexpr std::uint64_t last_batch = 1024;
  for (std::uint64_t steps = first_batch;; steps = std::min(2 * steps, last_batch)) {
    ++batches;
    for_chunks(searches.size(), 1, execution, [&](Range r) { searches[r.first].advance(steps, execution); });
    const auto winner = std::find_if(searches.begin(), searches.end(), [](const Search& s) { return s.arrived(); });
    if (winner != searches.end()) return static_cast<std::size_t>(winner - searches.begin());
    if (std::all_of(searches.begin(), searches.end(), [](const Search& s) { return s.gave_up(); })) return std::nullopt;
  }
}

/// The goals that are free. Throws Stopped.
template <World W>
std::vector<typename W::State> free_states(const W& world, std::span<const typename W::State> states,
                                           const Execution& execution) {
  auto query = world.make_query();
  std::vector<typename W::State> free;
  for (const auto& state : states) {
    execution.check();
    if (world.is_free(state, query)) free.push_back(state);
  }
  return free;
}

/// Search(world, start, goals, options, step, index) for each tree; the whole plan.
template <class Search, SteerableWorld W>
Solution<typename W::State> race_trees(const W& world, const typename W::State& start,
                                       std::span<const typename W::State> goals, const RrtOptions& options,
                                       const Execution& execution, PlannedRoadmap<typename W::State>* keep) {
  options.validate();
  Solution<typename W::State> solution;
  std::vector<Search> searches;
  try {
    const auto free_goals = free_states(world, goals, execution);
    const bool starts = !free_states(world, std::span(&start, 1), execution).empty();
    if (!starts || free_goals.empty()) {
      solution.outcome = starts ? Outcome::goal_blocked : Outcome::start_blocked;
      return solution;
    }
    const StageTimer timer(execution, "search", solution.seconds.search);
    const double step = options.step ? *options.step : usual_step(world);
    for (std::uint32_t i = 0; i < options.trees; ++i) searches.emplace_back(world, start, free_goals, options, step, i);
    const auto winner = race(searches, solution.counters.rounds, execution);
    solution.outcome = winner ? Outcome::solved : Outcome::not_connected;
    searches[winner.value_or(0)].finish(solution, keep, execution);
  } catch (const Stopped& stopped) {
    mark_stopped(solution, stopped);
  }
  for (const Search& search : searches) solution.counters += search.counters();
  return solution;
}

}  // namespace detail

}  // namespace warren
