// SPDX-License-Identifier: BSD-3-Clause
// ARA* over a lattice of cells and headings whose motions end on its states: Likhachev, Gordon, Thrun, NIPS 2003.
// Rounds with falling weights of the estimate: 3, 1.5, 1.2, 1.05, 1. Each goes on from what the one before left open,
// and tells a bound that no path over the lattice falls below: the least cost + estimate of all that is open. So the
// first path comes early, and how much it may cost too much is proved, not promised.
//
// All costs are whole numbers and ties go by the order in which states were met, so as many rounds are the same path
// anywhere. A round that a stop cuts is thrown away. States are made when they are met: a block of a cell's headings at
// a time. From states near a goal a curve leads to its very pose (a join: an edge like others); from states farther
// away one is tried now and then (a shot), and from all where the lattice ends without a join. What a shot costs
// counts, but the bound is that of the lattice and its joins.
//
// What is left to go at least (CellField), for the search's estimate: from the cells of a grid, by a Dijkstra
// backwards from seeds by the knight_steps of spatial/maps/free_cells over cells that are passable, divided by a
// ratio. Grown only as far as it is asked: a value is the same whatever was asked before. Whole numbers of 1/1024
// cell, rounded down; buckets as wide as half a step, within which no value depends on another, so each is final when
// its bucket is. 4 bytes a cell.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

class CellField {
 public:
  static constexpr double unit = 0x1p-10;  ///< cells
  static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

  /// passable(cell): asked at most once a cell. ratio: >= 1. Throws Stopped, also where the memory lacks.
  CellField(std::uint32_t width, std::uint32_t height, double ratio, std::function<bool(Cell)> passable,
            const Execution& execution)
      : width_(width), height_(height), passable_(std::move(passable)), execution_(execution) {
    for (std::size_t s = 0; s < knight_steps.size(); ++s) {
      const double x = knight_steps[s][0];
      const double y = knight_steps[s][1];
      costs_[s] = std::max(1U, static_cast<std::uint32_t>(std::sqrt(x * x + y * y) / ratio / unit));
    }
    while (2U << shift_ <= costs_[0]) ++shift_;
    const std::size_t cells = std::size_t{width} * height;
    execution.reserve(cells * sizeof(std::uint32_t));
    assign_polled(values_, cells, unknown, [&] { execution.check(); });
  }
  /// From this passable cell so many cells are left, >= 0; before anything is asked.
  void seed(Cell cell, double cells) {
    const double value = std::min(std::floor(cells / unit), static_cast<double>(largest));
    reach(cell.x, cell.y, static_cast<std::uint32_t>(value));
  }
  /// In units; `never` where no steps lead to a seed.
  std::uint32_t at(Cell cell) {
    const std::uint32_t& value = values_[std::size_t{cell.y} * width_ + cell.x];
    while (settled_ < buckets_.size() && (value > largest || value >> shift_ >= settled_)) {
      if (value == blocked) return never;
      settle_bucket();
    }
    return value > largest ? never : value;
  }

 private:
  static constexpr std::uint32_t unknown = never;
  static constexpr std::uint32_t blocked = never - 1;
  static constexpr std::uint32_t largest = never - 2;

  void reach(std::uint32_t x, std::uint32_t y, std::uint32_t value) {
    const std::size_t number = std::size_t{y} * width_ + x;
    std::uint32_t& there = values_[number];
    if (there == unknown && !passable_({x, y})) there = blocked;
    if (there == blocked || value >= there || value > largest) return;
    there = value;
    const std::size_t bucket = value >> shift_;
    if (bucket >= buckets_.size()) {
      if (bucket >= buckets_.capacity()) execution_.reserve(2 * bucket * sizeof(std::vector<std::uint32_t>));
      buckets_.resize(bucket + 1);
    }
    push_asked(buckets_[bucket], static_cast<std::uint32_t>(number), execution_);
  }
  void settle_bucket() {
    execution_.check();
    const std::vector<std::uint32_t> cells = std::move(buckets_[settled_]);
    buckets_[settled_] = {};
    const std::size_t bucket = settled_++;
    for (const std::uint32_t number : cells) {
      const std::uint32_t value = values_[number];
      if (value >> shift_ != bucket) continue;  // it was reached for less
      const std::int64_t x = number % width_;
      const std::int64_t y = number / width_;
      for (std::size_t s = 0; s < knight_steps.size(); ++s) {
        const std::int64_t to_x = x + knight_steps[s][0];
        const std::int64_t to_y = y + knight_steps[s][1];
        if (to_x < 0 || to_y < 0 || to_x >= width_ || to_y >= height_) continue;
        reach(static_cast<std::uint32_t>(to_x), static_cast<std::uint32_t>(to_y), value + costs_[s]);
      }
    }
  }

  std::uint32_t width_;
  std::uint32_t height_;
  std::array<std::uint32_t, 16> costs_{};
  unsigned shift_ = 0;  // a bucket holds 2^shift_ units
  std::function<bool(Cell)> passable_;
  const Execution& execution_;
  RawVector<std::uint32_t> values_;  // also: not reached, known to be blocked
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::size_t settled_ = 0;  // buckets
};

/// A state by which a path may begin, and what leads there from the start. Gears: 1, -1, 0 of none.
struct LatticeStart {
  Cell cell;
  std::uint32_t heading = 0;
  std::uint64_t cost = 0;  ///< in the lattice's units
  std::int8_t gear = 0;    ///< in which it gets there
};

/// A curve from a state to a goal.
struct LatticeShot {
  std::size_t goal = 0;    ///< of the space's goals
  std::uint64_t cost = 0;  ///< in units, a change of gear before it not included
  std::int8_t first_gear = 0;
};

struct LatticeSearchOptions {
  std::uint64_t gear_change = 0;            ///< what it costs, in units
  double gap = 0.05;                        ///< the search ends when the bound is proved to be so near; >= 0
  std::optional<std::uint64_t> iterations;  ///< rounds, >= 1; none: as many as it takes
  double unit = 1.0;                        ///< of cost, in the world's: what improvements tell
  std::size_t judge_bytes = 0;              ///< of memory, what the judge holds whatever the path
};

/// A motion from a state, by its number among those from its heading.
struct LatticeStep {
  Cell cell;
  std::uint32_t heading = 0;
  std::uint32_t motion = 0;
};

struct LatticePath {
  std::size_t start = 0;           ///< of the space's starts
  std::vector<LatticeStep> steps;  ///< states and the motions that lead on from them
  LatticeStep last;                ///< where the shot begins
  bool is_direct = false;          ///< the shot begins at the start itself; nothing else means anything
  LatticeShot shot;
  std::uint64_t cost = std::numeric_limits<std::uint64_t>::max();  ///< the largest: there is no path
};

struct LatticeSolution {
  LatticePath path;
  std::uint64_t bound = 0;  ///< no path over the lattice costs less, but by shots
  std::uint64_t rounds = 0;
  std::uint64_t expanded = 0;
  std::uint64_t checked = 0;  ///< motions
  std::vector<Improvement> improvements;
  std::string ended_by;  ///< optimum, gap, iterations, caller or the name of a StopReason; empty: no path
  StopReason stop_reason = StopReason::time;

  bool found() const { return path.cost != std::numeric_limits<std::uint64_t>::max(); }
};

/// Space: width(), height(), headings(); motions_from(heading): a span of what has dx, dy, to, gear and cost;
/// is_free(cell, motion); extra(cell, heading, motion): what a free motion costs beyond its cost; at_least(cell,
/// heading): a consistent estimate, `no_way` where none leads to a goal; starts(), is_free_start(i); joins(cell): is a
/// goal so near that all states there are joined to it? shot(cell, heading, gear, most, gear_change): the cheapest free
/// one for less than `most`, changes of gear included, also before it; direct_shot(gear_change): from the start itself.
/// shot_pause(at_least): how many states are expanded between two shots from states that are not joined.
template <class Space>
class LatticeSearch {
 public:
  static constexpr std::uint64_t no_way = std::numeric_limits<std::uint64_t>::max();

  LatticeSearch(Space& space, const LatticeSearchOptions& options, const Execution& execution)
      : space_(space),
        options_(options),
        whole_(execution.deadline),
        execution_(execution),
        gears_(options.gear_change > 0 ? 2 : 1),
        per_cell_(space.headings() * gears_),
        starts_left_(space.starts().size(), 0) {
    const std::size_t cells = std::size_t{space.width()} * space.height();
    execution.reserve(cells * sizeof(std::uint32_t));
    assign_polled(blocks_, cells, none, [&] { execution.check(); });
  }

  /// Throws Stopped where it is stopped before the first round ends.
  LatticeSolution run() {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < starts_left_.size(); ++i)
      starts_left_[i] = space_.at_least(space_.starts()[i].cell, space_.starts()[i].heading);
    if (const std::optional<LatticeShot> direct = space_.direct_shot(no_goal, options_.gear_change)) {
      goal_cost_ = direct->cost;
      shot_ = *direct;
    }
    for (const std::uint32_t weight : weights) {
      try {
        improve(weight);
      } catch (const Stopped& stopped) {
        if (!solution_.found()) throw;
        solution_.ended_by = name_of(stopped.reason);
        solution_.stop_reason = stopped.reason;
        return std::move(solution_);
      }
      ++solution_.rounds;
      if (goal_cost_ == no_goal) return std::move(solution_);  // nothing that can be reached leads there
      const bool goes_on = goal_cost_ >= solution_.path.cost || take_path(begin);
      solution_.bound = std::max(solution_.bound, std::min(goal_cost_, least_open()));
      if (!goes_on) {
        solution_.ended_by = "caller";
      } else if (solution_.bound >= solution_.path.cost) {
        solution_.ended_by = "optimum";
      } else if (static_cast<double>(solution_.path.cost) <=
                 (1.0 + options_.gap) * static_cast<double>(solution_.bound)) {
        solution_.ended_by = "gap";
      } else if (options_.iterations && solution_.rounds >= *options_.iterations) {
        solution_.ended_by = "iterations";
      }
      if (!solution_.ended_by.empty()) break;
    }
    return std::move(solution_);
  }

  /// After a run: calls visit(cell, heading, cost) for each state that was met, of each gear; where no goal is asked
  /// and nothing estimated, all that can be, at their least costs.
  template <class Visit>
  void for_each_met(const Visit& visit) const {
    for (std::uint32_t number = 0; number < nodes_.size(); ++number) {
      if (number % a_poll == 0) execution_.check();
      if (nodes_[number].cost != unmet) visit(cell_of(number), heading_of(number), nodes_[number].cost);
    }
  }

 private:
  static constexpr std::uint64_t a_poll = 64;
  static constexpr std::uint32_t weights[] = {60, 30, 24, 21, 20};  // of the estimate, in 20ths
  static constexpr std::uint64_t parts = 20;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t start_flag = std::uint32_t{1} << 31U;
  static constexpr std::uint64_t unmet = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint64_t no_goal = std::uint64_t{1} << 56U;  // 60 of it fit, and a path costs less

  struct Node {
    std::uint64_t cost = unmet;
    std::uint64_t at_least = unmet;  // unmet: nobody has asked
    std::uint32_t parent = none;     // none: a start
    std::uint16_t via = 0;           // motion, or start
    std::uint8_t closed = 0;         // the round in which it was expanded
    bool waits = false;              // for the next round
  };
  struct Entry {
    std::uint64_t key;
    std::uint32_t node;  // or start_flag + start
    /// Heaps have the largest in front: the least key, of these the latest.
    friend bool operator<(const Entry& a, const Entry& b) { return a.key != b.key ? a.key > b.key : a.node < b.node; }
  };

  Cell cell_of(std::uint32_t node) const { return cells_[node / per_cell_]; }
  std::uint32_t heading_of(std::uint32_t node) const { return node % per_cell_ / gears_; }
  /// Of the last motion; 0 where gears cost nothing.
  std::int8_t gear_of(std::uint32_t node) const {
    if (gears_ == 1) return 0;
    return nodes_[node].parent == none && space_.starts()[nodes_[node].via].gear == 0 ? std::int8_t{0}
           : node % gears_ == 0                                                       ? std::int8_t{1}
                                                                                      : std::int8_t{-1};
  }
  std::uint32_t node_at(Cell cell, std::uint32_t heading, std::int8_t gear) {
    std::uint32_t& block = blocks_[std::size_t{cell.y} * space_.width() + cell.x];
    if (block == none) {
      if (nodes_.size() + per_cell_ >= start_flag) throw Stopped(StopReason::memory);
      if (nodes_.size() + per_cell_ > nodes_.capacity()) {
        const std::size_t more = std::max<std::size_t>(2 * nodes_.capacity(), 1024 * per_cell_);
        execution_.reserve(more * (sizeof(Node) + 1));
        nodes_.reserve(more);
      }
      block = static_cast<std::uint32_t>(cells_.size());
      cells_.push_back(cell);
      nodes_.resize(nodes_.size() + per_cell_);
    }
    const std::uint32_t node = block * per_cell_ + heading * gears_ + (gears_ == 2 && gear < 0 ? 1 : 0);
    if (nodes_[node].at_least == unmet) nodes_[node].at_least = space_.at_least(cell, heading);
    return node;
  }
  std::uint64_t key_of(std::uint64_t cost, std::uint64_t at_least) const { return parts * cost + weight_ * at_least; }
  void push(std::uint64_t key, std::uint32_t node) {
    push_asked(open_, {key, node}, execution_);
    std::push_heap(open_.begin(), open_.end());
  }

  /// What is open stays, with other keys; what waited joins it.
  void begin_round(std::uint32_t weight) {
    weight_ = weight;
    std::vector<std::uint32_t> left = std::move(waiting_);
    waiting_.clear();
    for (const Entry& entry : open_) {
      if ((entry.node & start_flag) == 0 && is_open(entry.node)) push_asked(left, entry.node, execution_);
    }
    polled_sort(left.begin(), left.end(), execution_);
    left.erase(std::unique(left.begin(), left.end()), left.end());
    ++round_;
    open_.clear();
    for (const std::uint32_t node : left) {
      nodes_[node].waits = false;
      if (nodes_[node].cost + nodes_[node].at_least < goal_cost_)
        push_asked(open_, {key_of(nodes_[node].cost, nodes_[node].at_least), node}, execution_);
    }
    const auto starts = space_.starts();
    for (std::uint32_t i = 0; i < starts.size(); ++i) {
      const std::uint64_t at_least = starts_left_[i];
      if (at_least == no_way || starts[i].cost + at_least >= goal_cost_) continue;
      push_asked(open_, {key_of(starts[i].cost, at_least), start_flag + i}, execution_);
    }
    std::make_heap(open_.begin(), open_.end());
  }
  bool is_open(std::uint32_t node) const { return nodes_[node].closed != round_; }

  /// Memory for the judge of the path is kept back from here on. Throws Stopped where it is taken already.
  void keep_back() {
    constexpr std::size_t a_step = 2048;  // four states at most, of 512 bytes as in planners/anytime
    if (whole_ == nullptr) return;
    const std::size_t bytes = options_.judge_bytes + a_step * solution_.path.steps.size();
    execution_.deadline = &but_for_judge_.emplace(whole_, std::numeric_limits<double>::infinity(), bytes);
    execution_.reserve(0);
  }

  void improve(std::uint32_t weight) {
    if (solution_.found()) keep_back();
    begin_round(weight);
    while (!open_.empty() && open_.front().key < parts * goal_cost_) {
      std::pop_heap(open_.begin(), open_.end());
      const Entry top = open_.back();
      open_.pop_back();
      if ((top.node & start_flag) != 0) {
        begin_at(top.node - start_flag);
      } else if (is_open(top.node) && top.key == key_of(nodes_[top.node].cost, nodes_[top.node].at_least)) {
        expand(top.node);
      }
    }
    if (goal_cost_ == no_goal) shoot_from_all();
  }
  /// Where the lattice ends without a join, a curve from anywhere on it may still lead to the goal.
  void shoot_from_all() {
    for (std::uint32_t number = 0; number < nodes_.size(); ++number) {
      execution_.check();  // each time: a long curve takes long
      if (nodes_[number].cost != unmet) shoot(number);
    }
  }
  /// The curve to a start's state is checked when it is the next, as few are.
  void begin_at(std::uint32_t number) {
    execution_.check();
    const LatticeStart& start = space_.starts()[number];
    starts_left_[number] = no_way;
    if (!space_.is_free_start(number)) return;
    arrive(node_at(start.cell, start.heading, start.gear), start.cost, none, static_cast<std::uint16_t>(number));
  }
  void arrive(std::uint32_t number, std::uint64_t cost, std::uint32_t parent, std::uint16_t via) {
    Node& node = nodes_[number];
    if (cost >= node.cost) return;
    node.cost = cost;
    node.parent = parent;
    node.via = via;
    if (is_open(number)) return push(key_of(cost, node.at_least), number);
    if (!node.waits) push_asked(waiting_, number, execution_);
    node.waits = true;
  }
  void expand(std::uint32_t number) {
    if (++solution_.expanded % a_poll == 0) execution_.check();
    nodes_[number].closed = round_;
    const Cell cell = cell_of(number);
    const std::uint32_t heading = heading_of(number);
    const std::int8_t gear = gear_of(number);
    const std::uint64_t cost = nodes_[number].cost;
    ++since_shot_;
    if (space_.joins(cell) || since_shot_ > space_.shot_pause(nodes_[number].at_least)) shoot(number);
    const auto motions = space_.motions_from(heading);
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const auto& motion = motions[m];
      const std::int64_t x = std::int64_t{cell.x} + motion.dx;
      const std::int64_t y = std::int64_t{cell.y} + motion.dy;
      if (x < 0 || y < 0 || x >= space_.width() || y >= space_.height()) continue;
      const std::int8_t next_gear = motion.gear == 0 ? gear : motion.gear;
      const bool changes = gear != 0 && next_gear != gear;
      const std::uint64_t there = cost + motion.cost + (changes ? options_.gear_change : 0);
      const Cell to{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      const std::uint32_t next = node_at(to, motion.to, next_gear);
      const Node& node = nodes_[next];
      if (there >= node.cost || node.at_least == no_way || there + node.at_least >= goal_cost_) continue;
      ++solution_.checked;
      if (!space_.is_free(cell, motion)) continue;
      arrive(next, there + space_.extra(cell, heading, motion), number, static_cast<std::uint16_t>(m));
    }
  }
  void shoot(std::uint32_t number) {
    since_shot_ = 0;
    const std::uint64_t cost = nodes_[number].cost;
    if (cost >= goal_cost_) return;
    const std::optional<LatticeShot> shot =
        space_.shot(cell_of(number), heading_of(number), gear_of(number), goal_cost_ - cost, options_.gear_change);
    if (!shot) return;
    goal_cost_ = cost + shot->cost;
    goal_node_ = number;
    shot_ = *shot;
  }

  /// Of what is open or waits.
  std::uint64_t least_open() const {
    std::uint64_t least = no_goal;
    const auto take = [&](std::uint64_t cost, std::uint64_t at_least) { least = std::min(least, cost + at_least); };
    for (const Entry& entry : open_) {
      if ((entry.node & start_flag) == 0) {
        if (is_open(entry.node)) take(nodes_[entry.node].cost, nodes_[entry.node].at_least);
      } else {
        take(space_.starts()[entry.node - start_flag].cost, starts_left_[entry.node - start_flag]);
      }
    }
    for (const std::uint32_t node : waiting_) take(nodes_[node].cost, nodes_[node].at_least);
    return least;
  }

  /// false: who is told has enough.
  bool take_path(std::chrono::steady_clock::time_point begin) {
    LatticePath path;
    path.cost = goal_cost_;
    path.shot = shot_;
    path.is_direct = goal_node_ == none;
    if (!path.is_direct) {
      path.last = {cell_of(goal_node_), heading_of(goal_node_), 0};
      path.cost = shot_.cost;
      std::uint32_t node = goal_node_;
      for (; nodes_[node].parent != none; node = nodes_[node].parent) {
        const std::uint32_t parent = nodes_[node].parent;
        const std::int8_t gear = gear_of(parent);
        const auto& motion = space_.motions_from(heading_of(parent))[nodes_[node].via];
        const bool changes = gear != 0 && motion.gear != 0 && motion.gear != gear;
        path.cost += motion.cost + space_.extra(cell_of(parent), heading_of(parent), motion) +
                     (changes ? options_.gear_change : 0);
        path.steps.push_back({cell_of(parent), heading_of(parent), nodes_[node].via});
      }
      std::reverse(path.steps.begin(), path.steps.end());
      path.start = nodes_[node].via;
      path.cost += space_.starts()[path.start].cost;  // since some state was met it may have become cheaper
      goal_cost_ = path.cost;
    }
    solution_.path = std::move(path);
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begin;
    const double cost = options_.unit * static_cast<double>(goal_cost_);
    solution_.improvements.push_back({solution_.rounds, since.count(), cost, cost, "lattice", 0.0});
    return execution_.on_improvement == nullptr || (*execution_.on_improvement)(solution_.improvements.back());
  }

  Space& space_;
  const LatticeSearchOptions& options_;
  const Deadline* whole_;
  std::optional<Deadline> but_for_judge_;
  Execution execution_;
  std::uint32_t gears_;
  std::uint32_t per_cell_;
  RawVector<std::uint32_t> blocks_;  // by cell
  std::vector<Cell> cells_;          // by block
  std::vector<Node> nodes_;
  std::vector<Entry> open_;  // a heap; entries that no longer say what their node does are passed over
  std::vector<std::uint32_t> waiting_;
  std::vector<std::uint64_t> starts_left_;  // what is left from each; no_way once it was looked at
  std::uint64_t weight_ = 0;
  std::uint8_t round_ = 0;
  std::uint64_t since_shot_ = 0;
  std::uint64_t goal_cost_ = no_goal;
  std::uint32_t goal_node_ = none;
  LatticeShot shot_;
  LatticeSolution solution_;
};

}  // namespace warren
