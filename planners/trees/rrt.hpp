// SPDX-License-Identifier: BSD-3-Clause
// RRT: one tree from the start (LaValle, Kuffner, Int. J. Robotics Research 20, 2001). It grows a step towards a
// sample, or, for a share `goal_bias` of the samples, towards a goal; a new state from which a goal is at most a step
// away tries it at once. rrt_connect, with a tree at either end, is faster wherever the way is narrow at the goal; this
// one is what the reports compare. Cost a step: a neighbour query, O(log^2 n), and one or two motion checks.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "planners/graph/any_world.hpp"
#include "planners/graph/no_path.hpp"
#include "planners/trees/motion_tree.hpp"

namespace warren {

namespace detail {

template <SteerableWorld W>
class RrtSearch {
 public:
  using State = typename W::State;

  RrtSearch(const W& world, const State& start, std::span<const State> goals, const RrtOptions& options, double step,
            std::uint64_t index)
      : world_(&world),
        options_(&options),
        step_(step),
        seed_(tree_seed(options.seed, index)),
        query_(world.make_query()),
        goals_(goals.begin(), goals.end()),
        tree_(world, GrowthDirection::forward) {
    tree_.add_root(start);
    if (std::find(goals_.begin(), goals_.end(), start) != goals_.end()) last_ = 0;
  }

  void advance(std::uint64_t steps, const Execution& execution) {
    for (std::uint64_t i = 0; i < steps && !arrived() && !gave_up(); ++i) {
      execution.check();
      tree_.ask_room(execution, 0, options_->trees);
      take_step();
    }
    counters_.refused = refused_motions(query_);
  }
  bool arrived() const { return last_ != no_vertex; }
  /// After so many samples, too: a tree that is shut in on all sides never gets its nodes.
  bool gave_up() const { return tree_.size() >= options_->nodes || counters_.samples >= 64 * options_->nodes; }
  const Counters& counters() const { return counters_; }
  void finish(Solution<State>& solution, PlannedRoadmap<State>* keep, const Execution& execution) const {
    solution.roadmap = {tree_.size(), tree_.size() - 1, 1};
    if (arrived()) {
      solution.path = tree_.way_to_root(last_);
      std::reverse(solution.path.begin(), solution.path.end());
    } else {
      std::vector<typename MotionTree<W>::Embedding> goals;
      for (const State& state : goals_) goals.push_back(embedded(*world_, state));
      solution.separation =
          separation_between<embedding_dimension<W>>(tree_.embeddings(execution), std::move(goals), execution);
    }
    if (keep != nullptr) keep_trees<W>(std::span(&tree_, 1), *keep, execution);
  }

 private:
  State next_target() {
    constexpr std::uint64_t bias_axis = 8;  // below 16: no axis of the samplers
    const std::uint64_t index = counters_.samples++;
    if (uniform(seed_, index, bias_axis) >= options_->goal_bias) {
      return target_state(*world_, options_->sampler_of(index), seed_, index, query_);
    }
    return goals_[random_bits(seed_, index, bias_axis + 1) % goals_.size()];
  }
  void take_step() {
    const State target = next_target();
    const VertexId nearest = tree_.nearest(target, counters_);
    if (tree_.state(nearest) == target) return;
    const auto grown = tree_.extend(nearest, target, step_, query_, counters_);
    if (!grown) return;
    for (const State& goal : goals_) {
      if (tree_.state(*grown) == goal) last_ = *grown;
    }
    for (const State& goal : goals_) {
      if (arrived() || world_->distance(tree_.state(*grown), goal) > step_) continue;
      if (const auto at_goal = tree_.extend(*grown, goal, step_, query_, counters_)) last_ = *at_goal;
    }
  }

  const W* world_;
  const RrtOptions* options_;
  double step_;
  std::uint64_t seed_;
  typename W::Query query_;
  std::vector<State> goals_;
  MotionTree<W> tree_;
  VertexId last_ = no_vertex;  // stands at a goal
  Counters counters_;
};

}  // namespace detail

/// Plans from start to one of the goals (at least one); as rrt_connect, with one tree and `goal_bias`.
template <class State, bool one_way>
Solution<State> rrt(const AnyWorld<State, one_way>& world, const State& start,
                    std::span<const std::type_identity_t<State>> goals, const RrtOptions& options,
                    const Execution& execution, PlannedRoadmap<State>* keep = nullptr) {
  return detail::race_trees<detail::RrtSearch<AnyWorld<State, one_way>>>(world, start, goals, options, execution, keep);
}

}  // namespace warren
