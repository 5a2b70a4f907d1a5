// SPDX-License-Identifier: BSD-3-Clause
// RRT-Connect (Kuffner, LaValle, ICRA 2000): a tree from the start and one from the goals. In turns, one grows a step
// towards a sample, the other as far as it gets towards the new state; where it arrives, the trees are joined.
// There may be many goals (a heading that doesn't matter, several inverse-kinematics branches): each is a root.
// Where a world knows roughly which places are free at the heading of the start or the goal (AnyWorld::has_places), a
// way over these is tried before anything is drawn: it needs a dozen motion checks instead of some hundred. It is the
// same for all seeds; what it finds of motions stays in the trees. Cost a step: a neighbour query, O(log^2 n), and a
// few motion checks, which dominate. Not asymptotically optimal: pull the path taut with planners/shorten/shortcut.hpp.
// Probabilistically complete; that there is no path is never proved.
//
// The way over the free places of a coarse grid: breadth first, all places of a row at once, eight neighbours each;
// then straight on as far as the places allow. First over places whose neighbours are free as well, then over all. Some
// dozens of instructions a row and step, so about 2 us: a hint to try before a search, whose motions must be checked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/base/world.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/trees/motion_tree.hpp"

namespace warren {

/// Places from start to goal, both included, and which of them are the corners of a way straight from one to the next,
/// the first and the last included. Empty where no way was found.
struct PlaceWay {
  std::vector<Vec2> places;
  std::vector<std::uint32_t> corners;
};

/// A set bit of the grid is a free place.
PlaceWay way_over_places(const PlaceGrid& free, Vec2 start, Vec2 goal);

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

  /// Before anything has grown: only paths that cost less are of use. A state is added only where its cost in its tree
  /// and the metric from there to the other end are less together, and samples are drawn where they may be. The way
  /// over places, which is the same whatever the bound, is not tried.
  void bound(double most) {
    begun_ = true;
    if (most == unbounded) return;
    std::vector<State> goals;
    for (VertexId goal = 0; goal < trees_[1].size(); ++goal) goals.push_back(trees_[1].state(goal));
    informed_.emplace(*world_, trees_[0].state(0), std::span<const State>(goals), seed_);
    most_ = most;
  }
  void advance(std::uint64_t steps, const Execution& execution) {
    advance_while([&steps] { return steps-- > 0; }, execution);
  }
  /// Until so much more work() is done: a step's is never cut.
  void advance_by_work(std::uint64_t more, const Execution& execution) {
    advance_while([this, until = work() + more] { return work() < until; }, execution);
  }
  /// That of the trees, and 1 for each sample that came to nothing; without what samplers look at.
  std::uint64_t work() const { return trees_[0].work() + trees_[1].work() + idle_samples_; }
  bool arrived() const { return arrived_; }
  /// After so many samples, too: trees that are shut in on all sides never get their nodes.
  bool gave_up() const { return node_count() >= options_->nodes || counters_.samples >= 64 * options_->nodes; }
  const Counters& counters() const { return counters_; }
  std::size_t node_count() const { return trees_[0].size() + trees_[1].size(); }
  /// In the world's metric; only where arrived().
  double cost() const { return trees_[0].cost(meeting_[0]) + trees_[1].cost(meeting_[1]); }
  /// Start to goal; only where arrived().
  Path<State> path() const {
    Path<State> whole = trees_[0].way_to_root(meeting_[0]);
    std::reverse(whole.begin(), whole.end());
    const Path<State> rest = trees_[1].way_to_root(meeting_[1]);
    whole.insert(whole.end(), rest.begin() + 1, rest.end());
    return whole;
  }
  void finish(Solution<State>& solution, PlannedRoadmap<State>* keep, const Execution& execution) const {
    solution.roadmap = {node_count(), node_count() - 1, arrived_ ? 1U : 2U};
    if (arrived_) {
      solution.path = path();
    } else {
      solution.separation = separation_between<embedding_dimension<W>>(trees_[0].embeddings(execution),
                                                                       trees_[1].embeddings(execution), execution);
    }
    if (keep != nullptr) keep_trees<W>(trees_, *keep, execution);
  }

 private:
  template <class GoesOn>
  void advance_while(const GoesOn& goes_on, const Execution& execution) {
    if (!begun_) try_places(execution);
    begun_ = true;
    while (!arrived() && !gave_up() && goes_on()) {
      execution.check();
      for (MotionTree<W>& tree : trees_) tree.ask_room(execution, 1, options_->trees);  // a bit of failed_
      take_step(execution);
    }
    counters_.refused = refused_motions(query_);
  }
  std::optional<State> next_target() {
    const std::uint64_t index = counters_.samples++;
    // The first targets are the other tree's roots: in the open that is all.
    if (index < first_targets) return trees_[1 - turn_].state(0);
    if (informed_) return informed_->informed(index, most_);
    return target_state(*world_, options_->sampler_of(index), seed_, index, query_);
  }
  /// Some of the target's joints become as they are at the vertex. False: all of them.
  bool leave_joints(State& target, const State& from) const {
    constexpr std::uint64_t purpose = 0x6c65617665U;
    if constexpr (requires { target.size(); }) {
      static_assert(std::tuple_size_v<State> <= 16);
      const auto joints = static_cast<double>(world_->unit_dimension());
      if (!options_->moving || *options_->moving >= joints || counters_.samples <= first_targets) return true;
      const double left = std::round(16.0 * (1.0 - *options_->moving / joints));
      const std::uint64_t bits = random_bits(seed_, counters_.samples, purpose);
      for (std::size_t j = 0; j < target.size(); ++j) {
        if (static_cast<double>(bits >> (4 * j) & 15U) < left) target[j] = from[j];
      }
      return !(target == from);
    }
    return true;
  }
  void take_step(const Execution& execution) {
    const std::size_t side = turn_;
    MotionTree<W>& mine = trees_[side];
    std::optional<State> target = next_target();
    if (!target) {
      ++idle_samples_;
      return;
    }
    const VertexId from = mine.nearest(*target, counters_);
    // In turns; where there are domains, a tree that is less than half of the other one goes on.
    if (!options_->domain || trees_[1 - side].size() < 2 * mine.size()) turn_ = 1 - side;
    // An obstacle near to the vertex takes the most of samples so far away.
    const bool has_failed = from < failed_[side].size() && failed_[side][from];
    if (options_->domain && has_failed && mine.length(from, *target) > *options_->domain * step_) return;
    if (!leave_joints(*target, mine.state(from))) return;
    const State next = mine.towards(from, *target, step_);
    if (!is_worth(side, from, next)) return;
    if (const auto grown = mine.join(from, next, query_, counters_))
      return meet(side, gone_on(side, *grown, *target), execution);
    if (!options_->domain) return;
    if (from >= failed_[side].size()) failed_[side].resize(mine.size());
    failed_[side][from] = true;
  }
  /// Where there are domains and the question is no easy one, a step more, if that is free.
  VertexId gone_on(std::size_t side, VertexId grown, const State& target) {
    constexpr std::uint64_t easy = 200;  // motions asked for; paths of easy questions are shorter without
    MotionTree<W>& mine = trees_[side];
    if (!options_->domain || counters_.edges_checked < easy || mine.state(grown) == target) return grown;
    const State next = mine.towards(grown, target, step_);
    return is_worth(side, grown, next) ? mine.join(grown, next, query_, counters_).value_or(grown) : grown;
  }
  bool is_worth(std::size_t side, VertexId from, const State& next) const {
    if (most_ == unbounded) return true;
    const double least_rest = side == 1 ? trees_[0].length(0, next) : informed_->rest(next);  // to the other end
    return trees_[side].cost(from) + trees_[side].length(from, next) + least_rest < most_;
  }
  /// Grows the other tree towards a new state of this one.
  void meet(std::size_t side, VertexId grown, const Execution& execution) {
    constexpr std::uint64_t motions_a_poll = 64;
    MotionTree<W>& other = trees_[1 - side];
    const State& state = trees_[side].state(grown);
    const VertexId from = other.nearest(state, counters_);
    const bool bounded = most_ != unbounded;
    if (bounded && !(trees_[side].cost(grown) + other.cost(from) + other.length(from, state) < most_)) return;
    meeting_[side] = grown;
    std::uint64_t motions = 0;
    meeting_[1 - side] = other.connect(from, state, step_, query_, counters_, [&] {
      if (++motions % motions_a_poll == 0) execution.check();
      other.ask_room(execution, 1, options_->trees);
      return !gave_up();
    });
    arrived_ = other.state(meeting_[1 - side]) == state && (!bounded || cost() < most_);
  }
  /// Grows the tree from a vertex along the way, over more of its places where a corner is cut too close: its last
  /// vertex.
  std::optional<VertexId> walk(MotionTree<W>& tree, VertexId from, const PlaceWay& way, const Execution& execution) {
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
  VertexId try_places(std::size_t side, VertexId root, const Execution& execution) {
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
  void try_places(const Execution& execution) {
    if (!world_->has_places() || !options_->places || options_->sampler || gave_up()) return;
    const VertexId goal = try_places(0, 0, execution);
    const State& from = trees_[0].state(0);
    const State& to = trees_[1].state(goal);
    const bool is_turned = !(world_->shifted(from, world_->place_of(to)) == to);
    if (!arrived_ && is_turned) try_places(1, goal, execution);
  }

  static constexpr std::uint64_t first_targets = 2;
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  const W* world_;
  const RrtOptions* options_;
  double step_;
  double most_ = unbounded;                     // what a path may cost, and less
  std::optional<InformedSampler<W>> informed_;  // where it is bounded
  std::uint64_t idle_samples_ = 0;
  std::uint64_t seed_;
  typename W::Query query_;
  std::array<MotionTree<W>, 2> trees_;       // from the start, from the goals
  std::array<VertexId, 2> meeting_{};        // where they meet, in each tree
  std::size_t turn_ = 0;                     // whose turn it is
  std::array<std::vector<bool>, 2> failed_;  // from which vertices a motion has; beyond the end none
  bool arrived_ = false;
  bool begun_;  // the way over places is tried by the first pair of trees alone
  Counters counters_;
};

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

// RRT: one tree from the start (LaValle, Kuffner, Int. J. Robotics Research 20, 2001). It grows a step towards a
// sample, or, for a share `goal_bias` of the samples, towards a goal; a new state from which a goal is at most a step
// away tries it at once. rrt_connect, with a tree at either end, is faster wherever the way is narrow at the goal; this
// one is what the reports compare. Cost a step: a neighbour query, O(log^2 n), and one or two motion checks.

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
    const auto grown = tree_.join(nearest, tree_.towards(nearest, target, step_), query_, counters_);
    if (!grown) return;
    if (std::find(goals_.begin(), goals_.end(), tree_.state(*grown)) != goals_.end()) last_ = *grown;
    for (const State& goal : goals_) {
      if (arrived() || world_->distance(tree_.state(*grown), goal) > step_) continue;
      if (const auto at_goal = tree_.join(*grown, goal, query_, counters_)) last_ = *at_goal;
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
