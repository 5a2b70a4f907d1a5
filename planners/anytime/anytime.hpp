// SPDX-License-Identifier: BSD-3-Clause
// A planner that gets better until it is stopped. Parts take turns: an RRT* tree (planners/trees/rrt_star), restarts of
// RRT-Connect inside the cost of the best path, lazy roadmaps of doubling size, and the body's shortener. No part is
// best everywhere: restarts are in the open, the roadmap in mazes, the tree where it is narrow; the shortener makes
// something of the variety that they find. Where it finds the shortest path of a homotopy class (points and discs in
// the plane), only classes count: then roadmaps, whose paths are in near ones, have most of the work, and a path is
// pulled taut in the turn that found it.
//
// Work is counted, not timed: a state check is 1, an edge check 4, each neighbour that a query gives 1. A turn is a
// list of tasks with fixed numbers, each a function of what was known when the turn began; they run on as many threads
// as there are, and their results are taken in the order of their numbers. So as many turns give the same bytes on any
// machine, with any number of threads. A turn that a stop cuts is thrown away.
//
// Memory is counted, too: what there is when the search begins is divided before each turn by what its work allows. So
// no task is granted what another takes, and memory ends the same turn with any number of threads.
//
// The cost is the sum of the world's metric. It comes near the best there is; how near is said by a lower bound that
// whoever asks has proved. Asymptotically optimal, as its tree is. That there is no path is never proved.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/one_way_prm.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "planners/trees/rrt_star.hpp"

namespace warren {

struct AnytimeParts {
  bool tree = true;
  bool restarts = true;
  bool roadmap = true;
  bool shorten = true;
};

struct AnytimeOptions {
  AnytimeParts parts;      ///< at least one of tree, restarts and roadmap
  bool informed = true;    ///< the tree draws where a better path may lead; else anywhere, as the textbook has it
  RrtOptions trees;        ///< step, goal bias, most nodes of the tree, seed of everything
  RoadmapOptions roadmap;  ///< but for samples and seed
  std::optional<std::uint64_t> iterations;  ///< turns; none: until something else ends it
  std::optional<double> gap;  ///< it ends when the cost is at most so much more than the bound, as a share of it
  double lower_bound = 0.0;   ///< proved at no cost: no path costs less
  bool all_goals = true;      ///< are the goals all states that will do? Else a straight way to one proves nothing
};

/// What differs from body to body. shortened and length are called from several threads at once.
template <class State>
struct AnytimeBody {
  /// The path made shorter, by draws of the seed; it may give up where it won't cost less than `hopeless`. Throws
  /// Stopped.
  std::function<Path<State>(const Path<State>&, double hopeless, std::uint64_t seed, const Execution&, Counters&)>
      shortened;
  bool draws = true;  ///< does `shortened` make use of the seed? Else what it has shortened is as short as it gets
  std::function<double(const Path<State>&)> length;    ///< as answers have it
  std::function<double(const Path<State>&)> judged_s;  ///< judges a path: the seconds that it took
  std::size_t judge_bytes = 0;                         ///< of memory, what the judge holds whatever the path
  std::function<void(const Path<State>&)> kept;        ///< takes each path that was the best; empty: nobody does
  std::function<double()> lower_bound;  ///< a better one, asked for once there is a path; empty: there is none
};

template <class State>
struct AnytimeSolution : Solution<State> {
  double cost = std::numeric_limits<double>::infinity();
  double lower_bound = 0.0;               ///< that it knew in the end
  std::vector<Improvement> improvements;  ///< ascending by iterations, falling by cost
  std::uint64_t iterations = 0;           ///< turns that were done
  /// optimum, gap, iterations, nodes, caller, or the name of a StopReason.
  std::string ended_by;
};

namespace detail {

/// What was counted since `before`, of what only grows.
inline Counters counted_since(const Counters& before, const Counters& now) {
  Counters since;
  for (const auto count : {&Counters::samples, &Counters::kept, &Counters::neighbour_queries, &Counters::edges_checked,
                           &Counters::edges_free, &Counters::refused}) {
    since.*count = now.*count - before.*count;
  }
  return since;
}

template <SteerableWorld W>
class AnytimeSearch {
 public:
  using State = typename W::State;

  AnytimeSearch(const W& world, const State& start, std::span<const State> goals, const AnytimeOptions& options,
                const AnytimeBody<State>& body, const Execution& execution)
      : world_(world),
        start_(start),
        goals_(goals.begin(), goals.end()),
        options_(options),
        body_(body),
        execution_(execution),
        step_(options.trees.step ? *options.trees.step : usual_step(world)),
        pulls_taut_(!body.draws && options.parts.shorten),
        restart_options_(options.trees) {
    constexpr std::size_t uncounted = 16;  // of so many bytes one is for paths, and for what is given back late
    if (execution.deadline != nullptr) room_ = execution.deadline->room();
    room_ -= room_ / uncounted;
    constexpr std::uint64_t restart_nodes = 20'000;
    restart_options_.nodes = restart_nodes;
    restart_options_.places = true;
    restart_options_.trees = 1;
    if (options.parts.tree) {
      tree_.emplace(world, start, std::span<const State>(goals_),
                    RrtStarOptions{.seed = random_bits(options.trees.seed, 0),
                                   .step = step_,
                                   .nodes = options.trees.nodes,
                                   .informed = options.informed,
                                   .goal_bias = options.trees.goal_bias});
    }
  }

  AnytimeSolution<State> run() {
    solution_.lower_bound = options_.lower_bound;
    const std::optional<StopReason> stop = stopped_by([&] {
      const StageTimer timer(execution_, "search", solution_.seconds.search);
      while (!has_path() && !is_ended()) take_turn(execution_);
      if (!pulls_taut_ || options_.gap) ask_bound();
      constexpr std::size_t a_state = 512;  // bytes of the judge
      const std::size_t kept_back = has_path() ? body_.judge_bytes + a_state * solution_.path.size() : 0;
      const Deadline sooner(execution_.deadline, seconds_before_the_judge(), kept_back);
      room_ -= std::min(room_, kept_back);
      Execution within = execution_;
      if (execution_.deadline != nullptr) within.deadline = &sooner;
      for (int turns = 1; !is_ended(); ++turns) {
        take_turn(within);
        if (turns == turns_before_bound) ask_bound();
      }
      ask_bound();
      is_ended();  // by the bound, maybe
    });
    if (stop) {
      solution_.ended_by = name_of(*stop);
      solution_.stop_reason = *stop;
    }
    solution_.outcome = has_path() ? Outcome::solved : stop ? Outcome::stopped : Outcome::not_connected;
    return std::move(solution_);
  }

 private:
  static constexpr std::uint64_t first_share = 64;  // without a path
  static constexpr std::uint64_t better_share = 256;
  static constexpr std::uint64_t largest_share = 16'384;
  static constexpr std::size_t restart_count = 3;
  static constexpr double hopeless = 1.5;  // what costs so many times the best is not shortened
  static constexpr double near = 1.05;     // nor any more what won't come so near it
  static constexpr int patience = 10;      // turns without luck after which a part gets half
  static constexpr int most_dull = 3;      // polishings without gain in a row, after which none is tried
  // Where only classes count:
  static constexpr std::uint64_t roadmap_shares = 8;
  static constexpr int turns_before_bound = 8;  // with a path: a proof takes as long as a good one

  enum class Part : std::uint8_t { tree, restarts, roadmap, shorten };
  struct Found {
    Part by = Part::tree;
    Path<State> path = {};
    double cost = std::numeric_limits<double>::infinity();
    bool is_shortened = false;
    Counters counters = {};
  };
  struct Restart {
    std::unique_ptr<RrtConnectSearch<W>> trees;
    std::uint64_t index = 0;  // of its seed
    Counters counted;         // of its work, what was told already
  };

  bool has_path() const { return !solution_.path.empty(); }
  double cost_of(const Path<State>& path) const {
    return path_length(path, [this](const State& a, const State& b) { return world_.distance(a, b); });
  }
  double seconds_before_the_judge() const {
    const bool has_end = execution_.seconds_left() < std::numeric_limits<double>::infinity();
    if (!has_path() || !has_end) return std::numeric_limits<double>::infinity();
    const double judged_s = body_.judged_s(solution_.path);
    return std::max(0.0, execution_.deadline->seconds_left() - 2.0 * judged_s);
  }
  /// Once there is a path, and once only.
  void ask_bound() {
    if (!has_path() || is_straight_ || !body_.lower_bound || std::exchange(has_bound_, true)) return;
    solution_.lower_bound = std::max(solution_.lower_bound, body_.lower_bound());
  }
  bool end(std::string_view why) {
    solution_.ended_by = why;
    return true;
  }
  bool is_ended() {
    constexpr double equal = 1e-9;
    if (is_enough_) return end("caller");
    if (has_path()) {
      if (is_straight_ || solution_.cost <= solution_.lower_bound * (1.0 + equal)) return end("optimum");
      if (options_.gap && solution_.cost <= solution_.lower_bound * (1.0 + *options_.gap)) return end("gap");
    }
    if (is_alone() && tree_ && tree_->is_full() && (dull_ >= most_dull || !options_.parts.shorten)) return end("nodes");
    return options_.iterations && solution_.iterations >= *options_.iterations && end("iterations");
  }

  void take_turn(const Execution& execution) {
    execution.check();
    if (solution_.iterations == 0 && try_straight()) return;
    Execution inner = execution.quiet();  // stages of parts are no stages of the whole, and tasks are what runs at once
    inner.trace = nullptr;
    inner.account = nullptr;
    std::vector<Found> found = grown(inner);
    execution.check();
    ++solution_.iterations;  // from here on nothing stops
    rough_.clear();
    const bool had_path = has_path();
    was_lucky_ = {};
    was_replaced_ = false;
    for (Found& each : found) take(each);
    adapt(had_path);
  }

  /// The straight motion to the nearest goal, where it is free, is the best there is, unless there are more goals. It
  /// is a turn by itself.
  bool try_straight() {
    const auto nearest =
        std::ranges::min_element(goals_, {}, [&](const State& goal) { return world_.distance(start_, goal); });
    auto query = world_.make_query();
    ++solution_.counters.edges_checked;
    if (!world_.is_free_motion(start_, *nearest, query)) return false;
    ++solution_.counters.edges_free;
    is_straight_ = options_.all_goals;
    solution_.path = {start_, *nearest};
    solution_.cost = world_.distance(start_, *nearest);
    ++solution_.iterations;
    tell("straight");
    return true;
  }

  /// What the parts find in this turn, in the order of their tasks: what takes longest comes first.
  std::vector<Found> grown(const Execution& execution) {
    Execution alone = execution;
    alone.threads = 1;
    const Deadline beside_trees(execution.deadline, CountedRoom{room_beside_trees(execution)});
    Execution counted = alone;
    counted.deadline = &beside_trees;
    std::vector<std::function<Found(const Execution&)>> tasks;
    const AnytimeParts& parts = options_.parts;
    if (parts.roadmap) tasks.push_back([this, &counted](const Execution&) { return draw_roadmap(counted); });
    if (parts.tree) tasks.push_back([this](const Execution& on) { return grow_tree(on); });
    if (parts.restarts) {
      for (Restart& restart : restarts_) {
        tasks.push_back([this, &restart](const Execution& on) { return grow_restart(restart, on); });
      }
    }
    if (parts.shorten && has_path() && dull_ < most_dull)
      tasks.push_back([this](const Execution& on) {
        return shortened(Part::shorten, solution_.path, std::numeric_limits<double>::infinity(), 7, on);
      });
    for (std::size_t i = 0; i < rough_.size(); ++i) {
      tasks.push_back([this, i](const Execution& on) {
        return shortened(rough_[i].by, rough_[i].path, near * solution_.cost, 8 + i, on);
      });
    }
    std::vector<Found> found(tasks.size());
    for_chunks(tasks.size(), 1, execution, [&](Range r) {
      found[r.first] = tasks[r.first](alone);
      if (pulls_taut_ && has_path()) pull_at_once(found[r.first], alone);
    });
    return found;
  }

  /// Bytes that are left where the trees grow in this turn as far as their work allows, and ask for a copy as they do.
  /// A roadmap has these, the shortener holds but paths. Throws Stopped.
  std::size_t room_beside_trees(const Execution& execution) const {
    constexpr std::uint64_t work_of_state = MotionTree<W>::work_of_motion;
    std::size_t trees = 0;
    if (tree_) {
      std::size_t most = tree_->size() + share_of(Part::tree) / work_of_state;
      for (const Path<State>& path : to_join_) most += path.size();
      trees += RewiredTree<W>::room_for(std::min<std::size_t>(most, options_.trees.nodes));
    }
    for (const Restart& restart : restarts_) {
      if (!options_.parts.restarts) break;
      const std::size_t roots = 1 + goals_.size();
      const std::size_t most = (restart.trees ? restart.trees->node_count() : roots) + restart_share() / work_of_state;
      trees += MotionTree<W>::room_for(std::min<std::size_t>(most, restart_options_.nodes), 1);
    }
    if (trees >= room_) Deadline(execution.deadline, CountedRoom{room_}).reserve(trees);  // is refused
    return room_ - trees;
  }

  /// The best path of a turn is shortened as the best path that there is; others that come near it, as rough ones.
  void take(Found& found) {
    constexpr double worth = 1e-4;
    solution_.counters += found.counters;
    if (found.path.empty() || is_enough_) return;
    const double before = solution_.cost;
    const bool is_better = found.cost < before * (1.0 - 1e-12) || !has_path();
    if (found.by == Part::shorten) {
      const bool goes_on = body_.draws && found.cost < before * (1.0 - worth);
      dull_ = goes_on ? 0 : body_.draws ? dull_ + 1 : most_dull;
    }
    if (tree_ && options_.informed && found.by != Part::tree && found.cost < near * before)
      to_join_.push_back(found.path);
    const bool is_rough = options_.parts.shorten && !found.is_shortened;
    if (!is_better) {
      if (is_rough && found.cost < hopeless * before) rough_.push_back(std::move(found));
      return;
    }
    if (was_replaced_ && !is_shortened_ && options_.parts.shorten)  // by another one in this turn: it is rough yet
      rough_.push_back({.path = std::move(solution_.path), .cost = before});
    was_replaced_ = true;
    was_lucky_[index_of(found.by)] = true;
    if (found.by != Part::shorten) dull_ = found.is_shortened && !body_.draws ? most_dull : 0;
    is_shortened_ = found.is_shortened;
    solution_.cost = found.cost;
    solution_.path = std::move(found.path);
    constexpr std::array<std::string_view, 4> names{"tree", "restarts", "roadmap", "shorten"};
    tell(names[index_of(found.by)]);
  }

  void tell(std::string_view by) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begin_;
    solution_.improvements.push_back({std::max<std::uint64_t>(1, solution_.iterations), since.count(), solution_.cost,
                                      body_.length(solution_.path), std::string(by), solution_.lower_bound});
    if (body_.kept) body_.kept(solution_.path);
    if (execution_.on_improvement != nullptr && !(*execution_.on_improvement)(solution_.improvements.back()))
      is_enough_ = true;
  }

  void adapt(bool had_path) {
    for (std::size_t part = 0; part < idle_.size(); ++part) idle_[part] = was_lucky_[part] ? 0 : idle_[part] + 1;
    if (has_path() && !had_path) {  // from first path to better ones
      share_ = better_share;
      idle_ = {};
    } else {
      share_ = std::min(largest_share, share_ + share_ / (has_path() ? 4 : is_alone() ? 1 : 2));
    }
  }

  Found grow_tree(const Execution& execution) {
    Found found{.by = Part::tree};
    if (options_.informed) {
      for (const Path<State>& path : to_join_) tree_->take(path, execution);
    }
    to_join_.clear();
    tree_->advance(share_of(Part::tree), options_.informed ? solution_.cost : std::numeric_limits<double>::infinity(),
                   solution_.path, execution);
    found.counters = counted_since(tree_counted_, tree_->counters());
    tree_counted_ = tree_->counters();
    if (!(tree_->cost() < solution_.cost)) return found;
    found.path = tree_->path();
    found.cost = cost_of(found.path);
    return found;
  }

  /// One pair of trees, from turn to turn, until it arrives or has grown too large. Each has a whole share until there
  /// is a path, since they are most often the first to arrive, then its part of one.
  Found grow_restart(Restart& restart, const Execution& execution) {
    Found found{.by = Part::restarts};
    const auto slot = static_cast<std::uint64_t>(&restart - restarts_.data());
    if (!restart.trees) {
      const std::uint64_t index = restart_count * restart.index++ + slot;
      const double looseness = 0.05 + 0.95 * uniform(options_.trees.seed, index, 15);
      restart.counted = {};
      restart.trees = std::make_unique<RrtConnectSearch<W>>(world_, start_, std::span<const State>(goals_),
                                                            restart_options_, step_, index);
      if (has_path()) restart.trees->bound(solution_.cost * (1.0 + looseness));
    }
    RrtConnectSearch<W>& trees = *restart.trees;
    trees.advance_by_work(restart_share(), execution);
    found.counters = counted_since(restart.counted, trees.counters());
    restart.counted = trees.counters();
    if (trees.arrived()) {
      found.path = trees.path();
      found.cost = cost_of(found.path);
    }
    if (trees.arrived() || trees.gave_up()) restart.trees.reset();
    return found;
  }

  /// A whole lazy roadmap, once enough is saved up for one of double the size.
  Found draw_roadmap(const Execution& execution) {
    constexpr std::uint64_t first_samples = 50;
    constexpr std::uint64_t most_doublings = 20;
    const std::uint64_t least_credit = pulls_taut_ ? 0 : 1'000;  // what the first may take: trees often arrive before
    Found found{.by = Part::roadmap};
    credit_ += share_of(Part::roadmap);
    if (credit_ < std::max(least_credit, 2 * roadmap_work_)) return found;
    RoadmapOptions options = options_.roadmap;
    options.samples = first_samples << std::min(roadmaps_, most_doublings);
    options.seed = random_bits(options_.trees.seed, roadmaps_, 14);
    options.tells_separation = false;
    const State& goal = goals_[roadmaps_ % goals_.size()];
    const Solution<State> solution = [&] {
      if constexpr (W::one_way) {
        return one_way_prm(world_, start_, goal, options, true, execution);
      } else {
        return lazy_prm(world_, start_, goal, options, execution);
      }
    }();
    if (solution.outcome == Outcome::stopped) throw Stopped(solution.stop_reason);
    ++roadmaps_;
    credit_ = 0;
    found.counters = solution.counters;
    roadmap_work_ = found.counters.samples + found.counters.neighbour_queries + 4 * found.counters.edges_checked;
    found.path = solution.path;
    if (!found.path.empty()) found.cost = cost_of(found.path);
    return found;
  }

  Found shortened(Part by, const Path<State>& path, double too_dear, std::uint64_t draw,
                  const Execution& execution) const {
    Found found{.by = by, .is_shortened = true};
    const std::uint64_t seed = random_bits(options_.trees.seed, solution_.iterations, draw);
    found.path = body_.shortened(path, too_dear, seed, execution, found.counters);
    found.cost = cost_of(found.path);
    return found;
  }
  void pull_at_once(Found& found, const Execution& execution) const {
    if (found.is_shortened || !(found.cost < hopeless * solution_.cost)) return;
    Found taut = shortened(found.by, found.path, near * solution_.cost, 0, execution);
    taut.counters += found.counters;
    found = std::move(taut);
  }

  std::uint64_t share_of(Part part) const {
    const std::uint64_t shares = is_alone() ? 4 : pulls_taut_ && part == Part::roadmap ? roadmap_shares : 1;
    return shares * share_ / (idle_[index_of(part)] >= patience ? 2 : 1);
  }
  std::uint64_t restart_share() const { return share_of(Part::restarts) / (has_path() ? restart_count : 1); }
  /// A tree by itself has the turns of all, and never had to let others come first.
  bool is_alone() const { return !options_.parts.restarts && !options_.parts.roadmap; }
  static std::size_t index_of(Part part) { return static_cast<std::size_t>(part); }

  const W& world_;
  const State start_;
  const std::vector<State> goals_;
  const AnytimeOptions& options_;
  const AnytimeBody<State>& body_;
  const Execution& execution_;
  const double step_;
  const bool pulls_taut_;  // is what the shortener makes the shortest of its class, so that only classes count?
  RrtOptions restart_options_;
  /// Bytes that trees and roadmaps may take.
  std::size_t room_ = std::numeric_limits<std::size_t>::max();

  AnytimeSolution<State> solution_;
  std::vector<Path<State>> to_join_;  // the tree has yet to take them
  std::vector<Found> rough_;  // paths that are to be shortened in the next turn, since they may come to something
  bool is_straight_ = false;  // the best path is one motion to the nearest of all goals
  bool has_bound_ = false;
  bool is_enough_ = false;     // whoever is told says so
  bool is_shortened_ = false;  // is the best path one that the shortener made?
  bool was_replaced_ = false;  // the best path is of this turn
  std::uint64_t share_ = is_alone() ? better_share : first_share;
  std::array<int, 4> idle_{};        // turns since a part brought something
  std::array<bool, 4> was_lucky_{};  // in this turn
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();

  std::optional<RrtStarTree<W>> tree_;
  Counters tree_counted_;
  std::array<Restart, restart_count> restarts_;
  std::uint64_t roadmaps_ = 0;      // that were drawn
  std::uint64_t credit_ = 0;        // work that the roadmap has saved up
  std::uint64_t roadmap_work_ = 0;  // of the last one
  int dull_ = 0;                    // polishings without gain, since the best path came
};

}  // namespace detail

/// start and goals (at least one): free. Never throws Stopped: outcome is solved with a path, else stopped, or
/// not_connected where the iterations are over. InputError for options out of range. What `body` and
/// execution.on_improvement throw passes through.
template <class State, bool one_way>
AnytimeSolution<State> anytime(const AnyWorld<State, one_way>& world, const State& start,
                               std::span<const std::type_identity_t<State>> goals, const AnytimeOptions& options,
                               const AnytimeBody<State>& body, const Execution& execution) {
  options.trees.validate();
  options.roadmap.validate();
  return detail::AnytimeSearch<AnyWorld<State, one_way>>(world, start, goals, options, body, execution).run();
}

}  // namespace warren
