// SPDX-License-Identifier: BSD-3-Clause
// The cells behind entries of fronts. Beside an entry stands the gate of lower rank that its way goes over, whose row
// has both halves of it, and so on down to hops, which are then walked. Nothing is searched for. Entries
// are opened level by level, all of a level in three rounds, each of which asks the memory for what the next one reads:
// one by one each would wait four times.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/execution.hpp"
#include "planners/route_cuts/hop_turns.hpp"
#include "planners/route_index/front_query.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

// The cells of a hop (planners/route_cuts/hop_turns.hpp), from marks alone: each cell of a chain says where it goes on,
// and at junctions the turns do. Cost: 3 to 6 ns a cell, on all threads.

/// A hop, and where its cells go: from `from` to `to` = `length` steps on, the first one to `first`, each further one
/// `direction`, 1 or -1, beside the one before it.
struct Hop {
  LatticePlace from;
  LatticePlace to;
  std::uint32_t length;
  int direction;
  HopTurns turns;
  CellId* first;
};

/// Writes the cells of all hops but the last one of each, as they lie: it is the next hop's first. Throws InputError
/// where marks lead elsewhere: after as many steps as the hops have, whatever the marks are. Throws Stopped.
void write_hops(const RouteIndex& index, std::span<const Hop> hops, const Execution& execution);

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
