// SPDX-License-Identifier: BSD-3-Clause
// What it costs at least to get from any cell to a set of goals, over steps to the eight neighbours, whose weights are
// whole numbers. Whole numbers add up without rounding, so that the least sums are the same whatever the order of work:
// for any queue, any heuristic, and after any repair. A path follows the first of cell_steps that loses nothing, so it
// is unique, too.
//
// The search runs from the goals (Dijkstra), towards the cells that are asked for where these are few (A*, by what
// steps cost at least), and goes on only when more is asked. Buckets of keys are emptied in no order: a cell is
// expanded again where it gets cheaper, and is settled once its bucket is empty.
//
// 8 bytes a cell, of weights 16 more, of which the system gives only the pages that are touched.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/search.hpp"
#include "planners/grid/grid_search.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

/// Whole units of weight a cell's side.
inline constexpr std::uint64_t units_a_cell = std::uint64_t{1} << 20;
/// The diagonal of a cell, rounded up.
inline constexpr std::uint64_t units_a_diagonal = 1'482'911;

struct FreePages {
  void operator()(void* block) const { std::free(block); }
};
/// Numbers of the system's pages of zeros, which it gives where they are touched.
template <class Number>
using ZeroPages = std::unique_ptr<Number[], FreePages>;
/// Asks for the memory first. Throws Stopped.
template <class Number>
ZeroPages<Number> zeros(std::size_t count, const Execution& execution) {
  execution.reserve(count * sizeof(Number));
  auto* block = static_cast<Number*>(std::calloc(count, sizeof(Number)));
  if (block == nullptr) throw std::bad_alloc();
  return ZeroPages<Number>(block);
}

/// What steps weigh, looked up once each. Not for several threads at once: it remembers.
class StepWeights {
 public:
  /// Of the step from a cell in the direction of cell_steps, one of the last four (the others are these backwards).
  using Weigh = std::function<std::uint64_t(Cell from, unsigned direction)>;

  /// Steps that weigh their length. Throws InputError for maps of about 2^32 cells, Stopped.
  StepWeights(const Bitmap& blocked, Diagonal diagonal, const Execution& execution);
  /// The same by another rule: diagonals of sqrt(2).
  StepWeights(const Bitmap& blocked, StepRule rule, const Execution& execution);
  /// Steps of all eight directions, that weigh what `weigh` says, and no less than their length.
  StepWeights(const Bitmap& blocked, Weigh weigh, const Execution& execution);

  const FreeCells& cells() const { return cells_; }
  /// Bits of cell_steps.
  unsigned allowed(VertexId v) const { return (*allowed_)[cells_.around(v)]; }
  VertexId offset(unsigned step) const { return offsets_[step]; }
  /// Of a step, and what it weighs at least.
  std::uint64_t length(unsigned step) const { return lengths_[step]; }
  /// Of an allowed step.
  std::uint64_t weight(VertexId from, unsigned step) {
    if (!known_) return lengths_[step];
    const std::uint32_t known = known_[place_of(from, step)];
    return known != 0 ? known : first_weight(from, step);
  }
  /// May an allowed step weigh that? One that was not looked up may.
  bool may_weigh(VertexId from, unsigned step, std::uint64_t weight) const {
    if (!known_) return weight == lengths_[step];
    const std::uint32_t known = known_[place_of(from, step)];
    return known == 0 || known == weight;
  }
  /// Asks memory for what weight() will look at.
  void fetch(VertexId v) const {
    if (!known_) return;
    __builtin_prefetch(&known_[std::size_t{back_steps} * v]);
    __builtin_prefetch(&known_[std::size_t{back_steps} * (v - cells_.stride())]);
  }
  /// From now on the cell is free, or blocked. What steps near it weigh is forgotten by forget() alone.
  void change(Cell c, bool is_free) { cells_.change(c, is_free); }
  /// The steps from a cell in the last four directions are weighed anew.
  void forget(Cell c) {
    if (known_) std::fill_n(&known_[std::size_t{back_steps} * cells_.number(c)], back_steps, 0U);
  }
  /// What no way between the cells weighs less than; consistent.
  std::uint64_t at_least(Cell a, Cell b) const {
    const std::uint32_t dx = a.x < b.x ? b.x - a.x : a.x - b.x;
    const std::uint32_t dy = a.y < b.y ? b.y - a.y : a.y - b.y;
    const std::uint64_t both = dx < dy ? dx : dy;
    return both * diagonal_at_least_ + (dx + std::uint64_t{dy} - 2 * both) * units_a_cell;
  }

 private:
  static constexpr unsigned steps_there_are = 8;
  static constexpr unsigned back_steps = 4;
  /// Of what is known of a step: it stands with the one of its two cells that it goes forward from.
  std::size_t place_of(VertexId from, unsigned step) const {
    return step >= back_steps ? std::size_t{back_steps} * from + step - back_steps
                              : std::size_t{back_steps} * (from + offsets_[step]) + back_steps - 1 - step;
  }
  std::uint64_t first_weight(VertexId from, unsigned step);

  FreeCells cells_;
  const std::array<std::uint8_t, 512>* allowed_;
  std::array<VertexId, steps_there_are> offsets_{};
  std::array<std::uint64_t, steps_there_are> lengths_{};
  std::uint64_t diagonal_at_least_;
  Weigh weigh_;
  ZeroPages<std::uint32_t> known_;  // four a cell, 0: not known yet; none: lengths
};

/// The costs to a set of goals. Refers to the weights.
class PriceField {
 public:
  /// A cell to be reached, and what it costs beyond.
  struct Goal {
    Cell cell;
    std::uint64_t cost = 0;  ///< units
    bool operator==(const Goal&) const = default;
  };

  /// Blocked goals are left out. towards: where the costs will be asked for; empty: anywhere. Throws Stopped.
  PriceField(StepWeights& weights, std::span<const Goal> goals, std::span<const Cell> towards,
             const Execution& execution);

  /// The least cost from a cell to a goal, in units; none: there is no way. Throws Stopped.
  std::optional<std::uint64_t> cost(Cell from, const Execution& execution) {
    return cost(weights_.cells().number(from), execution);
  }
  std::optional<std::uint64_t> cost(VertexId from, const Execution& execution);
  /// The cells of the cheapest way, and the first of the goals at its end; cost(from) is there. Throws Stopped.
  std::pair<std::vector<Cell>, std::size_t> path(Cell from, const Execution& execution);
  /// After a change of cells or weights: costs are as a new field's again. touched: all cells that became free or
  /// blocked, and both ends of each step that weighs something else or is no more allowed or not. Costs that rest on
  /// such a step are lost, and found anew where somebody asks. false: more than `most` are lost; the field is of no use
  /// then. Throws Stopped, and is of no use then either.
  bool repair(std::span<const Cell> touched, std::uint64_t most, const Execution& execution);
  /// Is it the field of these goals towards these cells?
  bool is_of(std::span<const Goal> goals, std::span<const Cell> towards) const {
    return std::ranges::equal(goals, goals_) && std::ranges::equal(towards, towards_);
  }
  /// Everything that can be reached. Throws Stopped.
  void settle_all(const Execution& execution);
  /// Is its cost known, or an upper bound of it? After settle_all(): can it be reached?
  bool reached(Cell c) const { return costs_[weights_.cells().number(c)] != 0; }
  /// Cells that were expanded, again and again.
  std::uint64_t expanded() const { return expanded_; }

 private:
  static constexpr std::uint64_t unreached = ~std::uint64_t{0};
  static constexpr std::uint64_t nothing_left = unreached;
  static constexpr std::uint64_t bucket_count = 1024;
  static constexpr std::uint64_t is_expanded = std::uint64_t{1} << 63;
  /// One is added to what stands there, so that pages of zeros are cells that nobody has reached.
  std::uint64_t known(VertexId v) const { return (costs_[v] & ~is_expanded) - 1; }
  /// A sixteenth of a cell each: no step is so short.
  std::uint64_t bucket_of(VertexId v) const { return bucket_of(v, known(v)); }
  std::uint64_t bucket_of(VertexId v, std::uint64_t cost) const {
    return (towards_.empty() ? cost : cost + estimate(v)) / (units_a_cell / 16);
  }
  std::uint64_t estimate(VertexId v) const;
  bool is_settled(VertexId v) const { return known(v) != unreached && bucket_of(v) < current_; }
  /// What a goal in the cell costs, or the way over the cheapest of its neighbours.
  std::uint64_t over_neighbours(VertexId v, std::uint64_t enough);
  void reach(VertexId v, std::uint64_t cost) {
    costs_[v] = cost + 1;  // not expanded at that
    // Until its turn comes, what it will look at has time to come near.
    __builtin_prefetch(&costs_[v - weights_.cells().stride()]);
    __builtin_prefetch(&costs_[v + weights_.cells().stride()]);
    weights_.fetch(v);
    queue(v, cost);
  }
  /// Keys a whole turn ahead wait in the last bucket there is.
  void queue(VertexId v, std::uint64_t cost) {
    const std::uint64_t at = std::clamp(bucket_of(v, cost), current_, current_ + bucket_count - 1);
    buckets_[at % bucket_count].push_back(v);
    ++queued_;
  }
  void expand(VertexId v);
  template <class IsDone>
  void settle_until(const IsDone& is_done, const Execution& execution);

  StepWeights& weights_;
  std::vector<Cell> towards_;
  std::vector<Goal> goals_;
  std::multimap<VertexId, std::size_t> goal_cells_;  // of equal cells the first goal first
  ZeroPages<std::uint64_t> costs_;
  std::vector<std::vector<VertexId>> buckets_;  // of keys, in turns; their order within decides nothing
  std::uint64_t current_ = 0;                   // all keys below were expanded
  std::size_t queued_ = 0;
  std::uint64_t expanded_ = 0;
};

}  // namespace warren
