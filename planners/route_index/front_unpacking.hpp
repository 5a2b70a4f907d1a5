// SPDX-License-Identifier: BSD-3-Clause
// The cells behind entries of fronts. Beside an entry stands the gate of lower rank that its way goes over, whose row
// has both halves of it, and so on down to hops, which are then walked (hop_walk.hpp). Nothing is searched for. Entries
// are opened level by level, all of a level in three rounds, each of which asks the memory for what the next one reads:
// one by one each would wait four times.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/route_index/front_query.hpp"
#include "planners/route_index/hop_walk.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// Scratch of one thread.
class FrontUnpacking {
 public:
  explicit FrontUnpacking(const RouteIndex& index) : index_(index), fronts_(index.arrays().fronts) {}

  /// Writes the cells of the ways, one after the other, from the first gate on, which is `cells` itself: one more than
  /// their lengths together. Throws InputError where fronts contradict each other, after as many looks as there are
  /// cells at most. Throws Stopped.
  void write(std::span<const FrontStep> steps, CellId* cells, const Execution& execution);

 private:
  /// An entry whose way's cells have their place: from its lower gate on, or the other way round.
  struct Entry {
    const Front* front;
    std::uint64_t place;
    GateRank low;
    GateRank high;
    std::uint32_t length;
    bool downwards;
    CellId* cells;
  };
  /// An entry whose way goes over a gate: where its halves stand.
  struct Middle {
    Entry whole;
    GateRank gate;
    const Front* front;
    std::uint64_t low;
    std::uint64_t high;
  };
  void read_ways();
  void find_halves();
  void open_halves();
  std::uint64_t place_in(const Front& front, GateRank gate, GateRank other) const;

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  std::vector<Entry> todo_;
  std::vector<Middle> middles_;
  std::vector<Hop> hops_;
};

}  // namespace warren
