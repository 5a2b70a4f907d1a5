// SPDX-License-Identifier: BSD-3-Clause
// The lengths between the bounds of a leaf by ways through its junctions: they are eliminated one by one, the one with
// the fewest neighbours first, each joining its neighbours pairwise. Neighbours are bits of two words, lengths a small
// dense matrix, all in first-level cache. Who joined whom says at last by which chains the ways between bounds go.
// About 200 ns a junction.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planners/route_cuts/dissection.hpp"
#include "planners/route_cuts/front_matrix.hpp"
#include "planners/route_cuts/hop_turns.hpp"
#include "planners/route_cuts/separator_fronts.hpp"

namespace warren {

/// What a node hands to its parent.
struct BoundLengths {
  std::vector<GateRank> bounds;  ///< ascending
  FrontMatrix lengths;           ///< between them; a leaf's ways are hops
};

/// Scratch of one thread.
class LeafElimination {
 public:
  /// rank: of each junction, none of those in leaves.
  LeafElimination(const CoreGraph& graph, const RawVector<GateRank>& rank) : graph_(graph), rank_(rank) {}

  BoundLengths eliminate(std::span<const JunctionId> leaf, const Execution& execution);

 private:
  static constexpr std::size_t most = 128;
  static_assert(3 * most_leaf_junctions + 2 <= most, "a connected leaf of n junctions has at most 2 n + 2 bounds");
  using Neighbours = std::array<std::uint64_t, 2>;

  void find_bounds(std::span<const JunctionId> leaf);
  void load(std::span<const JunctionId> leaf);
  /// By a junction, or `chain`, which leaves a and b by these slots.
  struct Join {
    std::uint8_t by;
    std::uint8_t from_slot;
    std::uint8_t to_slot;
  };
  static constexpr std::uint8_t chain = most;
  void join(std::size_t a, std::size_t b, std::uint32_t length, Join how);
  void take_out(std::size_t junction);
  HopTurns turns(std::size_t from, std::size_t to);

  const CoreGraph& graph_;
  const RawVector<GateRank>& rank_;
  std::vector<GateRank> bounds_;
  std::array<Neighbours, most> neighbours_{};
  std::array<std::array<std::uint32_t, most>, most> length_{};
  std::array<std::array<Join, most>, most> join_{};
  std::array<std::uint8_t, most> slots_{};                   // with chains, of a junction or a bound
  std::vector<std::pair<std::uint8_t, std::uint8_t>> todo_;  // parts of a way, the first one last
};

inline constexpr GateRank no_rank = ~GateRank{0};

}  // namespace warren
