// SPDX-License-Identifier: BSD-3-Clause
// Fronts of consecutive nodes as they are made: offsets from their own beginning, until parts are put one behind the
// other.
#pragma once

#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "planners/route_cuts/front_matrix.hpp"
#include "planners/route_cuts/separator_fronts.hpp"

namespace warren {

class FrontPart {
 public:
  /// The front of gates first .. first + gates - 1: the rows that these have in the matrix, eliminated.
  void add(GateRank first, std::uint32_t gates, std::span<const GateRank> bounds, const FrontMatrix& matrix);
  /// Room for all of them and what may be above. Asks `execution` for it.
  void reserve_for(std::span<const FrontPart> parts, const Execution& execution);
  void append(const FrontPart& next);
  /// Once all fronts are there: their parents.
  void link();
  /// Leaves nothing here.
  FrontArrays arrays(RawVector<LatticePlace> gate_place);

 private:
  std::uint64_t add_lengths(std::uint32_t gates, const FrontMatrix& matrix);
  std::uint64_t add_ways(GateRank first, std::uint32_t gates, const FrontMatrix& matrix);

  RawVector<Front> fronts_;
  RawVector<GateRank> bounds_;
  RawVector<std::uint32_t> lengths_;
  RawVector<std::uint16_t> short_lengths_;
  RawVector<std::uint16_t> ways_;
};

}  // namespace warren
