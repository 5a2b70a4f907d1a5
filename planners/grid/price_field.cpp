// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/price_field.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <utility>

#include "parallel/asked_memory.hpp"

namespace warren {

StepWeights::StepWeights(const Bitmap& blocked, Diagonal diagonal, const Execution& execution)
    : StepWeights(blocked, rule_of(diagonal), execution) {
  if (diagonal != Diagonal::unit) return;
  diagonal_at_least_ = units_a_cell;
  for (unsigned s = 0; s < steps_there_are; ++s) lengths_[s] = units_a_cell;
}

StepWeights::StepWeights(const Bitmap& blocked, StepRule rule, const Execution& execution)
    : cells_((execution.reserve(blocked.size() / 8), blocked)),
      allowed_(&allowed_steps(rule)),
      diagonal_at_least_(rule == StepRule::four ? 2 * units_a_cell : units_a_diagonal) {
  const auto stride = static_cast<std::int64_t>(cells_.stride());
  for (unsigned s = 0; s < steps_there_are; ++s) {
    offsets_[s] = static_cast<VertexId>(cell_steps[s][1] * stride + cell_steps[s][0]);  // wraps around for steps back
    lengths_[s] = is_diagonal(s) ? units_a_diagonal : units_a_cell;
  }
}

StepWeights::StepWeights(const Bitmap& blocked, Weigh weigh, const Execution& execution)
    : StepWeights(blocked, StepRule::eight, execution) {
  weigh_ = std::move(weigh);
  known_ = zeros<std::uint32_t>(std::size_t{back_steps} * cells_.number_end(), execution);
}

std::uint64_t StepWeights::first_weight(VertexId from, unsigned step) {
  const bool is_forward = step >= back_steps;
  const Cell lower = cells_.cell(is_forward ? from : from + offsets_[step]);
  const std::uint64_t weight = std::max(weigh_(lower, is_forward ? step : steps_there_are - 1 - step), lengths_[step]);
  if (weight <= std::numeric_limits<std::uint32_t>::max()) {  // dearer ones are asked for again
    known_[place_of(from, step)] = static_cast<std::uint32_t>(weight);
  }
  return weight;
}

PriceField::PriceField(StepWeights& weights, std::span<const Goal> goals, std::span<const Cell> towards,
                       const Execution& execution)
    : weights_(weights),
      towards_(towards.begin(), towards.end()),
      goals_(goals.begin(), goals.end()),
      costs_(zeros<std::uint64_t>(weights.cells().number_end(), execution)),
      buckets_(bucket_count) {
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const VertexId v = weights_.cells().number(goals_[i].cell);
    goal_cells_.emplace(v, i);
    if (weights_.cells().is_free(v) && goals_[i].cost < known(v)) reach(v, goals_[i].cost);
  }
}

std::uint64_t PriceField::estimate(VertexId v) const {
  const Cell cell = weights_.cells().cell(v);
  std::uint64_t least = unreached;
  for (const Cell to : towards_) least = std::min(least, weights_.at_least(cell, to));
  return least;
}

void PriceField::expand(VertexId v) {
  const std::uint64_t here = known(v);
  for (unsigned rest = weights_.allowed(v); rest != 0; rest &= rest - 1) {
    const auto s = static_cast<unsigned>(std::countr_zero(rest));
    const VertexId w = v + weights_.offset(s);
    if (here + weights_.length(s) >= known(w)) continue;  // a weight may be dear to find
    const std::uint64_t cost = here + weights_.weight(v, s);
    if (cost < known(w)) reach(w, cost);
  }
}

/// is_done(): is the question answered by what is settled?
template <class IsDone>
void PriceField::settle_until(const IsDone& is_done, const Execution& execution) {
  std::uint64_t turns = 0;
  for (; queued_ > 0 && !is_done(); ++current_) {
    std::vector<VertexId>& bucket = buckets_[current_ % bucket_count];
    std::vector<VertexId> later;
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // which grows
      const VertexId v = bucket[i];
      if (++turns % expansions_per_poll == 0) execution.check();
      if (costs_[v] == 0 || (costs_[v] & is_expanded) != 0) continue;  // lost by a repair, or stale
      if (bucket_of(v) > current_) {
        later.push_back(v);
        continue;
      }
      costs_[v] |= is_expanded;
      ++expanded_;
      expand(v);
    }
    queued_ -= bucket.size();
    bucket.clear();
    for (const VertexId v : later) queue(v, known(v));
  }
  if (queued_ == 0) current_ = nothing_left;
}

std::optional<std::uint64_t> PriceField::cost(VertexId v, const Execution& execution) {
  if (!weights_.cells().is_free(v)) return std::nullopt;
  if (!is_settled(v)) settle_until([&] { return is_settled(v); }, execution);
  if (known(v) == unreached) return std::nullopt;
  return known(v);
}

void PriceField::settle_all(const Execution& execution) {
  settle_until([] { return false; }, execution);
}

std::uint64_t PriceField::over_neighbours(VertexId v, std::uint64_t enough) {
  if (!weights_.cells().is_free(v)) return unreached;
  std::uint64_t least = unreached;
  for (auto [goal, end] = goal_cells_.equal_range(v); goal != end; ++goal) {
    least = std::min(least, goals_[goal->second].cost);
  }
  for (unsigned rest = weights_.allowed(v); rest != 0 && least > enough; rest &= rest - 1) {
    const auto s = static_cast<unsigned>(std::countr_zero(rest));
    const VertexId w = v + weights_.offset(s);
    if (costs_[w] == 0 || known(w) + weights_.length(s) >= least) continue;
    least = std::min(least, known(w) + weights_.weight(v, s));
  }
  return least;
}

/// Costs are looked at in their order, so that all that a cell's may rest on are decided before it (Ramalingam and
/// Reps, 1996).
bool PriceField::repair(std::span<const Cell> touched, std::uint64_t most, const Execution& execution) {
  const auto dearer = [](const auto& a, const auto& b) { return b < a; };
  std::vector<std::pair<std::uint64_t, VertexId>> doubtful;
  std::vector<VertexId> renewed;
  const auto doubt = [&](VertexId v) {
    if (costs_[v] == 0) return;
    push_asked(doubtful, {known(v), v}, execution);
    std::push_heap(doubtful.begin(), doubtful.end(), dearer);
  };
  for (const Cell c : touched) {
    push_asked(renewed, weights_.cells().number(c), execution);
    doubt(renewed.back());
  }
  for (std::uint64_t lost = 0; !doubtful.empty();) {
    std::pop_heap(doubtful.begin(), doubtful.end(), dearer);
    const auto [cost, v] = doubtful.back();
    doubtful.pop_back();
    if (costs_[v] == 0 || over_neighbours(v, cost) <= cost) continue;
    const bool is_told = (costs_[v] & is_expanded) != 0;  // else others may rest on what it had before
    costs_[v] = 0;
    push_asked(renewed, v, execution);
    if (++lost > most) return false;
    if (lost % expansions_per_poll == 0) execution.check();
    for (unsigned s = 0; s < 8; ++s) {
      const VertexId w = v + weights_.offset(s);
      // What weighs something else now was touched, and is in doubt anyway.
      if (costs_[w] == 0 || known(w) <= cost) continue;
      if (!is_told || weights_.may_weigh(v, s, known(w) - cost)) doubt(w);
    }
  }
  for (const VertexId v : renewed) {
    const std::uint64_t cost = over_neighbours(v, 0);
    if (cost >= known(v)) continue;
    costs_[v] = cost + 1;
    current_ = std::min(current_, bucket_of(v));
    queue(v, known(v));
  }
  return true;
}

std::pair<std::vector<Cell>, std::size_t> PriceField::path(Cell from, const Execution& execution) {
  std::vector<Cell> cells{from};
  VertexId v = weights_.cells().number(from);
  for (;;) {
    if (cells.size() % expansions_per_poll == 0) execution.check();
    for (auto [goal, end] = goal_cells_.equal_range(v); goal != end; ++goal) {
      if (goals_[goal->second].cost == known(v)) return {cells, goal->second};
    }
    const VertexId before = v;
    for (unsigned rest = weights_.allowed(v); rest != 0 && v == before; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      const VertexId w = v + weights_.offset(s);
      if (known(w) < known(v) && known(w) + weights_.weight(v, s) == known(v)) v = w;
    }
    if (v == before) throw std::logic_error("a field's cost rests on none of its neighbours'");
    push_asked(cells, weights_.cells().cell(v), execution);
  }
}

}  // namespace warren
