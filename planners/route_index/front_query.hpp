// SPDX-License-Identifier: BSD-3-Clause
// The shortest way between two sets of gates, by climbing the fronts from both: a front's gates are settled one after
// the other, each lessens the later ones and the bounds by its row, and then it is the parent's turn. A shortest way
// has a highest gate, which both climbs settle with its exact distance. A gate no nearer than the best way found so far
// needs no row. The arrays read are those of the fronts above both sets, each once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "planners/route_cuts/min_plus.hpp"
#include "planners/route_index/core_search.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// One entry of a front that a way uses, in the order of the way.
struct FrontStep {
  FrontId front;
  GateRank from;
  GateRank to;
  std::uint32_t length;
};

/// Scratch of one thread: 8 bytes a gate.
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
    std::vector<FrontId> climbed;
  };

  FrontId seed(Half& half, std::span<const SeenGate> seeds) const;
  void climb(std::span<const SeenGate> starts, std::span<const SeenGate> goals);
  void settle(FrontId front, Half& half);
  void settle_both(FrontId front);
  void lessen_by(const Front& f, std::uint32_t gate, Half& half, RawVector<std::uint32_t>& bounds) const;
  void load_bounds(const Front& f, const Half& half, RawVector<std::uint32_t>& bounds) const;
  void store_bounds(const Front& f, Half& half, const RawVector<std::uint32_t>& bounds) const;
  void clear(Half& half, std::span<const SeenGate> seeds) const;
  std::size_t trace(const Half& half, std::span<const SeenGate> seeds, GateRank from,
                    std::vector<FrontStep>& steps) const;
  FrontStep step_into(const Half& half, GateRank to) const;

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  const LessenRow lessen_;
  const LessenRowShort lessen_short_;
  Half forward_;
  Half backward_;
  RawVector<std::uint32_t> bounds_;
  RawVector<std::uint32_t> other_bounds_;
  std::uint32_t best_ = no_way;
  GateRank meeting_ = 0;
};

/// Where the entry of a front for gate i of it and column j > i, its gates, then its bounds, stands in the front.
inline std::uint64_t front_place(const Front& f, std::uint64_t i, std::uint64_t j) {
  return row_offset(i, f.gates, f.bounds) + (j - i - 1);
}
/// The length that stands there.
inline std::uint32_t front_entry(const FrontArrays& fronts, const Front& f, std::uint64_t place) {
  const std::uint64_t at = f.first_length() + place;
  if (!f.is_short()) return fronts.lengths[at];
  return fronts.short_lengths[at] == no_short_way ? no_way : fronts.short_lengths[at];
}

/// Column of a gate or a bound of a front, its width if it is neither.
std::uint64_t front_column(const FrontArrays& fronts, const Front& f, GateRank rank);

}  // namespace warren
