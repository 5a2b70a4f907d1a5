// SPDX-License-Identifier: BSD-3-Clause
// The cells behind an entry of a front. An entry's way goes by an earlier gate of the front, by a gate of a front below
// that has both ends as bounds, or by no gate at all: the gate is the one whose two entries add up, and each half is
// unpacked in turn; where there is none, the cells are searched for from one end. Nothing is stored for it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "planners/route_index/core_search.hpp"
#include "planners/route_index/front_query.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// Scratch of one thread.
class FrontUnpacking {
 public:
  explicit FrontUnpacking(const RouteIndex& index) : index_(index), fronts_(index.arrays().fronts), search_(index) {}

  /// Appends the cells of the way, its first one not included.
  void append(const FrontStep& step, RawVector<CellId>& cells);

 private:
  struct Middle {
    FrontId front;
    GateRank gate;
    std::uint32_t from_low;  // its entry with the lower one of both ends
    std::uint32_t to_high;
  };
  std::optional<Middle> middle_of(const FrontStep& step);
  std::optional<Middle> middle_in(FrontId front, std::uint64_t end, std::uint64_t low, std::uint64_t high,
                                  std::uint32_t length) const;

  bool append_short(const FrontStep& step, RawVector<CellId>& cells);

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  CoreSearch search_;
  std::vector<FrontStep> todo_;
  std::vector<FrontId> below_;
};

}  // namespace warren
