// SPDX-License-Identifier: BSD-3-Clause
// A breadth-first search of the core, cell by cell, that stops at gates: it sees the chain or the leaf that it begins
// in and nothing else, some hundred cells. Gates come in the order of their distance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "planners/route_index/route_index.hpp"

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

/// Scratch of one thread.
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
  void begin(LatticePlace start);
  void expand(std::uint32_t number);
  bool is_core(LatticePlace next, LatticePlace from) const;
  bool enter(LatticePlace p, std::uint32_t number);
  std::size_t slot_of(LatticePlace p) const {
    return (p * std::uint64_t{0x9e3779b97f4a7c15U} >> 32) & (slots_.size() - 1);
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

}  // namespace warren
