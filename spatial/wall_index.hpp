// SPDX-License-Identifier: BSD-3-Clause
// placeholder: see the .cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "core/wall_set.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// Immutable after construction; any number of threads may query.
class WallIndex {
 public:
  /// Copies what it keeps. Throws Stopped at the deadline or before memory would pass its limit.
  WallIndex(const WallSet& walls, const Execution& execution);

  std::size_t wall_count() const;
  /// Box of all walls; empty if there are none.
  const Box& box() const;
  std::size_t bytes() const;

  /// Does the closed segment a-b touch a wall? Exact.
  bool blocks(Vec2 a, Vec2 b) const noexcept;
  /// Distance from p to the nearest wall, or at_most if none is nearer.
  double clearance(Vec2 p, double at_most = std::numeric_limits<double>::infinity()) const noexcept;
  /// Is every point of a-b at least r from every wall? r > 0: distance >= r. r = 0: same as !blocks(a, b).
  bool keeps_clearance(Vec2 a, Vec2 b, double r) const noexcept;
  /// Calls visit(const Segment&) for each wall whose own box meets `box`, some more than once, and perhaps for others
  /// nearby, in an order that depends on the walls alone; stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const;
};

}  // namespace warren
