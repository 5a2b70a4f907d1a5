// SPDX-License-Identifier: BSD-3-Clause
// RRT-Connect (Kuffner, LaValle, ICRA 2000): a tree from the start and one from the goals. In turns, one grows a step
// towards a sample, the other as far as it gets towards the new state; where it arrives, the trees are joined.
// There may be many goals (a heading that doesn't matter, several inverse-kinematics branches): each is a root.
// Where a world knows roughly which places are free at the heading of the start or the goal (PlaceWorld), a way over
// these is tried before anything is drawn: it needs a dozen motion checks instead of some hundred. It is the same for
// all seeds; what it finds of motions stays in the trees.
// Cost a step: a neighbour query, O(log^2 n), and a few motion checks, which dominate. Not asymptotically optimal:
// pull the path taut with planners/shorten/shortcut.hpp. Probabilistically complete; that there is no path is never
// proved.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <type_traits>

#include "planners/graph/any_world.hpp"
#include "planners/graph/no_path.hpp"
#include "planners/trees/motion_tree.hpp"
#include "planners/trees/way_over_places.hpp"

namespace warren {

namespace detail {

/// One pair of trees.
template <SteerableWorld W>
class RrtConnectSearch {
 public:
  using State = typename W::State;

  RrtConnectSearch(const W& world, const State& start, std::span<const State> goals, const RrtOptions& options,
                   double step, std::uint64_t index)
      : world_(&world),
        options_(&options),
        step_(step),
        seed_(tree_seed(options.seed, index)),
        query_(world.make_query()),
        trees_{MotionTree<W>(world, GrowthDirection::forward), MotionTree<W>(world, GrowthDirection::backward)},
        begun_(index != 0) {
    trees_[0].add_root(start);
    for (const State& goal : goals) trees_[1].add_root(goal);
  }

  void advance(std::uint64_t steps, const Execution& execution) {
    if (!begun_) try_places(execution);
    begun_ = true;
    for (std::uint64_t i = 0; i < steps && !arrived() && !gave_up(); ++i) {
      execution.check();
      for (MotionTree<W>& tree : trees_) tree.ask_room(execution);
      take_step();
    }
    counters_.refused = refused_motions(query_);
  }
  bool arrived() const { return arrived_; }
  bool gave_up() const { return node_count() >= options_->nodes || counters_.samples >= most_steps(); }
  const Counters& counters() const { return counters_; }
  void finish(Solution<State>& solution, PlannedRoadmap<State>* keep, const Execution& execution) const;

 private:
  /// Trees that are shut in on all sides never get their nodes.
  std::uint64_t most_steps() const { return 64 * options_->nodes; }
  std::size_t node_count() const { return trees_[0].size() + trees_[1].size(); }
  void take_step();
  std::optional<VertexId> walk(MotionTree<W>& tree, VertexId from, const PlaceWay& way, const Execution& execution);
  VertexId try_places(std::size_t side, VertexId root, const Execution& execution);
  void try_places(const Execution& execution);

  const W* world_;
  const RrtOptions* options_;
  double step_;
  std::uint64_t seed_;
  typename W::Query query_;
  std::array<MotionTree<W>, 2> trees_;  // from the start, from the goals
  std::array<VertexId, 2> meeting_{};   // where they meet, in each tree
  std::size_t turn_ = 0;                // whose turn it is
  bool arrived_ = false;
  bool begun_;  // the way over places is tried by the first pair of trees alone
  Counters counters_;
};

/// Grows the tree from a vertex along the way, over more of its places where a corner is cut too close: its last
/// vertex.
template <SteerableWorld W>
std::optional<VertexId> RrtConnectSearch<W>::walk(MotionTree<W>& tree, VertexId from, const PlaceWay& way,
                                                  const Execution& execution) {
  constexpr int most_failures = 12;
  if (way.corners.empty()) return std::nullopt;
  VertexId last = from;
  std::uint32_t at = 0;
  int failures = 0;
  for (const std::uint32_t corner : way.corners) {
    for (std::uint32_t stop = corner; at < corner;) {
      execution.check();
      if (gave_up()) return std::nullopt;
      const State next = world_->shifted(tree.state(from), way.places[stop]);
      if (const auto grown = tree.join(last, next, query_, counters_)) {
        last = *grown;
        at = stop;
        stop = corner;
      } else {
        if (stop == at + 1 || ++failures == most_failures) return std::nullopt;
        stop = at + (stop - at) / 2;
      }
    }
  }
  return last;
}

/// From a root of a tree to the nearest vertex of the other tree: straight on, or else with its heading kept to where
/// that one is, and then to it. Returns that vertex.
template <SteerableWorld W>
VertexId RrtConnectSearch<W>::try_places(std::size_t side, VertexId root, const Execution& execution) {
  MotionTree<W>& mine = trees_[side];
  const State start = mine.state(root);
  const VertexId end = trees_[1 - side].nearest(start, counters_);
  const State goal = trees_[1 - side].state(end);
  std::optional<VertexId> last = mine.join(root, goal, query_, counters_);
  if (!last) {
    const PlaceWay way = way_over_places(world_->free_places(start), world_->place_of(start), world_->place_of(goal));
    last = walk(mine, root, way, execution);
    if (last && !(mine.state(*last) == goal)) last = mine.join(*last, goal, query_, counters_);
  }
  if (!last) return end;
  arrived_ = true;
  meeting_[side] = *last;
  meeting_[1 - side] = end;
  return end;
}

/// Before anything is drawn: first at the heading of the start, then at that of the goal next to it.
template <SteerableWorld W>
void RrtConnectSearch<W>::try_places(const Execution& execution) {
  if (!world_->has_places() || !options_->places || options_->sampler || gave_up()) return;
  const VertexId goal = try_places(0, 0, execution);
  const State& from = trees_[0].state(0);
  const State& to = trees_[1].state(goal);
  const bool is_turned = !(world_->shifted(from, world_->place_of(to)) == to);
  if (!arrived_ && is_turned) try_places(1, goal, execution);
}

template <SteerableWorld W>
void RrtConnectSearch<W>::take_step() {
  MotionTree<W>& mine = trees_[turn_];
  MotionTree<W>& other = trees_[1 - turn_];
  // The first targets are the other tree's roots: in the open that is all.
  const bool straight = counters_.samples < 2;
  const State target =
      straight ? other.state(0)
               : target_state(*world_, options_->sampler_of(counters_.samples), seed_, counters_.samples, query_);
  ++counters_.samples;
  const auto grown = mine.extend(mine.nearest(target, counters_), target, step_, query_, counters_);
  if (grown) {
    const VertexId reached =
        other.connect(other.nearest(mine.state(*grown), counters_), mine.state(*grown), step_, query_, counters_);
    arrived_ = other.state(reached) == mine.state(*grown);
    meeting_[turn_] = *grown;
    meeting_[1 - turn_] = reached;
  }
  turn_ = 1 - turn_;
}

template <SteerableWorld W>
void RrtConnectSearch<W>::finish(Solution<State>& solution, PlannedRoadmap<State>* keep,
                                 const Execution& execution) const {
  solution.roadmap = {node_count(), node_count() - 1, arrived_ ? 1U : 2U};
  if (arrived_) {
    solution.path = trees_[0].way_to_root(meeting_[0]);
    std::reverse(solution.path.begin(), solution.path.end());
    const Path<State> rest = trees_[1].way_to_root(meeting_[1]);
    solution.path.insert(solution.path.end(), rest.begin() + 1, rest.end());
  } else {
    solution.separation = separation_between<embedding_dimension<W>>(trees_[0].embeddings(execution),
                                                                     trees_[1].embeddings(execution), execution);
  }
  if (keep != nullptr) keep_trees<W>(trees_, *keep, execution);
}

}  // namespace detail

/// Plans from start to one of the goals (at least one). Never throws Stopped: a deadline gives Outcome::stopped;
/// InputError for options out of range. goal_blocked: none of the goals is free. not_connected: every pair of trees
/// reached its number of nodes; the separation is the first one's. `keep`, where given, receives the trees that
/// answered. The same for any number of threads.
template <class State, bool one_way>
Solution<State> rrt_connect(const AnyWorld<State, one_way>& world, const State& start,
                            std::span<const std::type_identity_t<State>> goals, const RrtOptions& options,
                            const Execution& execution, PlannedRoadmap<State>* keep = nullptr) {
  return detail::race_trees<detail::RrtConnectSearch<AnyWorld<State, one_way>>>(world, start, goals, options, execution,
                                                                                keep);
}

}  // namespace warren
