// SPDX-License-Identifier: BSD-3-Clause
// RRT* (Karaman, Frazzoli, Int. J. Robotics Research 30(7), 2011, the variant by k nearest neighbours): a tree from the
// start whose states take the cheapest parent among their e (1 + 1/d) ln n nearest, and become the parent of those that
// get cheaper by it: the cost approaches the least one as the tree grows. It is advanced by counted work, and can be
// told a path that others found. Parents are tried in the order of what the state would cost with them, so that most
// steps check one motion or two instead of all. Costs are always right: where a state gets cheaper, its subtree does.
// Neighbours are found by the world's embedding; the metric decides among them, in the direction of travel, so that
// one-way worlds are served. A new state within a step of a goal tries it at once. Informed: samples from
// planners/roadmap/sampler.hpp, and no state is added through which a path can't be cheaper than the best. Cost a step:
// one neighbour query or two, O(log^2 n), two metrics a neighbour, and the motion checks, which dominate. Memory: a
// MotionTree, and 12 bytes a state.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planners/roadmap/connection.hpp"
#include "planners/trees/motion_tree.hpp"

namespace warren {

struct RrtStarOptions {
  std::uint64_t seed = 1;         ///< any value
  double step = 0.0;              ///< longest motion towards a sample, in the world's metric; > 0
  std::uint64_t nodes = 100'000;  ///< a tree of so many states grows no more; 2 .. 2^31
  bool informed = true;           ///< else the textbook's: goal bias, and samples from everywhere
  double goal_bias = 0.05;        ///< share of samples that are a goal, while no path is known; others are uniform
};

/// A forward tree whose states may get other parents. For one thread.
template <SteerableWorld W>
class RewiredTree : public MotionTree<W> {
 public:
  using State = typename W::State;

  explicit RewiredTree(const W& world) : MotionTree<W>(world, GrowthDirection::forward) {}

  void ask_room(const Execution& execution) { MotionTree<W>::ask_room(execution, sizeof(Kin)); }
  static std::size_t room_for(std::size_t states) { return MotionTree<W>::room_for(states, sizeof(Kin)); }
  void add_root(const State& state) {
    MotionTree<W>::add_root(state);
    kin_.push_back({});
  }
  /// A state whose motion from its parent is free.
  VertexId insert(const State& state, VertexId parent) {
    const VertexId v = this->add(state, parent);
    kin_.push_back({});
    hang(v, parent);
    return v;
  }
  /// The motion from the new parent to v is free and makes v cheaper. Throws Stopped: then costs below v may be old.
  void change_parent(VertexId v, VertexId parent, const Execution& execution) {
    unhang(v);
    this->parents_[v] = parent;
    hang(v, parent);
    open_.assign(1, v);
    for (std::uint64_t count = 1; !open_.empty(); ++count) {
      execution.poll(count);
      const VertexId next = open_.back();
      open_.pop_back();
      this->costs_[next] = this->costs_[this->parents_[next]] + this->length(this->parents_[next], this->state(next));
      for (VertexId child = kin_[next].first_child; child != no_vertex; child = kin_[child].next)
        open_.push_back(child);
    }
  }

 private:
  struct Kin {
    VertexId first_child = no_vertex;
    VertexId next = no_vertex;  // of the parent's other children
    VertexId before = no_vertex;
  };
  void hang(VertexId v, VertexId parent) {
    VertexId& first = kin_[parent].first_child;
    kin_[v].next = first;
    kin_[v].before = no_vertex;
    if (first != no_vertex) kin_[first].before = v;
    first = v;
  }
  void unhang(VertexId v) {
    const Kin kin = kin_[v];
    (kin.before == no_vertex ? kin_[this->parents_[v]].first_child : kin_[kin.before].next) = kin.next;
    if (kin.next != no_vertex) kin_[kin.next].before = kin.before;
  }

  std::vector<Kin> kin_;
  std::vector<VertexId> open_;  // scratch
};

/// For one thread. Refers to the world.
template <SteerableWorld W>
class RrtStarTree {
 public:
  using State = typename W::State;

  /// start, goals (at least one): free.
  RrtStarTree(const W& world, const State& start, std::span<const State> goals, const RrtStarOptions& options)
      : options_(options),
        query_(world.make_query()),
        world_(&world),
        sampler_(world, start, goals, options.seed),
        at_goal_(goals.size(), no_vertex),
        tree_(world) {
    tree_.add_root(start);
    note_goal(0);
  }

  /// Until so much more work() is done, or the tree is full. Informed: `best`, the cost of the best path known
  /// (infinity: none), and `guide`, that path (empty: none), say where samples and new states may be. Throws Stopped.
  void advance(std::uint64_t work, double best, const Path<State>& guide, const Execution& execution) {
    const std::uint64_t until = this->work() + work;
    const auto length = [this](const State& a, const State& b) { return world_->distance(a, b); };
    const Guide along{guide, lengths_along(guide, length)};
    while (this->work() < until && !is_full()) {
      execution.check();
      tree_.ask_room(execution);
      take_step(best, along, execution);
    }
    counters_.refused = refused_motions(query_);
  }
  /// The states of a free path from the start join the tree with the costs that they have on it, where these are less
  /// than what they cost. Throws Stopped.
  void take(const Path<State>& path, const Execution& execution) {
    if (path.empty() || !(path.front() == tree_.state(0))) return;
    VertexId last = 0;
    for (std::size_t i = 1; i < path.size() && !is_full(); ++i) {
      execution.check();
      tree_.ask_room(execution);
      const VertexId found = tree_.nearest(path[i], counters_);
      if (!(tree_.state(found) == path[i])) {
        last = tree_.insert(path[i], last);
        note_goal(last);
        continue;
      }
      if (is_cheaper(tree_.cost(last) + tree_.length(last, path[i]), found))
        tree_.change_parent(found, last, execution);
      last = found;
    }
  }

  /// Of the best path to a goal; infinity: there is none.
  double cost() const {
    const VertexId last = best_goal();
    return last == no_vertex ? infinity : tree_.cost(last);
  }
  /// Start to goal; empty: there is none.
  Path<State> path() const {
    Path<State> way = tree_.way_to_root(best_goal());
    std::reverse(way.begin(), way.end());
    return way;
  }
  std::size_t size() const { return tree_.size(); }
  bool is_full() const { return tree_.size() >= options_.nodes; }
  const Counters& counters() const { return counters_; }
  /// That of its tree, and 1 for each sample that came to nothing.
  std::uint64_t work() const { return tree_.work() + idle_samples_; }
  /// For keep_trees(), and whoever wants to look.
  const MotionTree<W>& tree() const { return tree_; }

 private:
  static constexpr bool one_way = is_one_way<W>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double noise = 1e-9;  // share of a cost that rounding may feign: no gain

  /// What is near a state.
  struct Near {
    double cost;  // of the state by a motion from the vertex
    VertexId vertex;
    double length;  // of that motion
    friend auto operator<=>(const Near& a, const Near& b) = default;
  };
  struct Guide {
    const Path<State>& path;
    std::vector<double> along;
  };

  bool is_cheaper(double cost, VertexId v) const { return cost < tree_.cost(v) * (1.0 - noise); }
  VertexId best_goal() const {
    VertexId best = no_vertex;
    for (const VertexId v : at_goal_) {
      if (v != no_vertex && (best == no_vertex || tree_.cost(v) < tree_.cost(best))) best = v;
    }
    return best;
  }
  /// Keeps in mind the goal at which a vertex stands, if it does.
  void note_goal(VertexId v) {
    for (std::size_t i = 0; i < at_goal_.size(); ++i) {
      if (at_goal_[i] == no_vertex && sampler_.goals()[i] == tree_.state(v)) at_goal_[i] = v;
    }
  }
  std::optional<State> next_target(double best, const Guide& guide) {
    constexpr std::uint64_t choice_axis = 8;  // below 16: no axis of the samplers
    constexpr double near_share = 0.25;
    const std::uint64_t index = counters_.samples++;
    const double choice = uniform(options_.seed, index, choice_axis);
    if (options_.informed) {
      const bool guided = guide.path.size() > 1;
      if (guided && choice < near_share) return sampler_.near(guide.path, guide.along, index);
      if (best < infinity) {
        auto state = sampler_.informed(index, best);
        if (!state && guided) state = sampler_.near(guide.path, guide.along, index);
        return state;
      }
    }
    if (choice < options_.goal_bias) {
      const auto& goals = sampler_.goals();
      return goals[random_bits(options_.seed, index, choice_axis + 1) % goals.size()];
    }
    return target_state(*world_, SamplerKind::uniform, options_.seed, index, query_);
  }
  /// A step from the nearest state towards the target, and what is near there; nothing where the tree has it.
  std::optional<State> next_state(const State& target) {
    find_near(target);
    const auto nearest =
        std::ranges::min_element(near_, {}, [](const Near& n) { return std::pair(n.length, n.vertex); });
    State state = target;
    if (nearest->length > options_.step) {
      state = tree_.towards(nearest->vertex, target, options_.step);
      find_near(state);
    }
    const bool is_known =
        std::any_of(near_.begin(), near_.end(), [&](const Near& n) { return tree_.state(n.vertex) == state; });
    if (is_known) return std::nullopt;
    return state;
  }
  /// Free, and may a path through it be cheaper than the best?
  bool is_of_use(const State& state, double best) {
    if (sampler_.least_cost(state) < best) return tree_.is_free(state, query_);
    ++idle_samples_;
    return false;
  }
  /// The neighbours of a state, unordered.
  void find_near(const State& state) {
    const std::size_t k = star_rule(StarRule::neighbours, tree_.size(), world_->sampled_dimension(), 0.0).neighbours;
    tree_.nearest(state, k, found_, counters_);
    near_.clear();
    for (const Neighbour& n : found_) {
      const double length = tree_.length(n.id, state);
      near_.push_back({tree_.cost(n.id) + length, n.id, length});
    }
  }
  void take_step(double best, const Guide& guide, const Execution& execution) {
    best = options_.informed ? std::min(best, cost()) : infinity;
    const std::optional<State> target = next_target(best, guide);
    if (!target) {
      ++idle_samples_;
      return;
    }
    // What a query for neighbours costs is spared where the target itself, which most of the new states are, is no use.
    if (best < infinity && !is_of_use(*target, best)) return;
    const std::optional<State> state = next_state(*target);
    if (!state) return;
    if (best < infinity ? *state != *target && !is_of_use(*state, best) : !tree_.is_free(*state, query_)) return;
    const double rest = best < infinity ? sampler_.rest(*state) : 0.0;
    const std::optional<VertexId> parent = cheapest_parent(*state, rest, best);
    if (!parent) return;
    const VertexId v = tree_.insert(*state, *parent);
    note_goal(v);
    rewire(v, best, execution);
    try_goals(v, best, execution);
  }
  /// Of those near the state; nothing where no motion is free, or none that makes it cheap enough. Puts them in order.
  std::optional<VertexId> cheapest_parent(const State& state, double rest, double best) {
    std::sort(near_.begin(), near_.end());
    for (const Near& n : near_) {
      if (!(n.cost + rest < best)) return std::nullopt;
      if (tree_.is_free_motion(n.vertex, state, query_, counters_)) return n.vertex;
    }
    return std::nullopt;
  }
  /// Those near v get it as their parent where that makes them cheaper and, by the metric, of use.
  void rewire(VertexId v, double best, const Execution& execution) {
    for (const Near& n : near_) {
      const State& state = tree_.state(n.vertex);
      const double cost = tree_.cost(v) + (one_way ? tree_.length(v, state) : n.length);
      if (!is_cheaper(cost, n.vertex) || (best < infinity && !(cost + sampler_.rest(state) < best))) continue;
      if (tree_.is_free_motion(v, state, query_, counters_)) tree_.change_parent(n.vertex, v, execution);
    }
  }
  void try_goals(VertexId v, double best, const Execution& execution) {
    for (std::size_t i = 0; i < at_goal_.size(); ++i) {
      if (at_goal_[i] == v) continue;
      const State& goal = sampler_.goals()[i];
      const double length = tree_.length(v, goal);
      const double cost = tree_.cost(v) + length;
      if (length > options_.step || !(cost < best)) continue;
      if (at_goal_[i] != no_vertex && !is_cheaper(cost, at_goal_[i])) continue;
      if (!tree_.is_free_motion(v, goal, query_, counters_)) continue;
      if (at_goal_[i] != no_vertex) {
        tree_.change_parent(at_goal_[i], v, execution);
      } else {
        note_goal(tree_.insert(goal, v));
      }
    }
  }

  RrtStarOptions options_;
  typename W::Query query_;
  const W* world_;
  InformedSampler<W> sampler_;
  std::vector<VertexId> at_goal_;  // which vertex stands at each goal
  RewiredTree<W> tree_;
  std::uint64_t idle_samples_ = 0;
  Counters counters_;
  std::vector<Neighbour> found_;  // scratch
  std::vector<Near> near_;        // scratch
};

}  // namespace warren
