// SPDX-License-Identifier: BSD-3-Clause
// Questions to a route index: the shortest length between two cells, and a path of that length. Both cells climb to the
// core; cells of one tree meet in it. In the core both look around up to the gates of their leaf, and the fronts join
// these, if the other cell wasn't nearer. Exact: the length is that of a breadth-first search of the whole lattice.
// Cost: microseconds in trees, then the rows of the fronts above both; see bench/roadmaps/route_index_bench.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/route_index.hpp"
#include "planners/lengths/separator_fronts.hpp"
#include "planners/lengths/tree_routes.hpp"

namespace warren {

/// A cell that was seen. Steps and the cell it was seen from.
struct SeenCell {
  LatticePlace place;
  std::uint32_t col;
  std::uint32_t row;
  std::uint32_t steps;
  std::uint32_t from;  ///< number of a seen cell, its own for the first
};

/// A gate that a search came to.
struct SeenGate {
  GateRank rank;
  std::uint32_t steps;
  std::uint32_t seen;  ///< its number among the seen cells
};

/// A breadth-first search of the core, cell by cell, that stops at gates: it sees the chain or the leaf that it begins
/// in and nothing else, some hundred cells. Gates come in the order of their distance. Scratch of one thread.
class CoreSearch {
 public:
  explicit CoreSearch(const RouteIndex& index) : index_(index), slots_(1024) {}

  /// Everything that is reached from `start` without passing a gate. A start that is a gate is only itself.
  void search(LatticePlace start);

  std::span<const SeenGate> gates() const { return gates_; }
  /// Number of a seen cell, or none.
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint32_t number_of(LatticePlace p) const;
  const SeenCell& seen(std::uint32_t number) const { return seen_[number]; }
  /// Writes the cells on the way from the start, not included, to a seen cell, included: each as many places from
  /// `start` as it is steps from the start, in `direction`, 1 or -1.
  void write_way(std::uint32_t to, CellId* start, int direction) const;

 private:
  SeenCell first_cell(LatticePlace start) const;
  void expand(std::uint32_t number);
  bool is_core(LatticePlace next, LatticePlace from) const;
  bool enter(LatticePlace p, std::uint32_t number);
  /// Where the cell stands, or where it may: a slot of an earlier search.
  std::size_t slot_of(LatticePlace p) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (p * std::uint64_t{0x9e3779b97f4a7c15U} >> 32) & mask;
    while (slots_[slot].search == search_ && seen_[slots_[slot].number].place != p) slot = (slot + 1) & mask;
    return slot;
  }
  void grow();

  const RouteIndex& index_;
  std::vector<SeenCell> seen_;
  std::vector<SeenGate> gates_;
  /// Open addressing: number of a seen cell and in which search; at most half full.
  struct Slot {
    std::uint32_t search = 0;
    std::uint32_t number = 0;
  };
  std::vector<Slot> slots_;
  std::uint32_t search_ = 0;
};

/// One entry of a front that a way uses, in the order of the way.
struct FrontStep {
  FrontId front;
  GateRank from;
  GateRank to;
  std::uint32_t length;
};

/// The shortest way between two sets of gates, by climbing the fronts from both: a front's gates are settled one after
/// the other, each lessens the later ones and the bounds by its row, and then it is the parent's turn. A shortest way
/// has a highest gate, which both climbs settle with its exact distance. A gate no nearer than the best way found so
/// far needs no row. The arrays read are those of the fronts above both sets, each once. Scratch of one thread: 8 bytes
/// a gate.
class FrontQuery {
 public:
  explicit FrontQuery(const RouteIndex& index);

  /// Least sum of steps to a start gate, length, steps from a goal gate, if it is less than `below`; else `below`. Each
  /// set's gates bound one leaf or are one gate.
  std::uint32_t length(std::span<const SeenGate> starts, std::span<const SeenGate> goals, std::uint32_t below);

  /// The same with the way. first and last: indices into starts and goals, where the way begins and ends.
  struct Way {
    std::uint32_t length;
    std::size_t first;
    std::size_t last;
    std::vector<FrontStep> steps;  ///< none if it begins and ends at one gate
  };
  /// A way without end indices has the length `below`.
  Way way(std::span<const SeenGate> starts, std::span<const SeenGate> goals, std::uint32_t below);

 private:
  /// What one of both climbs knows.
  struct Half {
    RawVector<std::uint32_t> distance;  // of a gate, no_way where it wasn't reached
    RawVector<std::uint32_t> bounds;    // those of the bounds of the front that is settled
    std::vector<FrontId> climbed;
  };

  FrontId seed(Half& half, std::span<const SeenGate> seeds) const;
  void climb(std::span<const SeenGate> starts, std::span<const SeenGate> goals);
  void settle(FrontId front, std::span<Half* const> halves);
  void lessen_by(const Front& f, std::uint32_t gate, Half& half) const;
  void load_bounds(const Front& f, Half& half) const;
  void store_bounds(const Front& f, Half& half) const;
  void clear(Half& half, std::span<const SeenGate> seeds) const;
  std::size_t trace(const Half& half, std::span<const SeenGate> seeds, GateRank from,
                    std::vector<FrontStep>& steps) const;
  FrontStep step_into(const Half& half, GateRank to) const;

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  const LessenRow<std::uint32_t> lessen_ = lessen_row<std::uint32_t>();
  const LessenRow<std::uint16_t> lessen_short_ = lessen_row<std::uint16_t>();
  Half forward_;
  Half backward_;
  std::uint32_t best_ = no_way;
  GateRank meeting_ = 0;
};

/// Along a hop.
struct Hop : MarkedWay {
  HopTurns turns;
};

/// The cells behind entries of fronts. Beside an entry stands the gate of lower rank that its way goes over, whose row
/// has both halves of it, and so on down to hops, which are then walked. Nothing is searched for. Entries are opened
/// level by level, all of a level in three rounds, each of which asks the memory for what the next one reads: one by
/// one each would wait four times. Scratch of one thread.
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

/// Scratch of one thread: 8 bytes a gate. Refers to the index, which must outlive it.
class RouteQuery {
 public:
  explicit RouteQuery(const RouteIndex& index)
      : index_(index), trees_(index), near_start_(index), near_goal_(index), fronts_(index), unpacking_(index) {}

  /// In steps; none where no path joins the cells. Throws InputError for a cell outside the lattice.
  std::optional<std::uint32_t> length(CellId start, CellId goal);
  /// The cells of a shortest path, both ends included; empty where there is none. Throws Stopped.
  RawVector<CellId> path(CellId start, CellId goal, const Execution& execution = {.threads = 1});

 private:
  LatticePlace checked(CellId cell) const;
  std::uint32_t core_length(LatticePlace start, LatticePlace goal);
  std::uint32_t direct_length(LatticePlace goal) const;
  FrontQuery::Way core_way(LatticePlace start, LatticePlace goal);
  void write_core_way(const FrontQuery::Way& way, LatticePlace goal, CellId* cells, const Execution& execution);

  const RouteIndex& index_;
  TreeRoutes trees_;
  CoreSearch near_start_;
  CoreSearch near_goal_;
  FrontQuery fronts_;
  FrontUnpacking unpacking_;
};

}  // namespace warren
