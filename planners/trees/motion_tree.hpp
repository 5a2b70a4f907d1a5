// SPDX-License-Identifier: BSD-3-Clause
// A tree of free motions that grows from its roots: what rrt and rrt_connect share. A forward tree's motions lead from
// the roots to its states, a backward tree's from the states to the roots; so worlds may be used whose motions have a
// direction. A step costs one neighbour query in the world's embedding and one motion check.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/base/counters.hpp"
#include "core/base/path.hpp"
#include "core/base/world.hpp"
#include "parallel/assemble_graph.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "planners/roadmap/state_index.hpp"
#include "spatial/points/growing_tree.hpp"

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

  /// Asks for what the tree takes while it doubles, once it has doubled. Throws Stopped.
  void ask_room(const Execution& execution) {
    constexpr std::size_t index_bytes = 32;  // of its own, a state
    if (states_.size() < asked_at_) return;
    asked_at_ = 2 * states_.size();
    execution.reserve(asked_at_ * (sizeof(State) + sizeof(VertexId) + sizeof(Embedding) + index_bytes));
  }
  /// Those of all states. Throws Stopped.
  std::vector<Embedding> embeddings(const Execution& execution) const {
    execution.reserve(states_.size() * sizeof(Embedding));
    std::vector<Embedding> all;
    all.reserve(states_.size());
    for (const State& state : states_) all.push_back(embedded(*world_, state));
    return all;
  }

  VertexId nearest(const State& to, Counters& counters) {
    ++counters.neighbour_queries;
    return index_.nearest(embedded(*world_, to)).id;
  }
  /// Grows one motion from `from` towards `to`, of length `step` at most (in the world's metric): its vertex, or
  /// nothing where the motion is not free.
  std::optional<VertexId> extend(VertexId from, const State& to, double step, typename W::Query& query,
                                 Counters& counters) {
    const State state = towards(states_[from], to, step);
    ++counters.edges_checked;
    if (!world_->is_free(state, query)) return std::nullopt;
    const bool forward = direction_ == GrowthDirection::forward;
    const bool is_free = forward ? world_->is_free_motion(states_[from], state, query)
                                 : world_->is_free_motion(state, states_[from], query);
    if (!is_free) return std::nullopt;
    ++counters.edges_free;
    return add(state, from);
  }
  /// Grows one motion from `from` all the way to `to`: its vertex, or nothing where `to` or the motion is not free.
  std::optional<VertexId> join(VertexId from, const State& to, typename W::Query& query, Counters& counters) {
    ++counters.edges_checked;
    if (!world_->is_free(to, query)) return std::nullopt;
    const bool forward = direction_ == GrowthDirection::forward;
    const bool is_free =
        forward ? world_->is_free_motion(states_[from], to, query) : world_->is_free_motion(to, states_[from], query);
    if (!is_free) return std::nullopt;
    ++counters.edges_free;
    return add(to, from);
  }
  /// Grows from `from` towards `to` step by step: the last vertex, which stands at `to` where nothing is in the way.
  VertexId connect(VertexId from, const State& to, double step, typename W::Query& query, Counters& counters) {
    while (!(states_[from] == to)) {
      const std::optional<VertexId> next = extend(from, to, step, query, counters);
      if (!next) break;
      from = *next;
    }
    return from;
  }
  /// The states from v to its root, in this order.
  Path<State> way_to_root(VertexId v) const {
    Path<State> way;
    for (; v != no_vertex; v = parents_[v]) way.push_back(states_[v]);
    return way;
  }

 private:
  VertexId add(const State& state, VertexId parent) {
    states_.push_back(state);
    parents_.push_back(parent);
    index_.insert(embedded(*world_, state));
    return static_cast<VertexId>(states_.size() - 1);
  }
  State towards(const State& from, const State& to, double step) const {
    const bool forward = direction_ == GrowthDirection::forward;
    const double way = forward ? world_->distance(from, to) : world_->distance(to, from);
    if (way <= step) return to;
    return forward ? world_->interpolate(from, to, step / way) : world_->interpolate(to, from, 1.0 - step / way);
  }

  const W* world_;
  GrowthDirection direction_;
  std::vector<State> states_;
  std::vector<VertexId> parents_;
  GrowingTree<embedding_dimension<W>> index_;
  std::size_t asked_at_ = 1024;  // at so many states memory is asked for again
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

}  // namespace warren
