// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/leaf_elimination.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace warren {
namespace {

std::size_t place_in(std::span<const std::uint32_t> ascending, std::uint32_t value) {
  return static_cast<std::size_t>(std::lower_bound(ascending.begin(), ascending.end(), value) - ascending.begin());
}

}  // namespace

BoundLengths LeafElimination::eliminate(std::span<const JunctionId> leaf, const Execution& execution) {
  find_bounds(leaf);
  load(leaf);
  std::uint64_t left = (std::uint64_t{1} << leaf.size()) - 1;
  while (left != 0) {
    std::size_t least = most;
    int fewest = most + 1;
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
      const auto junction = static_cast<std::size_t>(std::countr_zero(rest));
      const int degree = std::popcount(neighbours_[junction][0]) + std::popcount(neighbours_[junction][1]);
      if (degree >= fewest) continue;
      fewest = degree;
      least = junction;
    }
    take_out(least);
    left &= ~(std::uint64_t{1} << least);
  }
  BoundLengths result{bounds_, FrontMatrix(bounds_.size(), execution)};
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    for (std::size_t j = i + 1; j < bounds_.size(); ++j) {
      const std::size_t to = leaf.size() + j;
      const bool joined = (neighbours_[leaf.size() + i][to / 64] >> to % 64 & 1U) != 0;
      if (!joined) continue;
      result.lengths.lessen_by_hop(i, j, length_[leaf.size() + i][to], turns(leaf.size() + i, to));
    }
  }
  return result;
}

void LeafElimination::find_bounds(std::span<const JunctionId> leaf) {
  bounds_.clear();
  for (const JunctionId v : leaf) {
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = graph_.twin[h];
      if (twin != no_half_edge && rank_[twin / 4] != no_rank) bounds_.push_back(rank_[twin / 4]);
    }
  }
  std::sort(bounds_.begin(), bounds_.end());
  bounds_.erase(std::unique(bounds_.begin(), bounds_.end()), bounds_.end());
}

void LeafElimination::load(std::span<const JunctionId> leaf) {
  assert(leaf.size() + bounds_.size() <= most);
  std::fill_n(neighbours_.begin(), leaf.size() + bounds_.size(), Neighbours{});
  std::fill_n(slots_.begin(), leaf.size() + bounds_.size(), std::uint8_t{0});
  for (std::size_t v = 0; v < leaf.size(); ++v) {
    for (HalfEdge h = 4 * leaf[v]; h < 4 * leaf[v] + 4; ++h) {
      const HalfEdge twin = graph_.twin[h];
      if (twin == no_half_edge) continue;
      const GateRank rank = rank_[twin / 4];
      const std::size_t end = rank == no_rank ? place_in(leaf, twin / 4) : leaf.size() + place_in(bounds_, rank);
      slots_[v] = static_cast<std::uint8_t>(slots_[v] | 1U << h % 4);
      if (rank != no_rank) slots_[end] = slots_of(graph_, twin / 4);
      join(v, end, graph_.length[h], {chain, static_cast<std::uint8_t>(h % 4), static_cast<std::uint8_t>(twin % 4)});
    }
  }
}

void LeafElimination::join(std::size_t a, std::size_t b, std::uint32_t length, Join how) {
  const bool joined = (neighbours_[a][b / 64] >> b % 64 & 1U) != 0;
  if (joined && length_[a][b] <= length) return;
  neighbours_[a][b / 64] |= std::uint64_t{1} << b % 64;
  neighbours_[b][a / 64] |= std::uint64_t{1} << a % 64;
  length_[a][b] = length_[b][a] = length;
  join_[a][b] = how;
  join_[b][a] = {how.by, how.to_slot, how.from_slot};
}

/// What was joined by a junction is that way in two parts, however either was joined: both were never joined anew since
/// the junction was taken out.
HopTurns LeafElimination::turns(std::size_t from, std::size_t to) {
  TurnWriter writer;
  unsigned exits = slots_[from];
  todo_.assign(1, {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)});
  while (!todo_.empty()) {
    const auto [a, b] = todo_.back();
    todo_.pop_back();
    const Join& how = join_[a][b];
    if (how.by != chain) {
      todo_.emplace_back(how.by, b);
      todo_.emplace_back(a, how.by);
      continue;
    }
    writer.take(exits, how.from_slot);
    exits = slots_[b] & ~(1U << how.to_slot);
  }
  return writer.turns();
}

void LeafElimination::take_out(std::size_t junction) {
  std::array<std::uint8_t, most> near;
  std::size_t count = 0;
  for (std::size_t word = 0; word < 2; ++word) {
    for (std::uint64_t rest = neighbours_[junction][word]; rest != 0; rest &= rest - 1) {
      near[count++] = static_cast<std::uint8_t>(64 * word + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    neighbours_[near[i]][junction / 64] &= ~(std::uint64_t{1} << junction % 64);
    for (std::size_t j = i + 1; j < count; ++j) {
      join(near[i], near[j], length_[junction][near[i]] + length_[junction][near[j]],
           {static_cast<std::uint8_t>(junction), 0, 0});
    }
  }
}

}  // namespace warren
